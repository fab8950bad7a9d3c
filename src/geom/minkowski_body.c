// minkowski_body.c - solids cut into surfaces that hang together, each with its voids.
#include "geom/minkowski_body.h"

#include "base/mem.h"
#include "base/sort.h"
#include "geom/hull.h"
#include "geom/mesh.h"

#include <stdlib.h>
#include <string.h>

static uint32_t find_root(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

static void join(uint32_t *parent, uint32_t i, uint32_t k)
{
    parent[find_root(parent, i)] = find_root(parent, k);
}

static uint32_t number_groups(uint32_t *parent, uint32_t count)
{
    uint32_t *number = mem_alloc((size_t)count * sizeof *number), groups = 0;
    for (uint32_t i = 0; i < count; i++)
        if (parent[i] == i)
            number[i] = groups++;
    for (uint32_t i = 0; i < count; i++)
        parent[i] = find_root(parent, i);
    for (uint32_t i = 0; i < count; i++)
        parent[i] = number[parent[i]];
    free(number);
    return groups;
}

uint32_t mesh_find_twins(const struct mesh *m, uint32_t *twins, uint32_t *group)
{
    uint32_t sides = m->triangle_count * 3;
    struct sort_item *items = mem_alloc((size_t)sides * 2 * sizeof *items);
    for (uint32_t h = 0; h < sides; h++) {
        uint32_t a = m->triangles[h / 3][h % 3], b = m->triangles[h / 3][(h + 1) % 3];
        uint64_t low = a < b ? a : b, high = a < b ? b : a;
        items[h] = (struct sort_item){low << 32 | high, h};
        twins[h] = UINT32_MAX;
    }
    sort_items(items, items + sides, sides);
    for (uint32_t t = 0; group && t < m->triangle_count; t++)
        group[t] = t;
    for (uint32_t i = 0, end; i < sides; i = end) {
        uint32_t first = items[i].index, second = items[i + 1 < sides ? i + 1 : i].index;
        for (end = i + 1; end < sides && items[end].key == items[i].key; end++)
            if (group)
                join(group, items[end].index / 3, first / 3);
        bool opposite =
            m->triangles[first / 3][first % 3] == m->triangles[second / 3][(second + 1) % 3];
        if (end - i == 2 && opposite) {
            twins[first] = second;
            twins[second] = first;
        }
    }
    free(items);
    return group ? number_groups(group, m->triangle_count) : 0;
}

// A closed surface of a solid.
struct shell {
    struct mesh mesh;
    struct box bounds;
    double volume; // below 0: a void
};

static void take_shells(struct shell *shells, uint32_t count, const struct mesh *m,
                        const uint32_t *shell_of)
{
    struct mesh_builder *builders = mem_zalloc((size_t)count * sizeof *builders);
    uint32_t *number = mem_alloc((size_t)m->vertex_count * sizeof *number);
    uint32_t *owner = mem_alloc((size_t)m->vertex_count * sizeof *owner);
    uint32_t *face = mem_alloc((size_t)m->face_count * sizeof *face);
    uint32_t *face_owner = mem_alloc((size_t)m->face_count * sizeof *face_owner);
    uint32_t *next = mem_alloc((size_t)m->triangle_count * sizeof *next);
    uint32_t *first = mem_alloc((size_t)count * sizeof *first);
    memset(owner, 0xff, (size_t)m->vertex_count * sizeof *owner);
    memset(face_owner, 0xff, (size_t)m->face_count * sizeof *face_owner);
    memset(first, 0xff, (size_t)count * sizeof *first);
    for (uint32_t t = m->triangle_count; t-- > 0; first[shell_of[t]] = t)
        next[t] = first[shell_of[t]];
    // One shell after the other: vertices and faces that several share are copied for each.
    for (uint32_t s = 0; s < count; s++) {
        struct mesh_builder *b = &builders[s];
        for (uint32_t t = first[s]; t != UINT32_MAX; t = next[t]) {
            uint32_t c[3], f = m->faces[t];
            for (int i = 0; i < 3; i++) {
                uint32_t v = m->triangles[t][i];
                if (owner[v] != s)
                    number[v] = mesh_add_vertex(b, m->vertices[v]);
                owner[v] = s;
                c[i] = number[v];
            }
            if (face_owner[f] != s)
                face[f] = mesh_add_face(b);
            face_owner[f] = s;
            mesh_add_triangle(b, c[0], c[1], c[2], face[f]);
        }
        shells[s] = (struct shell){b->mesh, mesh_bounds(&b->mesh), mesh_volume(&b->mesh)};
    }
    free(first);
    free(next);
    free(face_owner);
    free(face);
    free(owner);
    free(number);
    free(builders);
}

static bool box_holds(struct box outer, struct box inner)
{
    return outer.min.x <= inner.min.x && outer.min.y <= inner.min.y && outer.min.z <= inner.min.z &&
           outer.max.x >= inner.max.x && outer.max.y >= inner.max.y && outer.max.z >= inner.max.z;
}

// A void belongs to the surfaces around it; the box of one of them holds its box. Where comparing
// them would take long, all surfaces stay one body.
static uint32_t group_shells(const struct shell *shells, uint32_t count, uint32_t *body_of)
{
    uint32_t voids = 0;
    for (uint32_t i = 0; i < count; i++) {
        body_of[i] = i;
        voids += shells[i].volume < 0;
    }
    bool together = (uint64_t)voids * count > 1u << 26;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < count && (together || shells[i].volume < 0); k++)
            if (together ? k == 0 : k != i && box_holds(shells[k].bounds, shells[i].bounds))
                join(body_of, i, k);
    return number_groups(body_of, count);
}

