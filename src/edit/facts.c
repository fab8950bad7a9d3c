// facts.c - what there is to say about the nodes of a file.
#include "edit/facts.h"

#include "geom/border.h"

#include <stdlib.h>
#include <string.h>

static void add_colour(struct node_facts *n, const float colour[4], uint32_t leaves)
{
    if (!n->leaves)
        memcpy(n->colour, colour, sizeof n->colour);
    else if (memcmp(n->colour, colour, sizeof n->colour) != 0)
        n->several = true;
    n->leaves += leaves;
}

// What nodes have below them, added to their parents: those come before them.
static void add_up(struct facts *f, const struct source *s)
{
    for (uint32_t i = f->node_count; i-- > 0;) {
        const struct node_facts *n = &f->nodes[i];
        if (s->parent[i] == SOURCE_NONE || !n->leaves)
            continue;
        struct node_facts *parent = &f->nodes[s->parent[i]];
        parent->several |= n->several;
        add_colour(parent, n->colour, n->leaves);
    }
    for (uint32_t i = 0; i < f->node_count; i++)
        for (int k = 0; k < 4 && (f->nodes[i].several || !f->nodes[i].leaves); k++)
            f->nodes[i].colour[k] = -1;
}

void facts_make(struct facts *out, const struct source *s, const struct model *m)
{
    *out = (struct facts){.node_count = s->node_count, .body_count = m->body_count};
    out->nodes = mem_zalloc(((size_t)s->node_count + 1) * sizeof *out->nodes);
    out->node_of_leaf = mem_alloc((m->body_count + 1) * sizeof *out->node_of_leaf);
    for (uint32_t b = 0; b < m->body_count; b++) {
        const struct body *body = &m->bodies[b];
        uint32_t *nodes = mem_alloc(((size_t)body->leaf_count + 1) * sizeof *nodes);
        out->node_of_leaf[b] = nodes;
        for (uint32_t i = 0; i < body->leaf_count; i++) {
            const struct leaf *leaf = &body->leaves[i];
            nodes[i] = source_node_at(s, leaf->place.line, leaf->place.column);
            if (nodes[i] != SOURCE_NONE)
                add_colour(&out->nodes[nodes[i]], leaf->colour, 1);
        }
    }
    add_up(out, s);
}

void facts_free(struct facts *f)
{
    for (uint32_t i = 0; i < f->body_count; i++)
        free(f->node_of_leaf[i]);
    free(f->node_of_leaf);
    free(f->nodes);
    free(f->holes);
    *f = (struct facts){0};
}

// ---------------------------------------------------------------- crossings

void facts_clear_crossings(struct facts *f)
{
    for (uint32_t i = 0; i < f->node_count; i++)
        f->nodes[i].crossings = 0;
}

void facts_add_crossings(struct facts *f, const struct source *s, uint32_t body,
                         const uint64_t *crossings, uint32_t leaf_count)
{
    uint64_t *sums = mem_zalloc(((size_t)f->node_count + 1) * sizeof *sums);
    for (uint32_t i = 0; i < leaf_count; i++)
        if (f->node_of_leaf[body][i] != SOURCE_NONE)
            sums[f->node_of_leaf[body][i]] += crossings[i];
    for (uint32_t i = f->node_count; i-- > 0;) {
        f->nodes[i].crossings += sums[i];
        if (s->parent[i] != SOURCE_NONE)
            sums[s->parent[i]] += sums[i];
    }
    free(sums);
}

// ---------------------------------------------------------------- combinations

// Per class the nodes that have a leaf of it, each once.
struct owners {
    struct facts *facts;
    uint32_t *first; // per class and one more, into `nodes`
    uint32_t *nodes;
    uint32_t *stamp; // per node: of the newest round that met it
    uint32_t round, room;
};

struct member_leaf {
    uint32_t class_id, node;
};

static int compare_member_leaves(const void *a, const void *b)
{
    const struct member_leaf *p = a, *q = b;
    if (p->class_id != q->class_id)
        return p->class_id < q->class_id ? -1 : 1;
    return p->node < q->node ? -1 : p->node > q->node;
}

static void list_owners(struct owners *o, const struct source *s, const struct body *body,
                        const uint32_t *node_of_leaf)
{
    uint32_t classes = body->sharing.class_count, used = 0, count = 0, c = 0;
    struct member_leaf *leaves = mem_alloc(((size_t)body->leaf_count + 1) * sizeof *leaves);
    for (uint32_t i = 0; i < body->leaf_count; i++)
        if (body->sharing.class_of_leaf[i] != EXPR_NONE && node_of_leaf[i] != SOURCE_NONE)
            leaves[count++] = (struct member_leaf){body->sharing.class_of_leaf[i], node_of_leaf[i]};
    qsort(leaves, count, sizeof *leaves, compare_member_leaves);
    o->first = mem_alloc(((size_t)classes + 1) * sizeof *o->first);
    for (uint32_t i = 0; c < classes; c++) {
        o->first[c] = used;
        o->round++;
        for (; i < count && leaves[i].class_id == c; i++)
            for (uint32_t n = leaves[i].node; n != SOURCE_NONE && o->stamp[n] != o->round;
                 n = s->parent[n]) {
                o->stamp[n] = o->round;
                array_reserve(&o->nodes, &o->room, (size_t)used + 1);
                o->nodes[used++] = n;
            }
    }
    o->first[classes] = used;
    free(leaves);
}

