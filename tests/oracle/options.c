// options.c - what test_oracle is asked to do.
#include "options.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

// One option and what follows it; returns how many words it took, 0: it is unknown.
static int parse_option(struct options *o, int left, char **argv)
{
    if (!strcmp(argv[0], "--hash")) {
        o->walk = WALK_HASH;
        return 1;
    }
    if (!strcmp(argv[0], "--array")) {
        o->array = true;
        return 1;
    }
    if (!strcmp(argv[0], "--budgets")) {
        o->budgets = true;
        return 1;
    }
    if (!strcmp(argv[0], "--pixel") && left >= 3) {
        o->x = atoi(argv[1]);
        o->y = atoi(argv[2]);
        o->one_pixel = true;
        return 3;
    }
    if (left < 2)
        return 0;
    if (!strcmp(argv[0], "--device") && !strcmp(argv[1], "gl"))
        o->gl = true;
    else if (!strcmp(argv[0], "--count"))
        o->count = (uint32_t)strtoul(argv[1], NULL, 10);
    else if (!strcmp(argv[0], "--threads"))
        o->threads = (uint32_t)strtoul(argv[1], NULL, 10);
    else if (!strcmp(argv[0], "--seed"))
        o->seed = strtoull(argv[1], NULL, 10);
    else if (!strcmp(argv[0], "--slabs"))
        o->slabs = (uint32_t)strtoul(argv[1], NULL, 10);
    else if (!strcmp(argv[0], "--memory"))
        o->memory = strtoull(argv[1], NULL, 10) << 20;
    else
        return 0;
    return 2;
}

static bool known_mode(const struct options *o)
{
    static const char *const alone[] = {"random", "threads", "memory", "slabs", "walks", "lists"};
    static const char *const agree[] = {"random", "broken"};
    const char *const *modes = o->agree ? agree : alone;
    for (size_t i = 0; i < (o->agree ? array_count(agree) : array_count(alone)); i++)
        if (!strcmp(o->mode, modes[i]))
            return true;
    return false;
}

bool options_parse(struct options *out, int argc, char **argv)
{
    *out = (struct options){.count = 2000};
    int at = 1;
    out->agree = at < argc && !strcmp(argv[at], "agree");
    at += out->agree;
    out->mode = at < argc ? argv[at] : "random";
    if (at + 2 < argc && strchr(out->mode, '.')) {
        out->file = argv[at];
        out->width = atoi(argv[at + 1]);
        out->height = atoi(argv[at + 2]);
        at += 2;
    }
    if (!out->file && !known_mode(out)) {
        fprintf(stderr, "test_oracle: cannot do '%s'\n", out->mode);
        return false;
    }
    for (int taken, i = at + 1; i < argc; i += taken) {
        taken = parse_option(out, argc - i, argv + i);
        if (!taken) {
            fprintf(stderr, "test_oracle: cannot use '%s'\n", argv[i]);
            return false;
        }
    }
    if (out->gl)
        out->threads = 1; // of drawing, one context is enough
    return true;
}