static void append_mesh(struct mesh_builder *b, const struct mesh *m)
{
    uint32_t vertex = b->mesh.vertex_count, face = b->mesh.face_count;
    for (uint32_t v = 0; v < m->vertex_count; v++)
        mesh_add_vertex(b, m->vertices[v]);
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *c = m->triangles[t];
        mesh_add_triangle(b, vertex + c[0], vertex + c[1], vertex + c[2], face + m->faces[t]);
    }
    b->mesh.face_count += m->face_count;
}

// A surface with all the volume of its hull is the hull; that has whole faces and few corners.
// A flat one has no hull and is its two sides.
static void make_convex(struct body *b, bool known)
{
    struct mesh hull;
    if (!hull_solid(&hull, b->mesh.vertices, b->mesh.vertex_count))
        return;
    double volume = mesh_volume(&hull);
    b->convex = known || volume - mesh_volume(&b->mesh) <= 1e-9 * volume;
    if (!b->convex) {
        mesh_free(&hull);
        return;
    }
    mesh_free(&b->mesh);
    b->mesh = hull;
    b->anchors[0] = 0;
    corners_of_mesh(&b->corners_of_convex, &b->mesh);
}

static void measure(struct body *b)
{
    for (int w = 0; w < BODY_WIDTHS; w++) {
        int k = w + 14; // 0 to 26 are all directions of a cube, 13 none, the lower half opposite
        struct vec3 n = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        double low = INFINITY, high = -INFINITY;
        for (uint32_t v = 0; v < b->mesh.vertex_count; v++) {
            double d = vec3_dot(n, b->mesh.vertices[v]);
            low = fmin(low, d);
            high = fmax(high, d);
        }
        b->widths[w] = high - low;
    }
}

bool body_may_hold(const struct body *outer, const struct body *inner)
{
    // The widths of several surfaces together say nothing of a single one.
    for (int w = 0; w < BODY_WIDTHS && inner->anchor_count == 1; w++)
        if (inner->widths[w] > outer->widths[w] * (1 + 1e-12))
            return false;
    return true;
}

static void finish(struct body *b, bool known_convex)
{
    if (b->anchor_count == 1)
        make_convex(b, known_convex);
    if (!b->convex)
        body_cut_surface(b);
    measure(b);
}

static bool is_finite(const struct mesh *m)
{
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        struct vec3 p = m->vertices[v];
        if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z))
            return false;
    }
    return true;
}

void bodies_of_solid(struct bodies *out, const struct solid *s)
{
    const struct mesh *m = &s->mesh;
    *out = (struct bodies){0};
    if (!m->triangle_count || !is_finite(m))
        return;
    uint32_t *shell_of = mem_zalloc((size_t)m->triangle_count * sizeof *shell_of);
    uint32_t *twins = mem_alloc((size_t)m->triangle_count * 3 * sizeof *twins);
    uint32_t shell_count = s->convex ? 1 : mesh_find_twins(m, twins, shell_of);
    struct shell *shells = mem_alloc((size_t)shell_count * sizeof *shells);
    take_shells(shells, shell_count, m, shell_of);
    uint32_t *body_of = mem_alloc((size_t)shell_count * sizeof *body_of);
    out->count = group_shells(shells, shell_count, body_of);
    out->items = mem_zalloc((size_t)out->count * sizeof *out->items);
    struct mesh_builder *builders = mem_zalloc((size_t)out->count * sizeof *builders);
    uint32_t *room = mem_zalloc((size_t)out->count * sizeof *room);
    for (uint32_t i = 0; i < shell_count; i++) {
        struct body *b = &out->items[body_of[i]];
        if (shells[i].volume >= 0) {
            array_reserve(&b->anchors, &room[body_of[i]], (size_t)b->anchor_count + 1);
            b->anchors[b->anchor_count++] = builders[body_of[i]].mesh.vertex_count;
        }
        append_mesh(&builders[body_of[i]], &shells[i].mesh);
        mesh_free(&shells[i].mesh);
    }
    for (uint32_t i = 0; i < out->count; i++) {
        out->items[i].mesh = builders[i].mesh;
        finish(&out->items[i], s->convex);
    }
    free(room);
    free(builders);
    free(body_of);
    free(shells);
    free(twins);
    free(shell_of);
}

void bodies_free(struct bodies *b)
{
    for (uint32_t i = 0; i < b->count; i++) {
        struct body *body = &b->items[i];
        mesh_free(&body->mesh);
        corners_free(&body->corners_of_convex);
        free(body->anchors);
        free(body->pieces);
        free(body->edges);
        free(body->corners);
    }
    free(b->items);
    *b = (struct bodies){0};
}
