// combination.c - evaluates combinations that the table does not know, and all of the array method.
#include "render/cpu/combination.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

enum { STEPS_FEW = 64 }; // more are sorted at once

void combination_init(struct combination *s, struct tile_room room)
{
    *s = (struct combination){.inside = mem_zalloc((room.leaves + 1) * sizeof *s->inside),
                              .solid = mem_zalloc(room.nodes + 1)};
}

size_t combination_bytes(const struct combination *s, struct tile_room room)
{
    return room.leaves * sizeof *s->inside + room.nodes +
           (s->member_capacity + s->base_capacity) * sizeof *s->members;
}

void combination_free(struct combination *s)
{
    free(s->members);
    free(s->base);
    free(s->inside);
    free(s->solid);
    expr_free(&s->counted);
    *s = (struct combination){0};
}

static void array_begin(struct combination *s, const struct body *body)
{
    uint64_t identity = discovery_identity(body->table);
    if (s->counted_identity != identity) {
        expr_free(&s->counted);
        sharing_expr(&s->counted, &body->expr, &body->sharing);
        s->counted_identity = identity;
    }
    memset(s->inside, 0, body->sharing.class_count * sizeof *s->inside);
}

void combination_begin(struct combination *s, struct tile *t)
{
    s->t = t;
    s->key = 0;
    s->base_count = 0;
    s->replayed = NULL;
    s->array = t->frame->settings->walk == WALK_ARRAY;
    if (s->array)
        array_begin(s, t->frame->body);
}

// Counts a crossing into the members, which stay sorted by class: mostly few, so a plain search.
static void member_step(struct combination *s, uint32_t class_id, bool in)
{
    struct member *members = s->members;
    uint32_t at = s->member_count;
    while (at > 0 && members[at - 1].class_id > class_id)
        at--;
    if (at == 0 || members[at - 1].class_id != class_id) {
        for (uint32_t i = s->member_count++; i > at; i--)
            members[i] = members[i - 1];
        members[at++] = (struct member){.class_id = class_id};
    }
    members[at - 1].count += in ? 1 : UINT32_MAX;
    if (!members[at - 1].count) {
        s->member_count--;
        for (uint32_t i = at - 1; i < s->member_count; i++)
            members[i] = members[i + 1];
    }
}

// Makes the members the combination of the base and the crossings items[0 .. n). Goes on from where
// the last call stopped if that was in front of n in the same list.
static void replay(struct combination *s, const crossing *items, uint32_t n)
{
    const uint32_t *class_of = s->t->frame->body->sharing.class_of_leaf;
    if (s->replayed != items || s->replayed_count > n) {
        array_reserve(&s->members, &s->member_capacity, s->base_count + 1);
        if (s->base_count)
            memcpy(s->members, s->base, s->base_count * sizeof *s->members);
        s->member_count = s->base_count;
        s->replayed = items;
        s->replayed_count = 0;
    }
    array_reserve(&s->members, &s->member_capacity, s->member_count + (n - s->replayed_count) + 1);
    bool many = n - s->replayed_count > STEPS_FEW;
    for (; s->replayed_count < n; s->replayed_count++) {
        uint32_t id = (uint32_t)items[s->replayed_count];
        uint32_t class_id = class_of[s->t->leaves[id >> 1].leaf];
        if (many)
            s->members[s->member_count++] = (struct member){class_id, id & 1 ? UINT32_MAX : 1};
        else
            member_step(s, class_id, !(id & 1));
    }
    if (many)
        s->member_count = members_settle(s->members, s->member_count);
}

void combination_carry(struct combination *s, const crossing *items, uint32_t taken)
{
    replay(s, items, taken);
    array_reserve(&s->base, &s->base_capacity, s->member_count + 1);
    memcpy(s->base, s->members, s->member_count * sizeof *s->base);
    s->base_count = s->member_count;
    combination_forget_list(s);
}

bool combination_discover(struct combination *s, const crossing *items, uint32_t n)
{
    replay(s, items, n);
    s->t->misses++;
    return discovery_resolve(s->t->frame->body->table, s->key, s->members, s->member_count) ==
           SET_SOLID;
}

// Lefebvre 2013: a counter per class, the whole expression over classes for each interval. For the
// bench.
bool combination_evaluate(struct combination *s)
{
    const struct expr *e = &s->counted;
    const struct value_class *classes = s->t->frame->body->sharing.classes;
    bool *solid = s->solid;
    for (uint32_t i = 0; i < e->node_count; i++) {
        const struct expr_node *n = &e->nodes[i];
        if (n->op == EXPR_LEAF) {
            const struct value_class *c = &classes[n->leaf];
            int32_t inside = s->inside[n->leaf];
            solid[i] = c->rule == CLASS_ALL ? inside == (int32_t)c->members : inside > 0;
            continue;
        }
        bool any = n->op == EXPR_UNION, value = !any;
        for (uint32_t k = 0; k < n->count && value != any; k++)
            value = solid[e->kids[n->first + k]];
        solid[i] = value && !(n->minus != EXPR_NONE && solid[n->minus]);
    }
    return e->node_count && solid[e->root];
}
