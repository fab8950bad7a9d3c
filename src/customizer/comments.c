// comments.c - what stands around an assignment: its lines, its group.
#include "customizer/comments.h"

#include "customizer/annotation.h"

#include <stdlib.h>
#include <string.h>

void lines_find(struct lines *out, const char *text, size_t size)
{
    *out = (struct lines){.text = text, .size = size};
    const char *end = text + size;
    for (const char *at = text; at; at = memchr(at, '\n', (size_t)(end - at))) {
        at += out->count > 0; // past the end of the line before
        array_reserve(&out->starts, &out->capacity, (size_t)out->count + 2);
        out->starts[out->count++] = (size_t)(at - text);
    }
    out->starts[out->count] = size + 1;
}

void lines_free(struct lines *l)
{
    free(l->starts);
    *l = (struct lines){0};
}

static struct slice line_at(const struct lines *l, uint32_t line)
{
    if (line < 1 || line > l->count)
        return (struct slice){"", 0};
    const char *text = l->text + l->starts[line - 1];
    size_t size = l->starts[line] - l->starts[line - 1] - 1;
    if (size && text[size - 1] == '\r')
        size--;
    return (struct slice){text, size};
}

// Read as OpenSCAD does: from the beginning of the line, whatever began above it.
struct literal comment_annotation(const struct lines *l, uint32_t line, struct arena *arena)
{
    struct slice s = line_at(l, line);
    uint32_t semicolons = 0;
    bool string = false;
    for (size_t i = 0; i < s.size; i++) {
        if (string && s.text[i] == '\\')
            i++;
        else if (s.text[i] == '"')
            string = !string;
        else if (!string && s.text[i] == ';' && ++semicolons > 1)
            break; // whose it would be is not clear
        else if (!string && s.text[i] == '/' && i + 1 < s.size && s.text[i + 1] == '/')
            return annotation_read(arena, s.text + i + 2, s.size - i - 2);
    }
    return (struct literal){LITERAL_STRING, .text = ""};
}

const char *comment_description(const struct lines *l, uint32_t line, struct arena *arena)
{
    struct slice s = line_at(l, line - 1);
    if (s.size < 2 || memcmp(s.text, "//", 2) != 0)
        return NULL;
    size_t i = 2, length = 0;
    while (i < s.size && (s.text[i] == ' ' || s.text[i] == '\t'))
        i++;
    char *out = arena_alloc(arena, s.size - i + 1);
    for (; i < s.size; i++) {
        bool slashes = s.text[i] == '/' && i + 1 < s.size && s.text[i + 1] == '/';
        if (s.text[i])
            out[length++] = slashes ? ' ' : s.text[i];
        i += slashes;
    }
    out[length] = 0;
    return length ? out : NULL;
}

const char *comment_group(struct slice comment, struct arena *arena)
{
    char *out = arena_alloc(arena, comment.size + 1);
    const char *at = comment.text, *end = at + comment.size;
    size_t length = 0;
    while ((at = memchr(at, '[', (size_t)(end - at)))) {
        at++;
        const char *close = memchr(at, ']', (size_t)(end - at));
        if (!close)
            break;
        if (length)
            out[length++] = '-';
        memcpy(out + length, at, (size_t)(close - at));
        length += (size_t)(close - at);
        at = close + 1;
    }
    out[length] = 0;
    return out;
}
