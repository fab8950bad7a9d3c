// source.c - the text of a shader: built in or from a folder, its includes resolved.
#include "render/gl/source.h"

#include "base/file.h"
#include "base/hash.h"
#include "base/mem.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 1 << 20 }; // bytes

// The text of one file; the caller frees it.
static char *read_one(const char *folder, const char *name, struct error *err)
{
    if (folder) {
        char *path = file_join(folder, name), *text = NULL;
        size_t size;
        bool done = file_read(path, FILE_LIMIT, &text, &size, err);
        free(path);
        return done ? text : NULL;
    }
    for (size_t i = 0; i < gl_file_count; i++)
        if (!strcmp(gl_files[i].name, name))
            return mem_strdup(gl_files[i].text);
    error_set(err, "shaders/%s: no such shader", name);
    return NULL;
}

// The name in a line `#include "name"`, terminated in place, or NULL.
static char *included(char *line)
{
    line += strspn(line, " \t");
    if (strncmp(line, "#include", 8))
        return NULL;
    line += 8 + strspn(line + 8, " \t");
    char *end = *line == '"' ? strchr(line + 1, '"') : NULL;
    if (!end)
        return NULL;
    *end = 0;
    return line + 1;
}

static void put_line(struct gl_source *s, FILE *out, uint32_t file, uint32_t line, const char *text)
{
    array_reserve(&s->lines, &s->line_capacity, s->line_count + 1);
    s->lines[s->line_count++] = (struct gl_line){file, line};
    fprintf(out, "%s\n", text);
}

// The lines of a file and of those that it includes. Not marked by #line: compilers differ in what
// they make of it, and Mesa forgets the file of some errors.
static bool append(struct gl_source *s, FILE *out, const char *folder, const char *name,
                   struct error *err)
{
    char *text = read_one(folder, name, err);
    if (!text)
        return false;
    uint32_t number = s->file_count++;
    array_reserve(&s->files, &s->file_capacity, s->file_count);
    s->files[number] = mem_strdup(name);

    bool done = true;
    uint32_t count = 0;
    for (char *line = text, *next; done && line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = 0;
        count++;
        const char *other = included(line);
        bool for_c = !strncmp(line, "#pragma once", 12);
        if (!other && !for_c)
            put_line(s, out, number, count, line);
        bool known = !other;
        for (uint32_t i = 0; !known && i < s->file_count; i++)
            known = !strcmp(s->files[i], other);
        if (!known && !append(s, out, folder, other, err)) {
            struct error why = *err;
            error_set(err, "shaders/%s:%u: %s", name, count, why.text);
            done = false;
        }
    }
    free(text);
    return done;
}

// "A=2 B" becomes "#define A 2", "#define B 1".
static void define(struct gl_source *s, FILE *out, const char *defines)
{
    for (;;) {
        defines += strspn(defines, " ");
        if (!*defines)
            return;
        int all = (int)strcspn(defines, " "), name = (int)strcspn(defines, "= ");
        char line[200];
        snprintf(line, sizeof line, "#define %.*s %.*s", name, defines,
                 name < all ? all - name - 1 : 1, name < all ? defines + name + 1 : "1");
        put_line(s, out, 0, 0, line);
        defines += all;
    }
}

bool gl_source_read(struct gl_source *s, const char *folder, const char *name, const char *defines,
                    struct error *err)
{
    struct gl_source made = {0};
    size_t size;
    FILE *out = open_memstream(&made.text, &size);
    if (!out) {
        error_set(err, "shaders/%s: out of memory", name);
        return false;
    }
    put_line(&made, out, 0, 0, "#version 450 core");
    define(&made, out, defines);
    bool done = append(&made, out, folder, name, err);
    fclose(out);
    if (done)
        *s = made;
    else
        gl_source_free(&made);
    return done;
}

void gl_source_free(struct gl_source *s)
{
    for (uint32_t i = 0; i < s->file_count; i++)
        free(s->files[i]);
    free(s->files);
    free(s->lines);
    free(s->text);
    *s = (struct gl_source){0};
}

uint64_t gl_source_stamp(const struct gl_source *s, const char *folder)
{
    uint64_t stamp = 0;
    for (uint32_t i = 0; i < s->file_count; i++) {
        char *path = file_join(folder, s->files[i]);
        uint64_t one = file_stamp(path);
        stamp = hash_bytes(stamp, &one, sizeof one);
        free(path);
    }
    return stamp;
}

// Compilers write "0:12(5): error: text" (Mesa), "0(12) : error C1008: text" (NVIDIA) or "ERROR:
// 0:12: text" (AMD), where 12 is the line in the whole text.
void gl_source_error(const struct gl_source *s, const char *log, struct error *err)
{
    const char *found = log;
    for (const char *at = log; at; at = strchr(at, '\n')) {
        at += *at == '\n';
        const char *word = strcasestr(at, "error");
        if (word && word < at + strcspn(at, "\n")) {
            found = at;
            break;
        }
    }
    if (!strncmp(found, "ERROR: ", 7))
        found += 7;
    int length = (int)strcspn(found, "\n"), used = 0, column = 0;
    unsigned line = 0;
    if (sscanf(found, "%*u%*1[:(]%u%n", &line, &used) == 1 && line - 1 < s->line_count &&
        s->lines[line - 1].line) {
        struct gl_line place = s->lines[line - 1];
        sscanf(found + used, "(%*u)%n", &column);
        used += column;
        used += (int)strspn(found + used, "): ");
        error_set(err, "shaders/%s:%u: %.*s", s->files[place.file], place.line, length - used,
                  found + used);
    } else {
        error_set(err, "shaders/%s: %.*s", s->files[0], length, found);
    }
}
