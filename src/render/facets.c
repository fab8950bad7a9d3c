// facets.c - the triangles as which OpenSCAD draws solids, and which of their sides are edges.
#include "render/facets.h"

#include "base/mem.h"
#include "render/cpu/mesh_tree.h"

#include <stdlib.h>
#include <string.h>

#define NEARBY 1e-6 // of a solid's extent: what rounding may move a point of a face

struct cut_solid {
    const struct solid *solid;
    uint32_t *widest; // of each face, its largest triangle
    // Of one with whole faces, or convex.
    uint32_t *first;   // of each face in `corners`, and the end of the last
    uint32_t *corners; // around the faces: numbers of vertices
    // Of one with triangles.
    struct mesh_tree tree;
    double nearby;
};

struct facets {
    struct cut_solid *items; // sorted by solid
    uint32_t count;
};

static int by_solid(const void *a, const void *b)
{
    uintptr_t left = (uintptr_t)((const struct cut_solid *)a)->solid;
    uintptr_t right = (uintptr_t)((const struct cut_solid *)b)->solid;
    return (left > right) - (left < right);
}

static struct facet make(struct vec3 a, struct vec3 b, struct vec3 c, bool spokes)
{
    return (struct facet){
        {a, b, c}, vec3_cross(vec3_sub(b, a), vec3_sub(c, a)), {true, spokes, spokes}};
}

static struct facet triangle_of(const struct mesh *m, uint32_t number)
{
    const uint32_t *t = m->triangles[number];
    return make(m->vertices[t[0]], m->vertices[t[1]], m->vertices[t[2]], true);
}

// A side of a triangle.
struct side {
    uint32_t face, low, high; // its ends
    bool forward;             // runs from low to high
};

static int by_face(const void *a, const void *b)
{
    const struct side *l = a, *r = b;
    if (l->face != r->face)
        return l->face < r->face ? -1 : 1;
    if (l->low != r->low)
        return l->low < r->low ? -1 : 1;
    return (l->high > r->high) - (l->high < r->high);
}

static struct side *sorted_sides(const struct mesh *m, uint32_t *count)
{
    struct side *sides = mem_alloc((3 * (size_t)m->triangle_count + 1) * sizeof *sides);
    *count = 0;
    for (uint32_t t = 0; t < m->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t a = m->triangles[t][k], b = m->triangles[t][(k + 1) % 3];
            sides[(*count)++] = (struct side){m->faces[t], a < b ? a : b, a < b ? b : a, a < b};
        }
    qsort(sides, *count, sizeof *sides, by_face);
    return sides;
}

// Goes around each face along the sides that only one of its triangles has, from the first corner
// of its first triangle, where the face began when it was made.
static void find_borders(struct cut_solid *d)
{
    const struct mesh *m = &d->solid->mesh;
    uint32_t count, used = 0, i = 0;
    struct side *sides = sorted_sides(m, &count);
    uint32_t *start = mem_alloc(((size_t)m->face_count + 1) * sizeof *start);
    uint32_t *next = mem_zalloc(((size_t)m->vertex_count + 1) * sizeof *next);
    for (uint32_t t = m->triangle_count; t-- > 0;)
        start[m->faces[t]] = m->triangles[t][0];
    d->first = mem_alloc(((size_t)m->face_count + 1) * sizeof *d->first);
    d->corners = mem_alloc(((size_t)count + 1) * sizeof *d->corners);
    for (uint32_t face = 0; face < m->face_count; face++) {
        d->first[face] = used;
        uint32_t border = 0;
        for (; i < count && sides[i].face == face; i++) {
            if (i + 1 < count && by_face(&sides[i], &sides[i + 1]) == 0) {
                i++;
                continue;
            }
            const struct side *s = &sides[i];
            next[s->forward ? s->low : s->high] = s->forward ? s->high : s->low;
            border++;
        }
        uint32_t at = start[face];
        for (uint32_t k = 0; k < border; k++, at = next[at])
            d->corners[used++] = at;
    }
    d->first[m->face_count] = used;
    free(sides);
    free(start);
    free(next);
}

