// polyhedron.c - meshes written out in the file.
#include "base/hash.h"
#include "geom/orient.h"
#include "model/nodes.h"

#include <stdlib.h>

const struct parameters parameters_polyhedron = {{"points", "faces", "convexity", "triangles"}, 3};

enum { KEY_POLYHEDRON = 0x706f6c79 };

// Faces one after another: `ends[i]` is where the corners of face i end.
struct face_list {
    uint32_t *corners, *ends;
    uint32_t corner_count, corner_room, count, end_room;
};

// Points that are none are told when a face uses them, and become NaN until then.
static bool read_points(struct builder *b, const struct args *args, struct mesh_builder *m)
{
    const struct csg_value *points = args->values[0];
    if (!value_is_vector(points)) {
        builder_warn(b, args->node, "polyhedron() needs a vector of points; left out");
        return false;
    }
    for (uint32_t i = 0; i < points->count; i++) {
        struct csg_value hold;
        double p[3] = {0};
        if (!value_numbers(value_item(points, i, &hold), p, 2, 3))
            p[0] = NAN;
        mesh_add_vertex(m, (struct vec3){p[0], p[1], p[2]});
    }
    return true;
}

// Corner lists are clockwise from outside; ours run the other way.
static void add_face(struct face_list *f, const uint32_t *corners, uint32_t count)
{
    array_reserve(&f->corners, &f->corner_room, (size_t)f->corner_count + count);
    array_reserve(&f->ends, &f->end_room, (size_t)f->count + 1);
    for (uint32_t i = count; i-- > 0;)
        f->corners[f->corner_count++] = corners[i];
    f->ends[f->count++] = f->corner_count;
}

// As OpenSCAD 2021.01 has it, the first face with a bad point is the end of the list.
static bool points_are_good(struct builder *b, const struct args *args, const struct mesh *points,
                            uint32_t face, const uint32_t *corners, uint32_t count)
{
    for (uint32_t k = 0; k < count; k++) {
        struct vec3 p = points->vertices[corners[k]];
        if (isfinite(p.x) && isfinite(p.y) && isfinite(p.z))
            continue;
        messages_add(b->messages, MESSAGE_ERROR, builder_place(b, args->node),
                     "polyhedron() point %u is not 2 or 3 finite numbers; the faces from %u on are "
                     "left out",
                     corners[k], face);
        return false;
    }
    return true;
}

static bool read_faces(struct builder *b, const struct args *args, const struct mesh *points,
                       struct face_list *out)
{
    uint32_t point_count = points->vertex_count;
    const struct csg_value *faces = args->values[1];
    if (!value_is_vector(faces))
        faces = args->values[3];
    if (!value_is_vector(faces)) {
        builder_warn(b, args->node, "polyhedron() needs a vector of faces; left out");
        return false;
    }
    uint32_t *corners = NULL, room = 0, bad = 0, small = 0;
    for (uint32_t i = 0; i < faces->count; i++) {
        struct csg_value hold, element;
        const struct csg_value *face = value_item(faces, i, &hold);
        uint32_t wanted = value_is_vector(face) ? face->count : 0, count = 0;
        array_reserve(&corners, &room, wanted);
        for (uint32_t k = 0; k < wanted; k++) {
            double index = -1;
            value_number(value_item(face, k, &element), &index);
            index = trunc(index);
            if (index >= 0 && index < point_count)
                corners[count++] = (uint32_t)index;
            else if (++bad == 1)
                builder_warn(b, args->node,
                             "polyhedron() face %u: no point has the number of corner %u; skipped",
                             i, k);
        }
        if (!points_are_good(b, args, points, i, corners, count))
            break;
        if (count >= 3)
            add_face(out, corners, count);
        else if (++small == 1)
            builder_warn(b, args->node, "polyhedron() face %u has fewer than 3 corners; left out",
                         i);
    }
    free(corners);
    if (bad > 1)
        builder_warn(b, args->node, "polyhedron() has %u such corners", bad);
    if (small > 1)
        builder_warn(b, args->node, "polyhedron() has %u such faces", small);
    return true;
}

static uint64_t key_of(const struct mesh *points, const struct face_list *f)
{
    uint64_t h = hash_bytes(KEY_POLYHEDRON, points->vertices,
                            points->vertex_count * sizeof *points->vertices);
    h = hash_bytes(h, f->ends, f->count * sizeof *f->ends);
    return hash_bytes(h, f->corners, f->corner_count * sizeof *f->corners);
}

// OpenSCAD's preview draws faces whichever way they are written, so files with faces that are
// turned the wrong way look right there: they are turned here.
static const struct solid *make_solid(struct builder *b, const struct args *args, uint64_t key,
                                      struct mesh_builder *m, const struct face_list *f)
{
    if (!b->cutter)
        b->cutter = polygon_cutter_new();
    uint32_t failed = 0;
    for (uint32_t i = 0, from = 0; i < f->count; from = f->ends[i++])
        failed += !polygon_cut(b->cutter, m, f->corners + from, f->ends[i] - from) &&
                  polygon_failed(b->cutter);
    if (failed)
        builder_warn(b, args->node, "polyhedron() " POLYGONS_LEFT_OUT, failed);
    mesh_weld(&m->mesh);
    mesh_orient(&m->mesh);
    // Not to be found ready, so that a reload says it again.
    return failed ? store_mesh(b->store, &m->mesh, false)
                  : store_add(b->store, key, &m->mesh, false, CUT_TRIANGLES);
}

const struct solid *shape_polyhedron(struct builder *b, const struct args *args, struct affine *out)
{
    (void)out; // stands where its points say
    const struct solid *solid = NULL;
    struct mesh_builder m = {0};
    struct face_list faces = {0};
    if (read_points(b, args, &m) && read_faces(b, args, &m.mesh, &faces)) {
        uint64_t key = key_of(&m.mesh, &faces);
        solid = store_find(b->store, key);
        if (!solid)
            solid = make_solid(b, args, key, &m, &faces);
        if (!solid->mesh.triangle_count)
            solid = NULL;
    }
    mesh_free(&m.mesh);
    free(faces.corners);
    free(faces.ends);
    return solid;
}
