// options.c - a program's command line: parsed, and explained, from one table.
#include "base/options.h"

#include "base/mem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// These two belong to every program.
static const struct option common[] = {
    {"help", 'h', OPTION_FLAG, NULL, "show this text", NULL, 0, 0},
    {"version", 'v', OPTION_FLAG, NULL, "show the version", NULL, 0, 0},
};

static uint32_t total(const struct program *p)
{
    return p->option_count + (uint32_t)array_count(common);
}

static const struct option *at(const struct program *p, uint32_t i)
{
    return i < p->option_count ? &p->options[i] : &common[i - p->option_count];
}

// The option and its value as they stand in argv; value NULL: none was attached.
struct given {
    const struct option *option;
    char label[40]; // "--threads" or "-j", for messages
    const char *value;
};

// Number of insertions, deletions and replacements between a (its first n bytes) and b.
static uint32_t distance(const char *a, size_t n, const char *b)
{
    enum { LONGEST = 32 };
    size_t m = strlen(b);
    if (n > LONGEST || m > LONGEST)
        return UINT32_MAX;
    uint32_t row[LONGEST + 1];
    for (uint32_t j = 0; j <= m; j++)
        row[j] = j;
    for (uint32_t i = 1; i <= n; i++) {
        uint32_t diagonal = row[0];
        row[0] = i;
        for (uint32_t j = 1; j <= m; j++) {
            uint32_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            uint32_t shorter = row[j] < row[j - 1] ? row[j] : row[j - 1];
            diagonal = row[j];
            row[j] = replaced < shorter + 1 ? replaced : shorter + 1;
        }
    }
    return row[m];
}

static void set_unknown(const struct program *p, const char *name, size_t length, struct error *err)
{
    const char *nearest = NULL;
    uint32_t best = length < 5 ? 2 : 4; // names further away than this are no help
    for (uint32_t i = 0; i < total(p); i++) {
        const char *candidate = at(p, i)->name;
        uint32_t d = candidate ? distance(name, length, candidate) : best;
        if (candidate && length > 2 && d >= best && strncmp(candidate, name, length) == 0)
            d = best - 1; // shortened
        if (d < best) {
            best = d;
            nearest = candidate;
        }
    }
    if (nearest)
        error_set(err, "unknown option --%.*s; did you mean --%s?", (int)length, name, nearest);
    else
        error_set(err, "unknown option --%.*s; --help lists them", (int)length, name);
}

// The option whose name begins with these bytes, of those that may be shortened.
static const struct option *find_shortened(const struct program *p, const char *name, size_t length,
                                           struct error *err)
{
    const struct option *found = NULL;
    for (uint32_t i = 0; i < total(p) && length && p->shortened_count; i++) {
        const struct option *o = at(p, i);
        bool own = i >= p->shortened_count && i < p->option_count;
        if (own || !o->name || strncmp(o->name, name, length) != 0)
            continue;
        if (found) {
            error_set(err, "--%.*s is short for --%s and --%s", (int)length, name, found->name,
                      o->name);
            return NULL;
        }
        found = o;
    }
    if (!found)
        set_unknown(p, name, length, err);
    return found;
}

// A word that starts with two dashes. A letter without a name may stand there as well.
static bool recognise_name(const struct program *p, const char *word, struct given *out,
                           struct error *err)
{
    const char *name = word + 2;
    size_t length = strcspn(name, "=");
    *out = (struct given){.value = name[length] ? name + length + 1 : NULL};
    for (uint32_t i = 0; i < total(p) && !out->option; i++) {
        const struct option *o = at(p, i);
        if (o->name ? strlen(o->name) == length && memcmp(o->name, name, length) == 0
                    : length == 1 && *name == o->letter)
            out->option = o;
    }
    if (!out->option)
        out->option = find_shortened(p, name, length, err);
    if (!out->option)
        return false;
    if (out->option->name)
        snprintf(out->label, sizeof out->label, "--%s", out->option->name);
    else
        snprintf(out->label, sizeof out->label, "--%c", out->option->letter);
    return true;
}

// Whether the word is the name of an option that lacks a dash.
static bool lacks_dash(const struct program *p, const char *word)
{
    size_t length = strcspn(word + 1, "=");
    bool lacks = false;
    for (uint32_t i = 0; i < total(p); i++) {
        const char *name = at(p, i)->name;
        lacks |= name && strlen(name) == length && memcmp(name, word + 1, length) == 0;
    }
    return lacks;
}

// A letter behind one dash. What follows it is its value, or further letters behind flags.
static bool recognise_letter(const struct program *p, const char *word, const char *letter,
                             struct given *out, struct error *err)
{
    bool name = lacks_dash(p, word);
    *out = (struct given){0};
    for (uint32_t i = 0; i < total(p) && !out->option; i++)
        if (at(p, i)->letter == *letter)
            out->option = at(p, i);
    if (!out->option || name) {
        error_set(err,
                  name ? "unknown option %s; did you mean -%s?"
                       : "unknown option %s; --help lists them",
                  word, word);
        return false;
    }
    snprintf(out->label, sizeof out->label, "-%c", *letter);
    if (letter[1] && out->option->kind != OPTION_FLAG)
        out->value = letter + 1;
    return true;
}

static bool store_number(const struct given *g, struct error *err)
{
    const struct option *o = g->option;
    char *end;
    double v = strtod(g->value, &end);
    bool whole = o->kind == OPTION_COUNT;
    if (end == g->value || *end || !isfinite(v) || (whole && v != floor(v))) {
        error_set(err, "%s: expected a %s, got '%s'", g->label, whole ? "whole number" : "number",
                  g->value);
        return false;
    }
    if (v < o->least || v > o->most) {
        error_set(err, "%s: expected %.15g to %.15g, got %s", g->label, o->least, o->most,
                  g->value);
        return false;
    }
    if (whole)
        *(uint32_t *)o->target = (uint32_t)v;
    else
        *(double *)o->target = v;
    return true;
}

