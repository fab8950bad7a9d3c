// mesh_tree.c - a tree of boxes over the triangles of a mesh: halves of the longest axis by the
// median of the triangles' centres.
#include "render/cpu/mesh_tree.h"

#include "base/mem.h"

#include <stdlib.h>

enum { LEAF_TRIANGLES = 4 };

struct item {
    struct vec3 centre;
    struct box box;
    uint32_t triangle;
};

static double axis_of(struct vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// Moves the item of rank `k` to its place, smaller ones before it (Hoare's selection).
static void select_rank(struct item *items, uint32_t n, uint32_t k, int axis)
{
    uint32_t low = 0, high = n - 1;
    while (low < high) {
        double pivot = axis_of(items[low + (high - low) / 2].centre, axis);
        uint32_t i = low, j = high;
        for (;;) {
            while (axis_of(items[i].centre, axis) < pivot)
                i++;
            while (axis_of(items[j].centre, axis) > pivot)
                j--;
            if (i >= j)
                break;
            struct item swap = items[i];
            items[i++] = items[j];
            items[j--] = swap;
        }
        if (j < k)
            low = j + 1;
        else
            high = j;
    }
}

struct task {
    uint32_t node, first, count;
};

void mesh_tree_build(struct mesh_tree *out, const struct mesh *m)
{
    *out = (struct mesh_tree){0};
    uint32_t n = m->triangle_count;
    if (!n)
        return;
    struct item *items = mem_alloc(n * sizeof *items);
    for (uint32_t i = 0; i < n; i++) {
        struct box b = BOX_EMPTY;
        for (int k = 0; k < 3; k++)
            b = box_of_point(b, m->vertices[m->triangles[i][k]]);
        items[i] = (struct item){vec3_scale(vec3_add(b.min, b.max), 0.5), b, i};
    }
    out->nodes = mem_alloc((2 * (size_t)n + 1) * sizeof *out->nodes);
    struct task stack[64];
    uint32_t depth = 0;
    out->node_count = 1;
    stack[depth++] = (struct task){0, 0, n};
    while (depth) {
        struct task t = stack[--depth];
        struct mesh_node *node = &out->nodes[t.node];
        struct box centres = BOX_EMPTY;
        node->box = BOX_EMPTY;
        for (uint32_t i = t.first; i < t.first + t.count; i++) {
            node->box = box_union(node->box, items[i].box);
            centres = box_of_point(centres, items[i].centre);
        }
        if (t.count <= LEAF_TRIANGLES || depth + 2 > array_count(stack)) {
            node->first = t.first;
            node->count = t.count;
            continue;
        }
        struct vec3 size = vec3_sub(centres.max, centres.min);
        int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        uint32_t half = t.count / 2;
        select_rank(items + t.first, t.count, half, axis);
        node->first = out->node_count;
        node->count = 0;
        out->node_count += 2;
        stack[depth++] = (struct task){node->first, t.first, half};
        stack[depth++] = (struct task){node->first + 1, t.first + half, t.count - half};
    }
    out->order = mem_alloc(n * sizeof *out->order);
    for (uint32_t i = 0; i < n; i++)
        out->order[i] = items[i].triangle;
    free(items);
    out->nodes = mem_realloc(out->nodes, out->node_count * sizeof *out->nodes);
    out->bytes = out->node_count * sizeof *out->nodes + n * sizeof *out->order;
}

void mesh_tree_free(struct mesh_tree *t)
{
    free(t->nodes);
    free(t->order);
    *t = (struct mesh_tree){0};
}