static void find_widest(struct cut_solid *d)
{
    const struct mesh *m = &d->solid->mesh;
    double *area = mem_zalloc(((size_t)m->face_count + 1) * sizeof *area);
    d->widest = mem_zalloc(((size_t)m->face_count + 1) * sizeof *d->widest);
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        double twice = vec3_length(triangle_of(m, t).normal);
        if (twice >= area[m->faces[t]]) {
            area[m->faces[t]] = twice;
            d->widest[m->faces[t]] = t;
        }
    }
    free(area);
}

static void prepare(struct cut_solid *d)
{
    struct box b = d->solid->bounds;
    d->nearby = NEARBY * vec3_length(vec3_sub(b.max, b.min));
    find_widest(d);
    if (d->solid->cut != CUT_TRIANGLES || d->solid->convex)
        find_borders(d);
    if (d->solid->cut != CUT_FACES)
        mesh_tree_build(&d->tree, &d->solid->mesh);
}

struct facets *facets_new(const struct model *m)
{
    struct cut_solid *all = NULL;
    uint32_t count = 0, room = 0, kept = 0;
    for (uint32_t b = 0; b < m->body_count; b++)
        for (uint32_t i = 0; i < m->bodies[b].leaf_count; i++) {
            array_reserve(&all, &room, count + 1);
            all[count++] = (struct cut_solid){.solid = m->bodies[b].leaves[i].solid};
        }
    if (count)
        qsort(all, count, sizeof *all, by_solid);
    for (uint32_t i = 0; i < count; i++)
        if (!kept || all[i].solid != all[kept - 1].solid)
            all[kept++] = all[i];
    for (uint32_t i = 0; i < kept; i++)
        prepare(&all[i]);
    struct facets *f = mem_alloc(sizeof *f);
    *f = (struct facets){all, kept};
    return f;
}

void facets_delete(struct facets *d)
{
    if (!d)
        return;
    for (uint32_t i = 0; i < d->count; i++) {
        free(d->items[i].first);
        free(d->items[i].corners);
        free(d->items[i].widest);
        mesh_tree_free(&d->items[i].tree);
    }
    free(d->items);
    free(d);
}

static struct vec3 shares_at(const struct facet *t, struct vec3 p)
{
    double square = vec3_dot(t->normal, t->normal), share[3];
    for (int k = 0; k < 3; k++) {
        struct vec3 a = t->corners[(k + 1) % 3], b = t->corners[(k + 2) % 3];
        share[k] = vec3_dot(t->normal, vec3_cross(vec3_sub(b, a), vec3_sub(p, a))) / square;
    }
    return (struct vec3){share[0], share[1], share[2]};
}

static struct vec3 meet(struct vec3 origin, struct vec3 direction, struct vec3 normal,
                        struct vec3 point)
{
    double along = vec3_dot(normal, vec3_sub(point, origin)) / vec3_dot(normal, direction);
    return vec3_add(origin, vec3_scale(direction, along));
}

struct vec3 facets_shares(const struct facet *t, struct vec3 origin, struct vec3 direction)
{
    return shares_at(t, meet(origin, direction, t->normal, t->corners[0]));
}

// Of the fan around the centre the triangle between whose spokes p lies.
static struct facet find_in_fan(const struct vec3 *v, const uint32_t *c, uint32_t n,
                                struct vec3 normal, struct vec3 p)
{
    struct vec3 centre = {0};
    for (uint32_t i = 0; i < n; i++)
        centre = vec3_add(centre, vec3_scale(v[c[i]], 1.0 / n));
    struct vec3 at = vec3_sub(p, centre), zero = vec3_sub(v[c[0]], centre);
    bool second_half = vec3_dot(normal, vec3_cross(zero, at)) < 0;
    uint32_t low = 0, high = n; // spoke `low` comes before p or meets it, spoke `high` does not
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        struct vec3 spoke = vec3_sub(v[c[middle]], centre);
        bool spoke_second = vec3_dot(normal, vec3_cross(zero, spoke)) < 0;
        bool behind = spoke_second == second_half ? vec3_dot(normal, vec3_cross(spoke, at)) < 0
                                                  : spoke_second;
        *(behind ? &high : &low) = middle;
    }
    return make(centre, v[c[low]], v[c[(low + 1) % n]], false);
}

