// mesh.h - building and measuring indexed triangle meshes.
#pragma once
#include "base/mem.h"
#include "geom/solid.h"

// A mesh that grows. {0} is a valid empty one; mesh_free(&b->mesh) gives it up.
struct mesh_builder {
    struct mesh mesh;
    uint32_t vertex_room, triangle_room, face_room;
};

uint32_t mesh_add_vertex(struct mesh_builder *b, struct vec3 p);
uint32_t mesh_add_face(struct mesh_builder *b); // the number for the triangles that follow
void mesh_add_triangle(struct mesh_builder *b, uint32_t i, uint32_t j, uint32_t k, uint32_t face);
// A flat convex polygon as one face: a fan around its first corner.
void mesh_add_convex(struct mesh_builder *b, const uint32_t *corners, uint32_t count);

// Drops triangles with two equal corners, vertices without triangles and faces without triangles.
// Keeps all orders.
void mesh_drop_unused(struct mesh *m);
// Merges vertices that are equal in coordinates (0 equals -0), then drops what is unused.
void mesh_weld(struct mesh *m);

struct box mesh_bounds(const struct mesh *m);
double mesh_area(const struct mesh *m);   // of all triangles
double mesh_volume(const struct mesh *m); // signed: positive when triangles face outward
// The map that takes z = 0 to the plane of the largest triangle, x and y to unit vectors in it.
void mesh_largest_plane(const struct mesh *m, struct affine *out);
