// program.h - what main() does in programs that run over operands.
#pragma once
#include "base/options.h"

// The exit code: 1, after a line that says why, for wrong options and when `run` returns false.
static inline int program_main(const struct program *p, int argc, char **argv,
                               bool (*run)(char **operands, int count, struct error *err))
{
    int operands = 0;
    struct error err;
    enum options_result result = options_parse(p, argc, argv, &operands, &err);
    if (result == OPTIONS_DONE || (result == OPTIONS_RUN && run(argv + 1, operands, &err)))
        return 0;
    fprintf(stderr, "%s: %s\n", p->name, err.text);
    return 1;
}