static bool store_size(const struct given *g, struct error *err)
{
    const struct option *o = g->option;
    const char *second = g->value;
    char *end;
    long w = strtol(g->value, &end, 10), h = 0;
    bool ok = end != g->value && *end == ',';
    if (ok) {
        second = end + 1;
        h = strtol(second, &end, 10);
        ok = end != second && !*end;
    }
    double low = (double)(w < h ? w : h), high = (double)(w > h ? w : h);
    if (!ok || low < o->least || high > o->most) {
        error_set(err, "%s: expected WIDTH,HEIGHT from %.15g to %.15g, got '%s'", g->label,
                  o->least, o->most, g->value);
        return false;
    }
    int *size = o->target;
    size[0] = (int)w;
    size[1] = (int)h;
    return true;
}

static bool store_item(const struct given *g, struct error *err)
{
    struct option_list *list = g->option->target;
    if (list->count == OPTION_LIST_MOST) {
        error_set(err, "%s: given more than %d times", g->label, OPTION_LIST_MOST);
        return false;
    }
    list->items[list->count++] = g->value;
    return true;
}

// Whether all parts of `word` between commas are among `names` between bars.
static bool is_choice(const char *word, const char *names)
{
    for (size_t length; word; word = word[length] ? word + length + 1 : NULL) {
        length = strcspn(word, ",");
        const char *name = names;
        for (size_t n; name; name = name[n] ? name + n + 1 : NULL) {
            n = strcspn(name, "|");
            if (n == length && strncmp(name, word, n) == 0)
                break;
        }
        if (!name)
            return false;
    }
    return true;
}

static bool store(const struct given *g, struct error *err)
{
    switch (g->option->kind) {
    case OPTION_FLAG:
        if (g->value) {
            error_set(err, "%s takes no value", g->label);
            return false;
        }
        *(bool *)g->option->target = true;
        return true;
    case OPTION_TEXT:
        *(const char **)g->option->target = g->value;
        return true;
    case OPTION_SIZE:
        return store_size(g, err);
    case OPTION_LIST:
    case OPTION_OPTIONAL:
        return store_item(g, err);
    case OPTION_COUNT:
    case OPTION_NUMBER:
        break;
    }
    return store_number(g, err);
}

// The left column of the help; returns its length.
static int print_name(const struct option *o)
{
    const char *name = o->name ? o->name : "", *argument = o->argument ? o->argument : "";
    char letter[] = {'-', o->letter, o->name ? ',' : 0, 0};
    bool optional = o->kind == OPTION_OPTIONAL;
    const char *before = optional ? "[=" : o->argument && o->name ? "=" : "";
    return printf("  %-3s %s%s%s%s%s", o->letter ? letter : "", o->name ? "--" : "", name, before,
                  argument, optional ? "]" : "");
}

static void print_help(const struct program *p)
{
    enum { COLUMN = 30 };
    printf("Usage: %s [OPTION]... %s\n%s\n\n", p->name, p->operands, p->summary);
    for (uint32_t i = 0; i < total(p); i++) {
        const struct option *o = at(p, i);
        int used = print_name(o);
        for (const char *line = o->help; line;) {
            int length = (int)strcspn(line, "\n");
            if (used >= COLUMN) {
                printf("\n");
                used = 0;
            }
            printf("%*s%.*s\n", COLUMN - used, "", length, line);
            used = 0;
            line = line[length] ? line + length + 1 : NULL;
        }
    }
}

// Help and version are the output asked for: not to be able to write them is an error.
static enum options_result explain(const struct program *p, bool help, struct error *err)
{
    if (help)
        print_help(p);
    else
        printf("%s %s\n", p->name, p->version);
    if (fflush(stdout) == 0 && !ferror(stdout))
        return OPTIONS_DONE;
    error_set(err, "standard output: cannot write");
    return OPTIONS_UNTOLD;
}

// Gives the option its value, if need be the next word, and stores it.
static bool take(struct given *g, char ***rest, struct error *err)
{
    const struct option *o = g->option;
    char *next = **rest;
    bool wanted =
        o->kind == OPTION_OPTIONAL ? next && is_choice(next, o->argument) : o->kind != OPTION_FLAG;
    if (!g->value && wanted) {
        if (!next) {
            error_set(err, "%s: expected %s after it", g->label, o->argument);
            return false;
        }
        g->value = next;
        (*rest)++;
    }
    if (!g->value && o->kind == OPTION_OPTIONAL)
        g->value = "";
    return store(g, err);
}

enum options_result options_parse(const struct program *p, int argc, char **argv, int *operands,
                                  struct error *err)
{
    int kept = 0;
    bool ended = false;
    char **rest = argv + (argc > 0);
    while (*rest) {
        char *word = *rest++;
        if (ended || word[0] != '-' || !word[1]) {
            argv[1 + kept++] = word;
            continue;
        }
        if (strcmp(word, "--") == 0) {
            ended = true;
            continue;
        }
        const char *letter = word[1] == '-' ? NULL : word + 1;
        struct given g;
        do {
            if (!(letter ? recognise_letter(p, word, letter, &g, err)
                         : recognise_name(p, word, &g, err)))
                return OPTIONS_WRONG;
            if (g.option->target && !take(&g, &rest, err))
                return OPTIONS_WRONG;
            if (!g.option->target)
                return explain(p, g.option == &common[0], err);
        } while (letter && !g.value && *++letter);
    }
    *operands = kept;
    return OPTIONS_RUN;
}
