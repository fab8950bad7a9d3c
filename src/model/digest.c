// digest.c - hashes of nodes with all that stands below them.
#include "model/digest.h"

#include "base/hash.h"

#include <stdlib.h>
#include <string.h>

struct level { // a node whose children are being taken in
    const struct csg_node *node, *next;
    uint32_t number;
};

static uint64_t hash_value(uint64_t h, const struct csg_value *value)
{
    // Vectors nest as deep as the file likes.
    const struct csg_value **stack = NULL, *v = value;
    uint32_t count = 0, room = 0;
    for (;;) {
        h = hash_mix(h ^ ((uint64_t)v->kind << 32 | v->count));
        switch (v->kind) {
        case CSG_UNDEF:
            break;
        case CSG_BOOL:
            h = hash_mix(h ^ v->boolean);
            break;
        case CSG_NUMBER:
            h = hash_bytes(h, &v->number, sizeof v->number);
            break;
        case CSG_STRING:
            h = hash_bytes(h, v->string, v->count);
            break;
        case CSG_NUMBERS:
        case CSG_RANGE:
            h = hash_bytes(h, v->numbers, v->count * sizeof *v->numbers);
            break;
        case CSG_VECTOR:
            array_reserve(&stack, &room, (size_t)count + v->count);
            for (uint32_t i = v->count; i-- > 0;)
                stack[count++] = &v->items[i];
            break;
        }
        if (!count)
            break;
        v = stack[--count];
    }
    free(stack);
    return h;
}

static uint64_t hash_node(const struct csg_node *n)
{
    uint64_t h = hash_bytes(n->modifiers, n->name, strlen(n->name));
    for (uint32_t i = 0; i < n->argument_count; i++) {
        const char *name = n->arguments[i].name;
        h = name ? hash_bytes(h, name, strlen(name)) : hash_mix(h);
        h = hash_value(h, &n->arguments[i].value);
    }
    return h;
}

struct digest *digest_tree(const struct csg_node *root)
{
    struct digest *digests = NULL;
    struct level *levels = NULL;
    uint32_t count = 0, room = 0, depth = 0, level_room = 0;
    for (const struct csg_node *n = root;;) {
        array_reserve(&digests, &room, (size_t)count + 1);
        array_reserve(&levels, &level_room, (size_t)depth + 1);
        digests[count].hash = hash_node(n);
        levels[depth++] = (struct level){n, n->child, count++};
        while (depth && !levels[depth - 1].next) {
            struct level done = levels[--depth];
            digests[done.number].nodes = count - done.number;
            if (!depth) {
                free(levels);
                return digests;
            }
            struct digest *parent = &digests[levels[depth - 1].number];
            parent->hash = hash_mix(parent->hash * 3 + digests[done.number].hash);
        }
        n = levels[depth - 1].next;
        levels[depth - 1].next = n->next;
    }
}
