// print.c - the tree as OpenSCAD 2021.01 exports it.
#include "csg/csg.h"

#include "base/locale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum style { STYLE_STREAM, STYLE_SHORTEST, STYLE_INTEGER };

// How the values of one argument are written.
struct form {
    enum style style;
    bool tight;  // no blank behind the commas of vectors
    bool escape; // strings
};

// A value whose elements are being written.
struct open_value {
    const struct csg_value *items;
    uint32_t count, done;
};

struct printer {
    FILE *out;
    struct open_value *values; // stack
    uint32_t value_count, value_capacity;
    const struct csg_node **nodes; // stack: the enclosing ones
    uint32_t node_count, node_capacity;
    bool indent;
};

// C++ streams: "%g", whatever the locale (see csg_print).
static void put_stream(FILE *out, double v)
{
    fprintf(out, "%g", v);
}

// Exactly between two numbers of 6 digits?
static bool is_tie(double v)
{
    char text[64];

    if (!isfinite(v) || (v == floor(v) && fabs(v) < 1000000))
        return false;
    snprintf(text, sizeof text, "%.40e", fabs(v));
    return text[7] == '5' && strspn(text + 8, "0") == 34;
}

// double-conversion's ToPrecision of 6 digits without trailing zeros: ties away from zero,
// exponents without padding, plain digits down to 1e-5, no negative zero, no sign on nan.
static void put_shortest(FILE *out, double v)
{
    char text[32];

    if (isnan(v) || v == 0) {
        fputs(v == 0 ? "0" : "nan", out);
        return;
    }
    if (is_tie(v))
        v = nextafter(v, copysign(INFINITY, v));
    if (isinf(v) || fabs(v) >= 1e-4) {
        snprintf(text, sizeof text, "%g", v);
        char *e = strchr(text, 'e');
        if (!e) {
            fputs(text, out);
            return;
        }
        fprintf(out, "%.*se%+d", (int)(e - text), text, atoi(e + 1));
        return;
    }
    snprintf(text, sizeof text, "%.5e", v);
    char *e = strchr(text, 'e'), *last = e - 1;
    int exponent = atoi(e + 1);
    while (*last == '0')
        last--;
    if (exponent < -5) {
        fprintf(out, "%.*se%d", (int)(last - text) + (*last != '.'), text, exponent);
        return;
    }
    fprintf(out, "%s0.", signbit(v) ? "-" : "");
    for (int i = -1; i > exponent; i--)
        putc_unlocked('0', out);
    for (char *s = text; s <= last; s++)
        if (*s != '-' && *s != '.')
            putc_unlocked(*s, out);
}

static void put_number(FILE *out, double v, enum style style)
{
    if (style == STYLE_SHORTEST)
        put_shortest(out, v);
    else if (style == STYLE_INTEGER && v == floor(v) && fabs(v) < 1e15)
        fprintf(out, "%.0f", v);
    else
        put_stream(out, v);
}

static void put_string(FILE *out, const struct csg_value *v, bool escape)
{
    putc_unlocked('"', out);
    if (!escape)
        fwrite(v->string, 1, v->count, out);
    for (uint32_t i = 0; escape && i < v->count; i++) {
        char c = v->string[i];
        const char *special = strchr("\tt\nn\rr\"\"\\\\", c);
        if (c == 't' || c == 'n' || c == 'r' || !special) {
            putc_unlocked(c, out);
        } else {
            putc_unlocked('\\', out);
            putc_unlocked(special[1], out);
        }
    }
    putc_unlocked('"', out);
}

static void put_numbers(FILE *out, const struct csg_value *v, struct form form,
                        const char *separator)
{
    putc_unlocked('[', out);
    for (uint32_t i = 0; i < v->count; i++) {
        if (i)
            fputs(separator, out);
        put_number(out, v->numbers[i], form.style);
    }
    putc_unlocked(']', out);
}

static void put_scalar(FILE *out, const struct csg_value *v, struct form form)
{
    const char *comma = form.tight ? "," : ", ";

    switch (v->kind) {
    case CSG_UNDEF:
        fputs("undef", out);
        break;
    case CSG_BOOL:
        fputs(v->boolean ? "true" : "false", out);
        break;
    case CSG_NUMBER:
        put_number(out, v->number, form.style);
        break;
    case CSG_STRING:
        put_string(out, v, form.escape);
        break;
    case CSG_NUMBERS:
    case CSG_RANGE:
        put_numbers(out, v, form, v->kind == CSG_RANGE ? " : " : comma);
        break;
    case CSG_VECTOR:
        break;
    }
}

