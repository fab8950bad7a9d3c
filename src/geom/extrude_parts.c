// extrude_parts.c - what the extrusions share: rings of the outline's points, and caps.
#include "geom/extrude_parts.h"

#include <stdlib.h>

static double triangles_of(const struct outline *o, double bands)
{
    return 2.0 * o->point_count * (bands + 1) + 4.0 * o->path_count;
}

bool rings_are_finite(const struct outline *o)
{
    bool finite = true;
    for (uint32_t i = 0; i < o->point_count; i++)
        finite &= isfinite(o->points[i].x) && isfinite(o->points[i].y);
    return finite;
}

bool rings_fit(const struct outline *o, double bands, struct error *err)
{
    if (triangles_of(o, bands) <= EXTRUSION_TRIANGLES_MOST)
        return true;
    error_set(err, "the extrusion would have more than %d triangles", EXTRUSION_TRIANGLES_MOST);
    return false;
}

void rings_reserve(struct rings *r, uint32_t bands)
{
    struct mesh_builder *b = &r->b;
    size_t triangles = (size_t)triangles_of(r->o, bands);
    array_reserve(&b->mesh.vertices, &b->vertex_room, (bands + 1ul) * r->o->point_count);
    array_reserve(&b->mesh.triangles, &b->triangle_room, triangles);
    array_reserve(&b->mesh.faces, &b->face_room, triangles);
}

void rings_cap(struct rings *r, uint32_t ring, bool reversed)
{
    if (!r->cap)
        outline_triangulate(r->o, &r->cap, &r->cap_count);
    uint32_t face = mesh_add_face(&r->b), first = ring * r->o->point_count;
    for (uint32_t t = 0; t < r->cap_count; t++) {
        uint32_t i = first + r->cap[t][0];
        uint32_t j = first + r->cap[t][reversed ? 2 : 1];
        uint32_t k = first + r->cap[t][reversed ? 1 : 2];
        mesh_add_triangle(&r->b, i, j, k, face);
    }
}

void rings_finish(struct rings *r, struct mesh *out)
{
    free(r->cap);
    *out = r->b.mesh;
    mesh_weld(out);
}
