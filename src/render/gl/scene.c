// scene.c - geometry and leaves for the shaders.
#include "render/gl/scene.h"

#include "base/mem.h"
#include "geom/border.h"
#include "geom/winding.h"
#include "shaders/shared.h"

#include <stdlib.h>
#include <string.h>

// Solids of a body, each once, in the order of their first leaves.
struct catalogue {
    struct entry {
        const struct solid *solid;
        uint32_t vertex, triangle; // first of it in the buffers
        uint32_t flags;            // of its leaves
    } * entries;
    uint32_t count;
    uint32_t *entry_of_leaf;
    uint32_t vertices, triangles;
};

struct solid_of_leaf {
    const struct solid *solid;
    uint32_t leaf;
};

static int compare_solids(const void *a, const void *b)
{
    const struct solid_of_leaf *p = a, *q = b;
    if (p->solid != q->solid)
        return (uintptr_t)p->solid < (uintptr_t)q->solid ? -1 : 1;
    return p->leaf < q->leaf ? -1 : p->leaf > q->leaf;
}

// What winding numbers around the solid may be.
static uint32_t winding_flags(const struct solid *s)
{
    if (s->convex)
        return 0;
    if (!mesh_is_balanced(&s->mesh, false))
        return LEAF_OPEN | LEAF_WINDING;
    return mesh_is_never_inside_out(&s->mesh) ? 0 : LEAF_WINDING;
}

// False when numbers of the shaders cannot count them: a fragment holds twice the number of its
// leaf, and the crossings of a ray are below 2^32 as long as those triangles are below 2^31, each
// of which may also be begun by the ray (fragments.comp.glsl).
static bool list_solids(struct catalogue *c, const struct body *body)
{
    struct solid_of_leaf *all = mem_alloc((body->leaf_count + 1) * sizeof *all);
    uint64_t vertices = 0, triangles = 0, placed = 0;
    c->entries = mem_alloc((body->leaf_count + 1) * sizeof *c->entries);
    c->entry_of_leaf = mem_alloc((body->leaf_count + 1) * sizeof *c->entry_of_leaf);
    for (uint32_t i = 0; i < body->leaf_count; i++)
        all[i] = (struct solid_of_leaf){body->leaves[i].solid, i};
    qsort(all, body->leaf_count, sizeof *all, compare_solids);
    for (uint32_t i = 0; i < body->leaf_count; i++) {
        const struct solid *s = all[i].solid;
        placed += s->mesh.triangle_count;
        if (!i || s != all[i - 1].solid) {
            c->entries[c->count++] =
                (struct entry){s, (uint32_t)vertices, (uint32_t)triangles, winding_flags(s)};
            vertices += s->mesh.vertex_count;
            triangles += s->mesh.triangle_count;
        }
        c->entry_of_leaf[all[i].leaf] = c->count - 1;
    }
    free(all);
    c->vertices = (uint32_t)vertices;
    c->triangles = (uint32_t)triangles;
    return vertices <= UINT32_MAX / 3 && triangles <= FRAGMENT_TRIANGLE && placed <= INT32_MAX &&
           body->leaf_count <= INT32_MAX;
}

static void catalogue_free(struct catalogue *c)
{
    free(c->entries);
    free(c->entry_of_leaf);
}

// The plane of a triangle, local: that of its face when the solid is convex.
static void plane_of(const struct solid *s, uint32_t triangle, double out[4])
{
    const struct mesh *m = &s->mesh;
    struct vec3 n, p = m->vertices[m->triangles[triangle][0]];
    double d;
    if (s->convex) {
        uint32_t face = m->faces[triangle];
        n = (struct vec3){s->planes.nx[face], s->planes.ny[face], s->planes.nz[face]};
        d = s->planes.d[face];
    } else {
        n = vec3_normalized(vec3_cross(vec3_sub(m->vertices[m->triangles[triangle][1]], p),
                                       vec3_sub(m->vertices[m->triangles[triangle][2]], p)));
        d = vec3_dot(n, p);
    }
    out[0] = n.x;
    out[1] = n.y;
    out[2] = n.z;
    out[3] = d;
}

static bool upload(struct gl_buffer *b, struct gl_memory *memory, const char *label,
                   const void *data, size_t size, struct error *err)
{
    if (!gl_buffer_fit(b, memory, label, size ? size : 4, err)) // an empty one cannot be bound
        return false;
    gl_buffer_write(b, 0, data, size);
    return true;
}

static bool upload_solids(struct gl_scene *s, struct gl_memory *memory, const struct catalogue *c,
                          struct error *err)
{
    size_t vertices = c->vertices, triangles = c->triangles;
    struct vec3 *points = mem_alloc((vertices + 1) * sizeof *points);
    uint32_t(*corners)[3] = mem_alloc((triangles + 1) * sizeof *corners);
    double(*planes)[4] = mem_alloc((triangles + 1) * sizeof *planes);
    uint32_t *faces = mem_alloc((triangles + 1) * sizeof *faces);
    for (uint32_t i = 0; i < c->count; i++) {
        const struct entry *e = &c->entries[i];
        const struct mesh *m = &e->solid->mesh;
        if (!m->triangle_count)
            continue;
        memcpy(points + e->vertex, m->vertices, m->vertex_count * sizeof *points);
        memcpy(corners + e->triangle, m->triangles, m->triangle_count * sizeof *corners);
        memcpy(faces + e->triangle, m->faces, m->triangle_count * sizeof *faces);
        for (uint32_t k = 0; k < m->triangle_count; k++)
            plane_of(e->solid, k, planes[e->triangle + k]);
    }
    bool fine =
        upload(&s->vertices, memory, "vertices", points, vertices * sizeof *points, err) &&
        upload(&s->triangles, memory, "triangles", corners, triangles * sizeof *corners, err) &&
        upload(&s->planes, memory, "planes", planes, triangles * sizeof *planes, err) &&
        upload(&s->faces, memory, "faces", faces, triangles * sizeof *faces, err);
    free(points);
    free(corners);
    free(planes);
    free(faces);
    return fine;
}

