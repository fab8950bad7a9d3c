// test_options.c - the command line.
#include "base/options.h"

#include "base/mem.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <unistd.h>
// cmocka.h wants the four above first
#include <cmocka.h>

static const char *output, *scheme;
static bool verbose;
static uint32_t threads;
static double scale;
static int sides[2];
static struct option_list shown, defined;

static const struct option options[] = {
    {"output", 'o', OPTION_TEXT, "FILE", "where to write", &output, 0, 0},
    {"colorscheme", 0, OPTION_TEXT, "NAME", "colours\nof many kinds", &scheme, 0, 0},
    {"verbose", 'V', OPTION_FLAG, NULL, "say more", &verbose, 0, 0},
    {"threads", 'j', OPTION_COUNT, "N", "threads", &threads, 0, 64},
    {"scale", 0, OPTION_NUMBER, "S", "factor", &scale, -1, 1e6},
    {"size", 0, OPTION_SIZE, "W,H", "sides", sides, 1, 99},
    {"show", 0, OPTION_OPTIONAL, "all|time|box", "what to say", &shown, 0, 0},
    {NULL, 'D', OPTION_LIST, "VAR=VALUE", "set a variable", &defined, 0, 0},
};
enum { SHORTENED = 4 }; // not --scale, --size and --show
static const struct program program = {
    "tool", "1.2.3", "Does things.", "FILE", options, array_count(options), SHORTENED};

enum { WORDS = 8 };
static char *words[WORDS + 2];
static int operands;

// Parses a command line of words between blanks.
static enum options_result parse(const char *line, struct error *err)
{
    static char buffer[256];
    int argc = 1;
    output = scheme = NULL;
    verbose = false;
    threads = 1;
    scale = 1;
    shown.count = defined.count = 0;
    operands = -1;
    words[0] = (char *)(uintptr_t) "tool";
    snprintf(buffer, sizeof buffer, "%s", line);
    for (char *word = strtok(buffer, " "); word && argc <= WORDS; word = strtok(NULL, " "))
        words[argc++] = word;
    words[argc] = NULL;
    return options_parse(&program, argc, words, &operands, err);
}

static void accepts_all_forms(void **state)
{
    (void)state;
    struct error err;
    assert_int_equal(parse("a --output=x b --colorscheme y -V", &err), OPTIONS_RUN);
    assert_int_equal(operands, 2);
    assert_string_equal(words[1], "a");
    assert_string_equal(words[2], "b");
    assert_string_equal(output, "x");
    assert_string_equal(scheme, "y");
    assert_true(verbose);
    assert_int_equal(parse("-o x -j7 --scale=-0.5", &err), OPTIONS_RUN);
    assert_string_equal(output, "x");
    assert_int_equal(threads, 7);
    assert_true(scale == -0.5);
    assert_int_equal(parse("--size=3,4", &err), OPTIONS_RUN);
    assert_true(sides[0] == 3 && sides[1] == 4);
    assert_int_equal(operands, 0);
    assert_int_equal(parse("-ox=y", &err), OPTIONS_RUN);
    assert_string_equal(output, "x=y");
    assert_int_equal(parse("--output=a=b --output=", &err), OPTIONS_RUN); // the last one holds
    assert_string_equal(output, "");
    assert_int_equal(parse("-o - - -- -o --help", &err), OPTIONS_RUN);
    assert_string_equal(output, "-");
    assert_int_equal(operands, 3);
    assert_string_equal(words[1], "-");
    assert_string_equal(words[2], "-o");
    assert_string_equal(words[3], "--help");
    assert_int_equal(parse("--scale 1e6 -j 0", &err), OPTIONS_RUN);
    assert_int_equal(parse("", &err), OPTIONS_RUN);
}

// As boost::program_options does for openscad
static void accepts_shortened_names_and_joined_letters(void **state)
{
    (void)state;
    struct error err;
    assert_int_equal(parse("--out x --thre=7 --c y", &err), OPTIONS_RUN);
    assert_string_equal(output, "x");
    assert_string_equal(scheme, "y");
    assert_int_equal(threads, 7);
    assert_int_equal(operands, 0);
    assert_int_equal(parse("--D a=1 --D=b=2", &err), OPTIONS_RUN); // letters without a name
    assert_int_equal(defined.count, 2);
    assert_string_equal(defined.items[1], "b=2");
    assert_int_equal(parse("-Vo x -VVj5 y", &err), OPTIONS_RUN);
    assert_true(verbose);
    assert_string_equal(output, "x");
    assert_int_equal(threads, 5);
    assert_int_equal(operands, 1);
    assert_int_equal(parse("-oV", &err), OPTIONS_RUN);
    assert_string_equal(output, "V");
    assert_false(verbose);
}

static void values_may_be_left_out(void **state)
{
    (void)state;
    struct error err;
    assert_int_equal(parse("--show file", &err), OPTIONS_RUN);
    assert_int_equal(operands, 1);
    assert_int_equal(shown.count, 1);
    assert_string_equal(shown.items[0], "");
    assert_int_equal(parse("--show=file --show time --show box,all allx --show", &err),
                     OPTIONS_RUN);
    assert_int_equal(operands, 1);
    assert_int_equal(shown.count, 4);
    assert_string_equal(shown.items[0], "file"); // the program says that it is wrong
    assert_string_equal(shown.items[1], "time");
    assert_string_equal(shown.items[2], "box,all");
    assert_string_equal(shown.items[3], "");
    for (const char *const *word = (const char *const[]){"time,", "tim", "boxes", ",", "|", NULL};
         *word; word++) {
        char line[64];
        snprintf(line, sizeof line, "--show %s", *word);
        assert_int_equal(parse(line, &err), OPTIONS_RUN);
        assert_int_equal(operands, 1);
    }
    assert_int_equal(parse("-D x=1 -Dy=2", &err), OPTIONS_RUN);
    assert_int_equal(defined.count, 2);
    assert_string_equal(defined.items[1], "y=2");
}