static void put_value(struct printer *p, const struct csg_value *v, struct form form)
{
    array_reserve(&p->values, &p->value_capacity, 1);
    p->values[0] = (struct open_value){v, 1, 0};
    p->value_count = 1;
    while (p->value_count) {
        struct open_value *top = &p->values[p->value_count - 1];
        if (top->done == top->count) {
            if (--p->value_count)
                putc_unlocked(']', p->out);
            continue;
        }
        if (top->done)
            fputs(form.tight ? "," : ", ", p->out);
        const struct csg_value *one = &top->items[top->done++];
        if (one->kind != CSG_VECTOR) {
            put_scalar(p->out, one, form);
            continue;
        }
        putc_unlocked('[', p->out);
        array_reserve(&p->values, &p->value_capacity, (size_t)p->value_count + 1);
        p->values[p->value_count++] = (struct open_value){one->items, one->count, 0};
    }
}

static bool one_of(const char *name, const char *const *names)
{
    while (*names && strcmp(name, *names) != 0)
        names++;
    return *names;
}

static struct form form_of(const struct csg_node *node, const char *argument)
{
    static const char *const shortest[] = {"points", "paths", "faces", "triangles", NULL};
    static const char *const integer[] = {"timestamp", "convexity", "slices", "segments", NULL};
    static const char *const escaped[] = {"file", "layer", NULL};
    struct form form = {.tight = strcmp(node->name, "resize") == 0};

    if (argument ? one_of(argument, shortest) : strcmp(node->name, "multmatrix") == 0)
        form.style = STYLE_SHORTEST;
    else if (argument && one_of(argument, integer))
        form.style = STYLE_INTEGER;
    form.escape = argument && (one_of(argument, escaped) || strcmp(node->name, CSG_ASSIGN) == 0);
    return form;
}

static void put_indent(const struct printer *p)
{
    for (uint32_t i = 0; p->indent && i < p->node_count; i++)
        putc_unlocked('\t', p->out);
}

static void put_argument(struct printer *p, const struct csg_node *node,
                         const struct csg_argument *argument)
{
    if (argument->name)
        fprintf(p->out, "%s = ", argument->name);
    put_value(p, &argument->value, form_of(node, argument->name));
}

// The node up to its children.
static void put_head(struct printer *p, const struct csg_node *node)
{
    static const struct {
        uint8_t bit;
        char sign;
    } modifiers[] = {
        {CSG_ROOT, '!'}, {CSG_DISABLE, '*'}, {CSG_BACKGROUND, '%'}, {CSG_HIGHLIGHT, '#'}};

    for (size_t i = 0; i < array_count(modifiers); i++)
        if (node->modifiers & modifiers[i].bit)
            putc_unlocked(modifiers[i].sign, p->out);
    put_indent(p);
    if (strcmp(node->name, CSG_ASSIGN) == 0) {
        put_argument(p, node, &node->arguments[0]);
        return;
    }
    fprintf(p->out, "%s(", node->name);
    for (uint32_t i = 0; i < node->argument_count; i++) {
        if (i)
            fputs(", ", p->out);
        put_argument(p, node, &node->arguments[i]);
    }
    putc_unlocked(')', p->out);
}

static void enter(struct printer *p, const struct csg_node *node)
{
    array_reserve(&p->nodes, &p->node_capacity, (size_t)p->node_count + 1);
    p->nodes[p->node_count++] = node;
}

static uint32_t deepest(struct printer *p, const struct csg_node *node)
{
    uint32_t most = 0;

    while (node || p->node_count) {
        if (!node) {
            node = p->nodes[--p->node_count]->next;
        } else if (node->child) {
            enter(p, node);
            most = p->node_count > most ? p->node_count : most;
            node = node->child;
        } else {
            node = node->next;
        }
    }
    return most;
}

static void put_nodes(struct printer *p, const struct csg_node *node)
{
    while (node || p->node_count) {
        if (!node) {
            p->node_count--;
            put_indent(p);
            fputs("}\n", p->out);
            node = p->nodes[p->node_count]->next;
            continue;
        }
        put_head(p, node);
        if (node->child) {
            fputs(" {\n", p->out);
            enter(p, node);
            node = node->child;
        } else {
            fputs(";\n", p->out);
            node = node->next;
        }
    }
}

char *csg_print(const struct csg_tree *t, size_t *size)
{
    enum { DEEPEST_INDENTED = 10000 };
    struct printer p = {0};
    char *text = NULL;
    struct own_locale own = locale_enter();

    p.out = open_memstream(&text, size);
    if (!p.out)
        abort();
    p.indent = deepest(&p, t->first) <= DEEPEST_INDENTED;
    put_nodes(&p, t->first);
    putc_unlocked('\n', p.out);
    if (fclose(p.out) != 0)
        abort();
    locale_leave(&own);
    free(p.values);
    free(p.nodes);
    return text;
}
