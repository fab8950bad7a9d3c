// options.h - a program's command line: parsed, and explained, from one table.
#pragma once
#include "base/error.h"

enum option_kind {
    OPTION_FLAG,   // bool: set to true
    OPTION_TEXT,   // const char *: borrowed from argv
    OPTION_COUNT,  // uint32_t: a whole number in [least, most]
    OPTION_NUMBER, // double: a finite number in [least, most]
    OPTION_SIZE,   // int[2]: "W,H", whole numbers in [least, most]
    OPTION_LIST,   // struct option_list: may be given several times
    // struct option_list: the value may be left out and is "" then. The next word is a value only
    // if it names what `argument` lists between bars: "all|time" takes "all" and "time,all".
    OPTION_OPTIONAL,
};

enum { OPTION_LIST_MOST = 64 };
struct option_list {
    const char *items[OPTION_LIST_MOST]; // borrowed from argv
    uint32_t count;
};

struct option {
    const char *name; // without the dashes; NULL: the letter alone
    char letter;      // 0: none
    enum option_kind kind;
    const char *argument; // as the help names it; NULL for flags
    const char *help;     // "\n" starts a further line
    void *target;
    double least, most; // of COUNT, NUMBER and SIZE
};

struct program {
    const char *name, *version;
    const char *summary;  // one line
    const char *operands; // "FILE"
    const struct option *options;
    uint32_t option_count;
    // The first so many, and --help and --version, may be shortened to what fits one of them alone.
    uint32_t shortened_count;
};

enum options_result {
    OPTIONS_RUN,    // go on
    OPTIONS_DONE,   // --help or --version was printed
    OPTIONS_WRONG,  // *err says why
    OPTIONS_UNTOLD, // what --help or --version says could not be written; *err says why
};

// "--name=value", "--name value", "-o value", "-ovalue", "-qo value"; "--" ends the options, "-" is
// an operand. Moves the operands, in their order, to argv[1 .. 1 + *operands).
enum options_result options_parse(const struct program *p, int argc, char **argv, int *operands,
                                  struct error *err);
