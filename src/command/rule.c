// rule.c - the rule for make: what the outputs are made from.
#include "command/rule.h"

#include "base/file.h"
#include "base/mem.h"
#include "command/output.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// As make reads it back.
static void add_name(struct text_file *t, const char *path)
{
    char *name = mem_alloc(2 * strlen(path) + 1), *out = name;
    for (; *path; path++) {
        if (*path == ' ' || *path == '#')
            *out++ = '\\';
        if (*path == '$')
            *out++ = '$';
        *out++ = *path;
    }
    *out = 0;
    text_file_add(t, name);
    free(name);
}

static void add_file(struct text_file *t, const char *path)
{
    text_file_add(t, " \\\n\t");
    add_name(t, path);
}

static void add_absolute(struct text_file *t, const char *path)
{
    char *folder = path[0] == '/' ? NULL : getcwd(NULL, 0);
    char *whole = file_join(folder ? folder : ".", path);
    add_file(t, whole);
    free(whole);
    free(folder);
}

static void add_target(struct text_file *t, const char *path)
{
    if (t->used)
        text_file_add(t, " ");
    add_name(t, path);
}

static void add_targets(struct text_file *t, const struct request *r, const struct output *o)
{
    if (!o->per_view && strcmp(o->path, "-") != 0)
        add_target(t, o->path);
    for (uint32_t i = 0; i < r->style.views.count && o->per_view; i++) {
        char *path = output_path(o, &r->style.views.items[i]);
        add_target(t, path);
        free(path);
    }
}

void rule_note(struct rule *rule, const struct request *r, const struct input *in,
               const struct model *m)
{
    for (uint32_t i = 0; i < r->output_count; i++)
        add_targets(&rule->targets, r, &r->outputs[i]);
    rule->files.used = 0;
    if (!r->is_scad && strcmp(r->input, "-") != 0)
        add_file(&rule->files, r->input);
    for (uint32_t i = 0; i < in->scad.file_count; i++)
        add_file(&rule->files, in->scad.files[i]);
    for (uint32_t i = 0; i < m->import_count && !r->is_scad; i++)
        add_absolute(&rule->files, m->imports[i]);
}

bool rule_save(struct rule *rule, const char *path, struct error *err)
{
    struct text_file all = rule->targets;
    rule->targets = (struct text_file){0};
    text_file_add(&all, ":");
    if (rule->files.used) {
        rule->files.data = mem_realloc(rule->files.data, rule->files.used + 1);
        rule->files.data[rule->files.used] = 0;
        text_file_add(&all, rule->files.data);
    }
    text_file_add(&all, "\n");
    rule_free(rule);
    return text_file_save(&all, path, err);
}

void rule_free(struct rule *rule)
{
    free(rule->targets.data);
    free(rule->files.data);
    *rule = (struct rule){0};
}
