// agree.c - what agree.sh compares with OpenSCAD.
//   agree trees A.scad A.ast ...             annotations we find, and those of its syntax tree
//   agree names A.scad                       of the parameters
//   agree flags A.scad SETS.json SET         what a set changes, as -D flags
//   agree save A.scad SETS.json SET X=TEXT.. writes a set, and prints its flags
#include "base/file.h"
#include "customizer/assignments.h"
#include "customizer/sets.h"

#include <stdlib.h>
#include <string.h>

enum { LIMIT = 1 << 24, DIGITS_OPENSCAD = 6 };

static char *read_file(const char *path, size_t *size)
{
    struct error err;
    char *text;
    if (!file_read(path, LIMIT, &text, size, &err)) {
        fprintf(stderr, "%s\n", err.text);
        exit(1);
    }
    return text;
}

static void say_quoted(struct words *out, const char *head, const char *text)
{
    if (!text)
        return;
    words_say(out, head);
    words_quoted(out, text);
    words_say(out, ")\n");
}

// What OpenSCAD prints of the parameters.
static char *ours(const char *path, uint32_t *count)
{
    size_t size;
    char *text = read_file(path, &size);
    struct words out = {0};
    struct assignments all;
    assignments_read(&all, text, size);
    words_say(&out, "");
    for (uint32_t i = 0; i < all.count; i++) {
        const struct assignment *a = &all.items[i];
        if (!a->literal || a->line >= all.end_line)
            continue;
        say_quoted(&out, "//Group(", a->group);
        say_quoted(&out, "//Description(", a->description);
        words_say(&out, "//Parameter(");
        words_literal(&out, &a->annotation, DIGITS_OPENSCAD);
        words_say(&out, ")\n");
        words_say(&out, a->name);
        words_say(&out, " = ");
        words_literal(&out, &a->value, DIGITS_OPENSCAD);
        words_say(&out, ";\n");
        ++*count;
    }
    assignments_free(&all);
    free(text);
    return out.data;
}

// The signs in front of a value stand in the tree as they were written: "--1".
static void say_assigned(struct words *out, const char *line, size_t length)
{
    struct arena arena = {0};
    struct literal value;
    const char *equals = strstr(line, " = ");
    if (!equals || equals > line + length || line[length - 1] != ';') {
        fprintf(stderr, "no assignment: %.*s\n", (int)length, line);
        exit(1);
    }
    equals += 3;
    words_add(out, line, (size_t)(equals - line));
    size_t left = (size_t)(line + length - 1 - equals);
    if (literal_read(&arena, equals, left, &value))
        words_literal(out, &value, DIGITS_OPENSCAD);
    else
        words_add(out, equals, left);
    words_say(out, ";\n");
    arena_free(&arena);
}

static char *theirs(const char *path)
{
    size_t size;
    char *text = read_file(path, &size);
    struct words out = {0};
    bool annotated = false;
    words_say(&out, "");
    for (const char *line = text; *line;) {
        size_t length = strcspn(line, "\n");
        if (annotated)
            say_assigned(&out, line, length);
        annotated = strncmp(line, "//Parameter(", 12) == 0;
        if (annotated || strncmp(line, "//Group(", 8) == 0 ||
            strncmp(line, "//Description(", 14) == 0)
            words_add(&out, line, length + 1);
        line += length + (line[length] != 0);
    }
    free(text);
    return out.data;
}

static int trees(int count, char **paths)
{
    uint32_t agreed = 0, files = 0, bad = 0;
    for (int i = 0; i + 1 < count; i += 2) {
        uint32_t parameters = 0;
        char *a = ours(paths[i], &parameters), *b = theirs(paths[i + 1]);
        if (strcmp(a, b) != 0) {
            printf("%s differs\n--- ours\n%s--- OpenSCAD's\n%s", paths[i], a, b);
            bad++;
        } else
            agreed += parameters;
        files++;
        free(a);
        free(b);
    }
    printf("%u parameters of %u files agree, %u files differ\n", agreed, files - bad, bad);
    return files == 0 || bad > 0;
}

static void change(struct parameters *p, char *assigned)
{
    char *equals = strchr(assigned, '=');
    *equals = 0;
    struct parameter *one = parameters_find(p, assigned);
    if (!one || !parameter_set(one, equals + 1)) {
        fprintf(stderr, "%s does not become %s\n", assigned, equals + 1);
        exit(1);
    }
}

static void apply(struct parameters *p, const char *path, const char *set)
{
    struct error err = {0};
    struct parameter_sets sets;
    if (!parameter_sets_read(&sets, path, &err) || !parameter_sets_apply(&sets, set, p)) {
        fprintf(stderr, "%s: %s %s\n", path, set, err.text);
        exit(1);
    }
    parameter_sets_free(&sets);
}

int main(int argc, char **argv)
{
    if (argc < 3)
        return 1;
    if (strcmp(argv[1], "trees") == 0)
        return trees(argc - 2, argv + 2);
    struct parameters p;
    struct error err;
    size_t size;
    char *text = read_file(argv[2], &size);
    parameters_read(&p, text, size);
    free(text);
    bool save = strcmp(argv[1], "save") == 0;
    for (int i = 5; save && i < argc; i++)
        change(&p, argv[i]);
    if (save && !parameter_set_save(argv[3], argv[4], &p, &err)) {
        fprintf(stderr, "%s\n", err.text);
        return 1;
    }
    if (strcmp(argv[1], "names") == 0)
        for (uint32_t i = 0; i < p.count; i++)
            puts(p.items[i].name);
    else {
        if (!save)
            apply(&p, argv[3], argv[4]);
        char *flags = parameters_flags(&p);
        puts(flags);
        free(flags);
    }
    parameters_free(&p);
    return 0;
}
