// border.c - whether a mesh is the border of a solid.
#include "geom/border.h"

#include "base/hash.h"

#include <stdlib.h>

struct edge {
    uint32_t from, to;
};

static struct edge edge_of(const struct mesh *m, uint32_t triangle, uint32_t side, bool as_written)
{
    const uint32_t *t = m->triangles[triangle];
    struct edge e = {t[side], t[(side + 1) % 3]};
    if (as_written && m->turned && m->turned[m->faces[triangle]])
        e = (struct edge){e.to, e.from};
    return e;
}

bool mesh_is_balanced(const struct mesh *m, bool as_written)
{
    // Each edge has a random number, which counts positive in one direction and negative in the
    // other: that the sum is 0 although edges are left has a chance of 2^-64.
    uint64_t sum = 0;
    for (uint32_t t = 0; t < m->triangle_count; t++)
        for (uint32_t i = 0; i < 3; i++) {
            struct edge e = edge_of(m, t, i, as_written);
            sum += e.from < e.to ? hash_mix((uint64_t)e.from << 32 | e.to)
                                 : -hash_mix((uint64_t)e.to << 32 | e.from);
        }
    return sum == 0;
}

static uint64_t undirected(const struct edge *e)
{
    return e->from < e->to ? (uint64_t)e->from << 32 | e->to : (uint64_t)e->to << 32 | e->from;
}

static int by_ends(const void *a, const void *b)
{
    uint64_t p = undirected(a), q = undirected(b);
    return p < q ? -1 : p > q;
}

static int by_start(const void *a, const void *b)
{
    const struct edge *p = a, *q = b;
    return p->from != q->from ? (p->from < q->from ? -1 : 1) : p->to < q->to ? -1 : p->to > q->to;
}

// The edges that are left when those in opposite directions have cancelled each other.
static struct edge *edges_left(const struct mesh *m, size_t *count)
{
    size_t all = (size_t)m->triangle_count * 3, next;
    struct edge *edges = mem_alloc(all * sizeof *edges);
    for (size_t i = 0; i < all; i++)
        edges[i] = edge_of(m, (uint32_t)(i / 3), (uint32_t)(i % 3), true);
    qsort(edges, all, sizeof *edges, by_ends);
    *count = 0;
    for (size_t i = 0; i < all; i = next) {
        struct edge e = edges[i], back = {e.to, e.from};
        size_t with = 0, against = 0;
        for (next = i; next < all && undirected(&edges[next]) == undirected(&e); next++)
            if (edges[next].from == e.from)
                with++;
            else
                against++;
        for (size_t k = against; k < with; k++)
            edges[(*count)++] = e;
        for (size_t k = with; k < against; k++)
            edges[(*count)++] = back;
    }
    qsort(edges, *count, sizeof *edges, by_start);
    return edges;
}

static bool has_area(const struct mesh *m, const uint32_t *loop, uint32_t count)
{
    struct vec3 o = m->vertices[loop[0]], twice = {0};
    double length = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct vec3 a = m->vertices[loop[i]], b = m->vertices[loop[(i + 1) % count]];
        twice = vec3_add(twice, vec3_cross(vec3_sub(a, o), vec3_sub(b, o)));
        length += vec3_length(vec3_sub(b, a));
    }
    return vec3_length(twice) > 1e-6 * length * length;
}

// The edges left make closed loops: into each vertex lead as many as out of it.
struct loops {
    const struct mesh *mesh;
    const struct edge *edges; // by their start
    size_t count;
    size_t *next;              // per vertex, of its edges the first that was not taken
    uint32_t *path, *position; // vertices, and where in the path each stands, from 1
    struct vec3 middle;        // of the loop that has an area
};

static struct vec3 middle_of(const struct mesh *m, const uint32_t *loop, uint32_t count)
{
    struct vec3 sum = {0};
    for (uint32_t i = 0; i < count; i++)
        sum = vec3_add(sum, m->vertices[loop[i]]);
    return vec3_scale(sum, 1.0 / count);
}

// Takes the loops that come back to a vertex, each once around without crossing itself.
static bool loops_have_area(struct loops *l, uint32_t start)
{
    uint32_t length = 0;
    l->path[length++] = start;
    l->position[start] = length;
    for (;;) {
        uint32_t last = l->path[length - 1];
        size_t edge = l->next[last];
        if (edge == l->count || l->edges[edge].from != last)
            break; // back at the start
        l->next[last]++;
        uint32_t to = l->edges[edge].to, first = l->position[to];
        if (!first) {
            l->path[length++] = to;
            l->position[to] = length;
            continue;
        }
        if (has_area(l->mesh, l->path + first - 1, length - first + 1)) {
            l->middle = middle_of(l->mesh, l->path + first - 1, length - first + 1);
            return true;
        }
        while (length > first)
            l->position[l->path[--length]] = 0;
    }
    l->position[start] = 0;
    return false;
}

static bool edges_have_area(const struct mesh *m, const struct edge *edges, size_t count,
                            struct vec3 *middle)
{
    uint32_t n = m->vertex_count;
    struct loops l = {.mesh = m, .edges = edges, .count = count};
    l.next = mem_alloc(n * sizeof *l.next);
    l.path = mem_alloc(n * sizeof *l.path);
    l.position = mem_zalloc(n * sizeof *l.position);
    bool area = false;
    for (size_t i = count; i-- > 0;)
        l.next[edges[i].from] = i;
    for (size_t i = 0; i < count && !area; i++)
        area = l.next[edges[i].from] == i && loops_have_area(&l, edges[i].from);
    if (area)
        *middle = l.middle;
    free(l.next);
    free(l.path);
    free(l.position);
    return area;
}

bool mesh_has_border(const struct mesh *m)
{
    struct vec3 middle;
    return mesh_find_border(m, &middle);
}

bool mesh_find_border(const struct mesh *m, struct vec3 *middle)
{
    if (mesh_is_balanced(m, true))
        return false;
    size_t count;
    struct edge *edges = edges_left(m, &count);
    bool area = edges_have_area(m, edges, count, middle);
    free(edges);
    return area;
}