static void put_vec(double out[3], struct vec3 v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

// Which sides of the region of interest cut a convex leaf. Meshes are never cut: what is inside of
// them is known where they are crossed alone.
static uint32_t region_flags(const struct leaf *l, const struct box *roi)
{
    const double low[3] = {roi->min.x, roi->min.y, roi->min.z};
    const double high[3] = {roi->max.x, roi->max.y, roi->max.z};
    const double box_low[3] = {l->box.min.x, l->box.min.y, l->box.min.z};
    const double box_high[3] = {l->box.max.x, l->box.max.y, l->box.max.z};
    uint32_t flags = 0;
    for (int axis = 0; axis < 3 && l->solid->convex; axis++) {
        double slack = 1e-6 * (box_high[axis] - box_low[axis]);
        flags |= low[axis] - box_low[axis] > slack ? LEAF_REGION << 2 * axis : 0;
        flags |= box_high[axis] - high[axis] > slack ? LEAF_REGION << (2 * axis + 1) : 0;
    }
    return flags;
}

static bool upload_leaves(struct gl_scene *s, struct gl_memory *memory, const struct catalogue *c,
                          const struct body *body, struct error *err)
{
    size_t n = body->leaf_count;
    struct leaf_data *leaves = mem_zalloc((n + 1) * sizeof *leaves);
    s->flags = mem_alloc((n + 1) * sizeof *s->flags);
    for (uint32_t i = 0; i < n; i++) {
        const struct leaf *l = &body->leaves[i];
        const struct entry *e = &c->entries[c->entry_of_leaf[i]];
        struct leaf_data *out = &leaves[i];
        uint32_t class_id = body->sharing.class_of_leaf[i];
        memcpy(out->to_world, l->to_world.m, sizeof out->to_world);
        memcpy(out->to_local, l->to_local.m, sizeof out->to_local);
        put_vec(out->low, e->solid->bounds.min);
        put_vec(out->high, e->solid->bounds.max);
        out->first_vertex = e->vertex;
        out->first_triangle = e->triangle;
        // what cannot matter is not drawn
        out->triangle_count = class_id == EXPR_NONE ? 0 : e->solid->mesh.triangle_count;
        out->flags =
            e->flags | (l->mirrored ? LEAF_MIRRORED : 0) | (l->subtracted ? LEAF_SUBTRACTED : 0);
        s->windings = s->windings || (e->flags & LEAF_WINDING);
        if (body->roi) {
            put_vec(out->roi_low, body->roi[i].min);
            put_vec(out->roi_high, body->roi[i].max);
            out->flags |= region_flags(l, &body->roi[i]);
        }
        s->flags[i] = out->flags;
    }
    size_t values = (n ? n : 1) * sizeof(uint32_t[4]); // an empty one cannot be bound
    bool fine = upload(&s->leaves, memory, "leaves", leaves, n * sizeof *leaves, err) &&
                gl_buffer_fit(&s->values, memory, "values", values, err);
    free(leaves);
    s->leaf_count = body->leaf_count;
    if (fine)
        gl_scene_renew(s, body);
    return fine;
}

void gl_scene_renew(struct gl_scene *s, const struct body *body)
{
    size_t n = s->leaf_count;
    uint32_t(*values)[4] = mem_alloc((n + 1) * sizeof *values);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t class_id = body->sharing.class_of_leaf[i];
        uint64_t value = class_id == EXPR_NONE ? 0 : body->sharing.classes[class_id].value;
        values[i][0] = (uint32_t)value;
        values[i][1] = (uint32_t)(value >> 32);
        values[i][2] = class_id;
        values[i][3] = s->flags[i];
    }
    gl_buffer_write(&s->values, 0, values, n * sizeof *values);
    free(values);
    s->renewals = discovery_renewals(body->table);
}

bool gl_scene_upload(struct gl_scene *s, struct gl_memory *memory, const struct body *body,
                     struct error *err)
{
    struct catalogue c = {0};
    bool fine = list_solids(&c, body);
    if (!fine)
        error_set(err, "the model has more triangles than the gl device can count");
    fine = fine && upload_solids(s, memory, &c, err) && upload_leaves(s, memory, &c, body, err);
    catalogue_free(&c);
    return fine;
}

void gl_scene_free(struct gl_scene *s)
{
    gl_buffer_free(&s->vertices);
    gl_buffer_free(&s->triangles);
    gl_buffer_free(&s->planes);
    gl_buffer_free(&s->faces);
    gl_buffer_free(&s->leaves);
    gl_buffer_free(&s->values);
    free(s->flags);
    *s = (struct gl_scene){0};
}
