// scene.c - geometry and leaves for the shaders.
#include "render/gl/scene.h"

#include "base/mem.h"
#include "geom/border.h"
#include "geom/winding.h"
#include "shaders/shared.h"

#include <stdlib.h>
#include <string.h>

struct gl_solid {
    const struct solid *solid; // its memory may be gone: only compared, with the hash
    uint64_t hash;
    uint32_t vertex, triangle; // first of it in the buffers
    uint32_t flags;            // of its leaves
};

// What is to be uploaded.
struct catalogue {
    const struct solid **solids; // of which entries are made
    uint32_t vertices, triangles;
};

static int compare_solids(const void *a, const void *b)
{
    uintptr_t p = (uintptr_t) * (const struct solid *const *)a;
    uintptr_t q = (uintptr_t) * (const struct solid *const *)b;
    return p < q ? -1 : p > q;
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

static const struct gl_solid *find_solid(const struct gl_solids *s, const struct solid *solid)
{
    uint32_t low = 0, high = s->count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if ((uintptr_t)s->entries[middle].solid < (uintptr_t)solid)
            low = middle + 1;
        else
            high = middle;
    }
    bool there = low < s->count && s->entries[low].solid == solid;
    return there && s->entries[low].hash == solid->hash ? &s->entries[low] : NULL;
}

bool gl_solids_suffice(const struct gl_solids *s, const struct body *body)
{
    bool all = s != NULL;
    for (uint32_t i = 0; all && i < body->leaf_count; i++)
        all = find_solid(s, body->leaves[i].solid) != NULL;
    return all;
}

// False when numbers of the shaders cannot count them: a fragment holds twice the number of its
// leaf, and the crossings of a ray are below 2^32 as long as those triangles are below 2^31, each
// of which may also be begun by the ray (fragments.comp.glsl).
static bool are_countable(const struct body *body)
{
    uint64_t placed = 0;
    for (uint32_t i = 0; i < body->leaf_count; i++)
        placed += body->leaves[i].solid->mesh.triangle_count;
    return placed <= INT32_MAX && body->leaf_count <= INT32_MAX;
}

static bool list_solids(struct gl_solids *s, struct catalogue *c, const struct body *body)
{
    uint32_t n = body->leaf_count;
    uint64_t vertices = 0, triangles = 0;
    c->solids = mem_alloc(((size_t)n + 1) * sizeof *c->solids);
    s->entries = mem_alloc(((size_t)n + 1) * sizeof *s->entries);
    for (uint32_t i = 0; i < n; i++)
        c->solids[i] = body->leaves[i].solid;
    qsort(c->solids, n, sizeof *c->solids, compare_solids);
    for (uint32_t i = 0; i < n; i++) {
        const struct solid *solid = c->solids[i];
        if (i && solid == c->solids[i - 1])
            continue;
        s->entries[s->count++] = (struct gl_solid){solid, solid->hash, (uint32_t)vertices,
                                                   (uint32_t)triangles, winding_flags(solid)};
        vertices += solid->mesh.vertex_count;
        triangles += solid->mesh.triangle_count;
    }
    c->vertices = (uint32_t)vertices;
    c->triangles = (uint32_t)triangles;
    return vertices <= UINT32_MAX / 3 && triangles <= FRAGMENT_TRIANGLE;
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

static bool upload_solids(struct gl_solids *s, struct gl_memory *memory, const struct catalogue *c,
                          struct error *err)
{
    size_t vertices = c->vertices, triangles = c->triangles;
    struct vec3 *points = mem_alloc((vertices + 1) * sizeof *points);
    uint32_t(*corners)[3] = mem_alloc((triangles + 1) * sizeof *corners);
    double(*planes)[4] = mem_alloc((triangles + 1) * sizeof *planes);
    uint32_t *faces = mem_alloc((triangles + 1) * sizeof *faces);
    for (uint32_t i = 0; i < s->count; i++) {
        const struct gl_solid *e = &s->entries[i];
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

static bool upload_leaves(struct gl_scene *s, struct gl_memory *memory, const struct body *body,
                          struct error *err)
{
    size_t n = body->leaf_count;
    struct leaf_data *leaves = mem_zalloc((n + 1) * sizeof *leaves);
    s->flags = mem_alloc((n + 1) * sizeof *s->flags);
    for (uint32_t i = 0; i < n; i++) {
        const struct leaf *l = &body->leaves[i];
        const struct gl_solid *e = find_solid(s->solids, l->solid);
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

static void solids_release(struct gl_solids *s)
{
    if (!s || --s->references)
        return;
    gl_buffer_free(&s->vertices);
    gl_buffer_free(&s->triangles);
    gl_buffer_free(&s->planes);
    gl_buffer_free(&s->faces);
    free(s->entries);
    free(s);
}

static struct gl_solids *solids_new(struct gl_memory *memory, const struct body *body,
                                    struct error *err)
{
    struct gl_solids *s = mem_zalloc(sizeof *s);
    struct catalogue c = {0};
    s->references = 1;
    bool fine = list_solids(s, &c, body);
    if (!fine)
        error_set(err, "the model has more triangles than the gl device can count");
    if (!fine || !upload_solids(s, memory, &c, err)) {
        solids_release(s);
        s = NULL;
    }
    free(c.solids);
    return s;
}

bool gl_scene_upload(struct gl_scene *s, struct gl_memory *memory, const struct body *body,
                     struct gl_solids *solids, struct error *err)
{
    if (!are_countable(body)) {
        error_set(err, "the model has more triangles than the gl device can count");
        return false;
    }
    if (solids)
        solids->references++;
    s->solids = solids ? solids : solids_new(memory, body, err);
    return s->solids && upload_leaves(s, memory, body, err);
}

void gl_scene_free(struct gl_scene *s)
{
    solids_release(s->solids);
    gl_buffer_free(&s->leaves);
    gl_buffer_free(&s->values);
    free(s->flags);
    *s = (struct gl_scene){0};
}