static void says_what_is_wrong(void **state)
{
    (void)state;
    static const struct {
        const char *line, *text;
    } rows[] = {
        {"--colourscheme=x", "unknown option --colourscheme; did you mean --colorscheme?"},
        {"--color red x -o", "-o: expected FILE after it"},
        {"--thread x", "--threads: expected a whole number, got 'x'"},
        {"--sho", "unknown option --sho; did you mean --show?"},
        {"--ver", "--ver is short for --verbose and --version"},
        {"--V", "unknown option --V; --help lists them"},
        {"-verbose", "unknown option -verbose; did you mean --verbose?"},
        {"-size=3,4", "unknown option -size=3,4; did you mean --size=3,4?"},
        {"-zV", "unknown option -zV; --help lists them"},
        {"-Vz", "unknown option -Vz; --help lists them"},
        {"-Vo", "-o: expected FILE after it"},
        {"--scal 1", "unknown option --scal; did you mean --scale?"},
        {"--sh", "unknown option --sh; --help lists them"},
        {"--halp", "unknown option --halp; did you mean --help?"},
        {"--quite-another-thing", "unknown option --quite-another-thing; --help lists them"},
        {"--x", "unknown option --x; --help lists them"},
        {"--=5", "unknown option --; --help lists them"},
        {"-x", "unknown option -x; --help lists them"},
        {"--output", "--output: expected FILE after it"},
        {"-o", "-o: expected FILE after it"},
        {"--verbose=1", "--verbose takes no value"},
        {"-V=1", "unknown option -V=1; --help lists them"},
        {"--threads=x", "--threads: expected a whole number, got 'x'"},
        {"--threads=", "--threads: expected a whole number, got ''"},
        {"--threads=1.5", "--threads: expected a whole number, got '1.5'"},
        {"-j 65", "-j: expected 0 to 64, got 65"},
        {"--threads -1", "--threads: expected 0 to 64, got -1"},
        {"--scale=nan", "--scale: expected a number, got 'nan'"},
        {"--scale=1e999", "--scale: expected a number, got '1e999'"},
        {"--scale=3mm", "--scale: expected a number, got '3mm'"},
        {"--size=5", "--size: expected WIDTH,HEIGHT from 1 to 99, got '5'"},
        {"--size=5,", "--size: expected WIDTH,HEIGHT from 1 to 99, got '5,'"},
        {"--size=5,5x", "--size: expected WIDTH,HEIGHT from 1 to 99, got '5,5x'"},
        {"--size=0,5", "--size: expected WIDTH,HEIGHT from 1 to 99, got '0,5'"},
        {"--size=5,100", "--size: expected WIDTH,HEIGHT from 1 to 99, got '5,100'"},
    };
    for (size_t i = 0; i < array_count(rows); i++) {
        struct error err = {0};
        if (parse(rows[i].line, &err) != OPTIONS_WRONG)
            fail_msg("accepted: %s", rows[i].line);
        assert_string_equal(err.text, rows[i].text);
    }
}

static void long_unknown_names_are_cheap(void **state)
{
    (void)state;
    static char line[256] = "--";
    memset(line + 2, 'q', sizeof line - 3);
    struct error err;
    assert_int_equal(parse(line, &err), OPTIONS_WRONG);
}

// What options_parse prints for this line.
static enum options_result printed(const char *line, char *text, size_t size)
{
    struct error err;
    FILE *file = tmpfile();
    int kept = dup(STDOUT_FILENO);
    assert_true(file && kept >= 0);
    fflush(stdout);
    dup2(fileno(file), STDOUT_FILENO);
    enum options_result result = parse(line, &err);
    fflush(stdout);
    dup2(kept, STDOUT_FILENO);
    close(kept);
    rewind(file);
    text[fread(text, 1, size - 1, file)] = 0;
    fclose(file);
    return result;
}

static void help_shows_the_table(void **state)
{
    (void)state;
    char text[2000];
    assert_int_equal(printed("--help", text, sizeof text), OPTIONS_DONE);
    assert_string_equal(text, "Usage: tool [OPTION]... FILE\n"
                              "Does things.\n"
                              "\n"
                              "  -o, --output=FILE           where to write\n"
                              "      --colorscheme=NAME      colours\n"
                              "                              of many kinds\n"
                              "  -V, --verbose               say more\n"
                              "  -j, --threads=N             threads\n"
                              "      --scale=S               factor\n"
                              "      --size=W,H              sides\n"
                              "      --show[=all|time|box]   what to say\n"
                              "  -D  VAR=VALUE               set a variable\n"
                              "  -h, --help                  show this text\n"
                              "  -v, --version               show the version\n");
    assert_int_equal(printed("--version", text, sizeof text), OPTIONS_DONE);
    assert_string_equal(text, "tool 1.2.3\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accepts_all_forms),
        cmocka_unit_test(accepts_shortened_names_and_joined_letters),
        cmocka_unit_test(values_may_be_left_out),
        cmocka_unit_test(says_what_is_wrong),
        cmocka_unit_test(long_unknown_names_are_cheap),
        cmocka_unit_test(help_shows_the_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
