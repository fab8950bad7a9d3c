// args.c - the arguments of a node by the names of its parameters.
#include "model/args.h"

#include <string.h>

bool value_number(const struct csg_value *v, double *out)
{
    if (!v || v->kind != CSG_NUMBER)
        return false;
    *out = v->number;
    return true;
}

bool value_true(const struct csg_value *v)
{
    return v && v->kind == CSG_BOOL && v->boolean;
}

bool value_is_vector(const struct csg_value *v)
{
    return v && (v->kind == CSG_VECTOR || v->kind == CSG_NUMBERS);
}

const struct csg_value *value_item(const struct csg_value *v, uint32_t i, struct csg_value *hold)
{
    if (v->kind == CSG_VECTOR)
        return &v->items[i];
    *hold = (struct csg_value){.kind = CSG_NUMBER, .number = v->numbers[i]};
    return hold;
}

uint32_t value_numbers(const struct csg_value *v, double *out, uint32_t least, uint32_t most)
{
    if (!v || v->kind != CSG_NUMBERS || v->count < least || v->count > most)
        return 0;
    memcpy(out, v->numbers, v->count * sizeof *out);
    return v->count;
}

bool detail_set(struct detail *d, const char *name, const struct csg_value *v)
{
    if (strcmp(name, "$fn") == 0)
        value_number(v, &d->fn);
    else if (strcmp(name, "$fa") == 0)
        value_number(v, &d->fa);
    else if (strcmp(name, "$fs") == 0)
        value_number(v, &d->fs);
    else
        return false;
    return true;
}

bool detail_assigned(struct detail *d, const struct csg_node *first)
{
    bool any = false;
    for (const struct csg_node *n = first; n; n = n->next)
        if (n->name[0] == CSG_ASSIGN[0] && n->argument_count == 1)
            any |= detail_set(d, n->arguments[0].name, &n->arguments[0].value);
    return any;
}

static uint32_t parameter_number(const struct parameters *p, const char *name)
{
    for (uint32_t i = 0; i < PARAMETERS_MAX && p->names[i]; i++)
        if (strcmp(p->names[i], name) == 0)
            return i;
    return PARAMETERS_MAX;
}

void args_bind(struct args *out, struct builder *b, const struct csg_node *node,
               const struct parameters *parameters, struct detail inherited)
{
    *out = (struct args){.node = node, .detail = inherited};
    uint32_t position = 0, surplus = 0;
    for (uint32_t i = 0; i < node->argument_count; i++) {
        const struct csg_argument *a = &node->arguments[i];
        if (!a->name) {
            if (position < parameters->positional)
                out->values[position] = &a->value;
            else
                surplus++;
            position++;
            continue;
        }
        if (a->name[0] == '$') {
            out->own_detail |= detail_set(&out->detail, a->name, &a->value);
            continue;
        }
        uint32_t number = parameter_number(parameters, a->name);
        if (number == PARAMETERS_MAX) {
            builder_warn(b, node, "%s() has no parameter '%s'; ignored", node->name, a->name);
            continue;
        }
        if (out->values[number])
            builder_warn(b, node, "argument '%s' given twice; the last one holds", a->name);
        out->values[number] = &a->value;
    }
    if (surplus)
        builder_warn(b, node, "%u arguments too many for %s(); ignored", surplus, node->name);
}
