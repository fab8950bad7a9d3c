// solid.h - one closed 3D shape in its own coordinates: what a leaf of the model places in space.
#pragma once
#include "geom/outline.h"

#include <stdint.h>

// Indexed triangles, counter-clockwise seen from outside; vertices equal in coordinates are one
// vertex. Several triangles may form one flat face: face[i] numbers the face of triangle i from 0,
// so that a face has one normal. {0} is a valid empty mesh.
struct mesh {
    struct vec3 *vertices;
    uint32_t vertex_count;
    uint32_t (*triangles)[3];
    uint32_t *faces;
    uint32_t triangle_count;
    uint32_t face_count;
    bool *turned; // per face: it was written the other way round and turned; NULL: none was
};

// A convex solid is also the intersection of the half-spaces nx x + ny y + nz z <= d of its faces
// (unit outward normals, plane i is face i). The four arrays are one allocation, aligned to 64
// bytes and padded to a multiple of 8 planes with copies of plane 0.
struct planes {
    double *nx, *ny, *nz, *d;
    uint32_t count, padded;
};

// What OpenSCAD draws of a solid, each with its borders when edges are wanted.
enum solid_cut {
    CUT_TRIANGLES, // of the mesh
    CUT_FACES,     // whole
    CUT_CAPS,      // faces across the z axis whole, of others the triangles
    CUT_SIDES,     // the other way round
};

struct solid {
    struct mesh mesh;
    struct planes planes; // count 0 unless convex
    struct box bounds;    // of the vertices
    bool convex;
    enum solid_cut cut;
    struct outline outline; // of a plate that shows a flat shape: that shape; else empty
    uint64_t hash;          // of the content: equal solids have equal hashes
};

void mesh_free(struct mesh *m);   // leaves {0}
void solid_free(struct solid *s); // leaves {0}
// Takes the mesh over (leaves *m empty); computes bounds and, when convex is said, the planes.
void solid_from_mesh(struct solid *out, struct mesh *m, bool convex, uint64_t hash);