static struct facet find_in_polygon(const struct cut_solid *d, uint32_t face, struct vec3 normal,
                                    struct vec3 p)
{
    const struct vec3 *v = d->solid->mesh.vertices;
    const uint32_t *c = d->corners + d->first[face];
    uint32_t n = d->first[face + 1] - d->first[face];
    if (n <= 3)
        return make(v[c[0]], v[c[1]], v[c[2]], true);
    if (n != 4)
        return find_in_fan(v, c, n, normal, p);
    struct facet t = make(v[c[0]], v[c[1]], v[c[3]], true);
    if (shares_at(&t, p).x < 0)
        t = make(v[c[2]], v[c[3]], v[c[1]], true);
    t.edge[0] = false;
    return t;
}

static bool is_in(struct box b, struct vec3 p, double tolerance)
{
    return p.x >= b.min.x - tolerance && p.y >= b.min.y - tolerance && p.z >= b.min.z - tolerance &&
           p.x <= b.max.x + tolerance && p.y <= b.max.y + tolerance && p.z <= b.max.z + tolerance;
}

static bool find_in_mesh(const struct cut_solid *d, uint32_t face, struct vec3 p, struct facet *out)
{
    const struct mesh *m = &d->solid->mesh;
    const struct mesh_tree *tree = &d->tree;
    double best = -INFINITY;
    uint32_t stack[128], depth = 0;
    stack[depth++] = 0;
    while (depth) {
        const struct mesh_node *node = &tree->nodes[stack[--depth]];
        if (!is_in(node->box, p, d->nearby))
            continue;
        if (!node->count) {
            stack[depth++] = node->first;
            stack[depth++] = node->first + 1;
        }
        for (uint32_t i = node->first; i < node->first + node->count; i++) {
            if (m->faces[tree->order[i]] != face)
                continue;
            struct facet t = triangle_of(m, tree->order[i]);
            struct vec3 s = shares_at(&t, p);
            double inside = fmin(s.x, fmin(s.y, s.z));
            if (inside > best) {
                best = inside;
                *out = t;
            }
        }
    }
    return best > -INFINITY;
}

static bool is_whole(const struct solid *s, struct vec3 normal)
{
    bool level = fabs(normal.x) + fabs(normal.y) <= 1e-9 * fabs(normal.z);
    return s->cut == CUT_FACES || (s->cut == CUT_CAPS && level) || (s->cut == CUT_SIDES && !level);
}

static const struct cut_solid *find(const struct facets *d, const struct solid *solid)
{
    const struct cut_solid key = {.solid = solid};
    return bsearch(&key, d->items, d->count, sizeof *d->items, by_solid);
}

const uint32_t *facets_corners(const struct facets *d, const struct solid *solid, uint32_t face,
                               uint32_t *count)
{
    if (!solid->convex)
        return NULL;
    const struct cut_solid *found = find(d, solid);
    *count = found->first[face + 1] - found->first[face];
    return found->corners + found->first[face];
}

bool facets_find(const struct facets *d, const struct solid *solid, uint32_t face,
                 struct vec3 origin, struct vec3 direction, struct facet *out)
{
    const struct cut_solid *found = find(d, solid);
    struct facet widest = triangle_of(&solid->mesh, found->widest[face]);
    struct vec3 p = meet(origin, direction, widest.normal, widest.corners[0]);
    if (!is_whole(solid, widest.normal))
        return find_in_mesh(found, face, p, out);
    if (found->first[face + 1] - found->first[face] < 3) // a needle
        return false;
    *out = find_in_polygon(found, face, widest.normal, p);
    return true;
}

void facets_sides(const struct facets *d, const struct solid *solid, void *context,
                  void (*side)(void *context, struct vec3 from, struct vec3 to))
{
    const struct cut_solid *found = find(d, solid);
    const struct mesh *m = &solid->mesh;
    for (uint32_t face = 0; face < m->face_count; face++) {
        if (!is_whole(solid, triangle_of(m, found->widest[face]).normal))
            continue;
        uint32_t first = found->first[face], end = found->first[face + 1];
        for (uint32_t i = first; i < end; i++)
            side(context, m->vertices[found->corners[i]],
                 m->vertices[found->corners[i + 1 < end ? i + 1 : first]]);
    }
    for (uint32_t t = 0; t < m->triangle_count && !solid->outline.path_count; t++) {
        if (is_whole(solid, triangle_of(m, found->widest[m->faces[t]]).normal))
            continue;
        for (int k = 0; k < 3; k++)
            side(context, m->vertices[m->triangles[t][k]],
                 m->vertices[m->triangles[t][(k + 1) % 3]]);
    }
}