static void count_one(void *context, const struct member *set, uint32_t count)
{
    struct owners *o = context;
    o->round++;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = o->first[set[i].class_id]; k < o->first[set[i].class_id + 1]; k++) {
            uint32_t n = o->nodes[k];
            o->facts->nodes[n].combinations += o->stamp[n] != o->round;
            o->stamp[n] = o->round;
        }
}

void facts_count_combinations(struct facts *f, const struct source *s, const struct model *m)
{
    for (uint32_t i = 0; i < f->node_count; i++)
        f->nodes[i].combinations = 0;
    for (uint32_t b = 0; b < f->body_count; b++) {
        struct owners o = {.facts = f};
        o.stamp = mem_zalloc(((size_t)f->node_count + 1) * sizeof *o.stamp);
        list_owners(&o, s, &m->bodies[b], f->node_of_leaf[b]);
        discovery_each(m->bodies[b].table, count_one, &o);
        free(o.stamp);
        free(o.first);
        free(o.nodes);
    }
}

// ---------------------------------------------------------------- holes

struct solid_leaf {
    const struct leaf *leaf;
    uint32_t node;
};

static int compare_solid_leaves(const void *a, const void *b)
{
    const struct solid_leaf *p = a, *q = b;
    uintptr_t x = (uintptr_t)p->leaf->solid, y = (uintptr_t)q->leaf->solid;
    if (x != y)
        return x < y ? -1 : 1;
    return p->node < q->node ? -1 : p->node > q->node;
}

static int compare_holes(const void *a, const void *b)
{
    uint32_t p = ((const struct hole *)a)->node, q = ((const struct hole *)b)->node;
    return p < q ? -1 : p > q;
}

// Leaves of meshes, those of one solid side by side.
static struct solid_leaf *list_meshes(const struct facts *f, const struct model *m, size_t *count)
{
    size_t all = 0;
    for (uint32_t b = 0; b < f->body_count; b++)
        all += m->bodies[b].leaf_count;
    struct solid_leaf *leaves = mem_alloc((all + 1) * sizeof *leaves);
    *count = 0;
    for (uint32_t b = 0; b < f->body_count; b++)
        for (uint32_t i = 0; i < m->bodies[b].leaf_count; i++) {
            const struct leaf *leaf = &m->bodies[b].leaves[i];
            if (!leaf->solid->convex && f->node_of_leaf[b][i] != SOURCE_NONE)
                leaves[(*count)++] = (struct solid_leaf){leaf, f->node_of_leaf[b][i]};
        }
    qsort(leaves, *count, sizeof *leaves, compare_solid_leaves);
    return leaves;
}

void facts_find_holes(struct facts *f, const struct source *s, const struct model *m)
{
    size_t count;
    struct solid_leaf *leaves = list_meshes(f, m, &count);
    bool open = false;
    struct vec3 middle = {0};
    uint32_t room = 0, kept = 0;
    free(f->holes);
    f->holes = NULL;
    f->hole_count = 0;
    for (size_t i = 0; i < count; i++) {
        const struct leaf *leaf = leaves[i].leaf;
        if (!i || leaf->solid != leaves[i - 1].leaf->solid)
            open = mesh_find_border(&leaf->solid->mesh, &middle);
        if (!open)
            continue;
        array_reserve(&f->holes, &room, (size_t)f->hole_count + 1);
        f->holes[f->hole_count++] =
            (struct hole){leaves[i].node, affine_point(&leaf->to_world, middle)};
    }
    free(leaves);
    if (f->hole_count)
        qsort(f->holes, f->hole_count, sizeof *f->holes, compare_holes);
    for (uint32_t i = 0; i < f->hole_count; i++)
        if (!kept || f->holes[i].node != f->holes[kept - 1].node)
            f->holes[kept++] = f->holes[i];
    f->hole_count = kept;
    for (uint32_t i = 0; i < f->node_count; i++)
        f->nodes[i].open = false;
    for (uint32_t i = 0; i < kept; i++)
        for (uint32_t n = f->holes[i].node; n != SOURCE_NONE && !f->nodes[n].open; n = s->parent[n])
            f->nodes[n].open = true;
}
