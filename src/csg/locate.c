// locate.c - where in the text of a file the values of its tree stand.
//
// A tree has places of nodes alone: positions of all numbers would take more room than the numbers.
// So the arguments of a node are read once more. As the text did parse, nothing is checked but what
// could lead astray, and who writes a changed text reads it back.
#include "csg/locate.h"

#include "csg/parser.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

struct reader {
    const char *at, *end, *text;
    struct csg_parser *parser; // for strings
};

static void skip_comment(struct reader *r)
{
    const char *close;
    if (r->at[1] == '/') {
        close = memchr(r->at, '\n', (size_t)(r->end - r->at));
        r->at = close ? close : r->end;
        return;
    }
    close = r->at + 2;
    do
        close = memchr(close, '*', (size_t)(r->end - close));
    while (close && ++close < r->end && *close != '/');
    r->at = close && close < r->end ? close + 1 : r->end;
}

// To the next character that means something; 0 at the end.
static char next(struct reader *r)
{
    while (r->at < r->end) {
        if (strchr(" \t\r\n", *r->at) && *r->at)
            r->at++;
        else if (r->end - r->at > 1 && memcmp(r->at, "\xC2\xA0", 2) == 0)
            r->at += 2;
        else if (r->end - r->at > 1 && *r->at == '/' && (r->at[1] == '/' || r->at[1] == '*'))
            skip_comment(r);
        else
            return *r->at;
    }
    return 0;
}

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_' || c == '$' || c == '.';
}

// A name or a number; numbers hold signs after their exponent.
static void skip_word(struct reader *r)
{
    const char *begin = r->at;
    bool hex = r->end - begin > 1 && *begin == '0' && (begin[1] | 32) == 'x';
    bool number = !hex && (isdigit((unsigned char)*begin) || *begin == '.');
    while (r->at < r->end && (is_word(*r->at) || (number && (*r->at == '-' || *r->at == '+') &&
                                                  r->at > begin && (r->at[-1] | 32) == 'e')))
        r->at++;
}

static bool take(struct reader *r, char c)
{
    if (next(r) != c)
        return false;
    r->at++;
    return true;
}

static bool skip_name(struct reader *r, struct csg_span *out)
{
    next(r);
    const char *begin = r->at;
    skip_word(r);
    *out = (struct csg_span){(size_t)(begin - r->text), (size_t)(r->at - r->text), false};
    return r->at > begin;
}

// A name and '=' in front of a value.
static void skip_argument_name(struct reader *r)
{
    struct reader ahead = *r;
    struct csg_span name;
    if (skip_name(&ahead, &name) && next(&ahead) == '=') {
        ahead.at++;
        *r = ahead;
    }
}

// Reads one value, and finds scalar number *left in it; otherwise *left is less by those it has.
static bool read_value(struct reader *r, uint32_t *left, struct csg_span *out, bool *found)
{
    uint32_t depth = 0;
    bool negative = false, whole = false;
    while (!*found && (depth || !whole)) {
        char c = next(r);
        const char *begin = r->at;
        if (c == '[' || c == '(') {
            depth++;
            r->at++;
        } else if ((c == ']' || c == ')') && depth) {
            depth--;
            whole = true;
            r->at++;
        } else if (c == ',' && depth) {
            negative = false;
            r->at++;
        } else if (c == '-' || c == '+') {
            negative ^= c == '-';
            r->at++;
        } else if (is_word(c) || c == '"') {
            if (c == '"')
                r->at = csg_scan_string(r->parser, begin, &(struct csg_value){0});
            else
                skip_word(r);
            bool signed_ = begin > r->text && begin[-1] == '-';
            if (!*found && !(*left)--) {
                *found = true;
                *out = (struct csg_span){(size_t)(begin - signed_ - r->text),
                                         (size_t)(r->at - r->text), negative ^ signed_};
            }
            negative = false;
            whole = true;
        } else {
            return false; // a range, or not what was parsed
        }
    }
    return true;
}

static bool open_node(struct reader *r, struct csg_parser *p, const struct csg_text *t,
                      const struct csg_node *n, struct csg_span *name)
{
    const char *at = t->text, *end = t->text + t->size;
    if (t->size >= 3 && memcmp(at, "\xEF\xBB\xBF", 3) == 0)
        at += 3;
    for (uint32_t line = 1; line < n->line; line++) {
        at = memchr(at, '\n', (size_t)(end - at));
        if (!at++)
            return false;
    }
    if (n->column == 0 || n->column > (size_t)(end - at))
        return false;
    *p = (struct csg_parser){.text = t->text, .end = end, .line = 1};
    *r = (struct reader){at + n->column - 1, end, t->text, p};
    return skip_name(r, name);
}

bool csg_locate_name(const struct csg_text *text, const struct csg_node *node, struct csg_span *out)
{
    struct csg_parser p;
    struct reader r;
    size_t length = strlen(node->name);
    return open_node(&r, &p, text, node, out) && out->end - out->begin == length &&
           memcmp(text->text + out->begin, node->name, length) == 0;
}

static bool locate(struct reader *r, const struct csg_node *node, uint32_t argument,
                   uint32_t scalar, struct csg_span *out)
{
    bool assignment = strcmp(node->name, CSG_ASSIGN) == 0, found = false;
    if (!take(r, assignment ? '=' : '('))
        return false;
    for (uint32_t i = 0; i <= argument; i++) {
        uint32_t left = i == argument ? scalar : UINT32_MAX;
        while (!assignment && take(r, ','))
            ;
        if (!assignment)
            skip_argument_name(r);
        if (!read_value(r, &left, out, &found))
            return false;
    }
    return found;
}

bool csg_locate_scalar(const struct csg_text *text, const struct csg_node *node, uint32_t argument,
                       uint32_t scalar, struct csg_span *out)
{
    struct csg_parser p = {0};
    struct reader r;
    struct csg_span name;
    bool found = argument < node->argument_count && open_node(&r, &p, text, node, &name) &&
                 locate(&r, node, argument, scalar, out);
    arena_free(&p.tree.arena);
    return found;
}

// ---------------------------------------------------------------- the tree

struct level {
    const struct csg_value *items;
    uint32_t count, done;
};

// Counts scalars up to number `scalar`, and gives that one.
static uint32_t walk(const struct csg_value *value, uint32_t scalar, struct csg_value *found)
{
    struct level *levels = NULL;
    uint32_t depth = 0, room = 0, seen = 0;
    bool range = false;
    array_reserve(&levels, &room, 1);
    levels[depth++] = (struct level){value, 1, 0};
    while (depth && seen <= scalar && !range) {
        struct level *l = &levels[depth - 1];
        if (l->done == l->count) {
            depth--;
            continue;
        }
        const struct csg_value *v = &l->items[l->done++];
        range = v->kind == CSG_RANGE;
        if (v->kind == CSG_VECTOR) {
            array_reserve(&levels, &room, (size_t)depth + 1);
            levels[depth++] = (struct level){v->items, v->count, 0};
        } else if (v->kind == CSG_NUMBERS) {
            if (scalar - seen < v->count)
                *found =
                    (struct csg_value){.kind = CSG_NUMBER, .number = v->numbers[scalar - seen]};
            seen = v->count > UINT32_MAX - seen ? UINT32_MAX : seen + v->count;
        } else if (!range) {
            if (seen++ == scalar)
                *found = *v;
        }
    }
    free(levels);
    return range ? 0 : seen;
}

const struct csg_value *csg_scalar(const struct csg_value *value, uint32_t scalar,
                                   struct csg_value *hold)
{
    return walk(value, scalar, hold) > scalar ? hold : NULL;
}

uint32_t csg_scalar_count(const struct csg_value *value)
{
    struct csg_value hold;
    return value->kind == CSG_NUMBERS ? value->count : walk(value, UINT32_MAX - 1, &hold);
}
