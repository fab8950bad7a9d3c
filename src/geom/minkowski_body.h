// minkowski_body.h - solids cut into what is added up to Minkowski sums.
#pragma once
#include "geom/convex_sum.h"

struct body_piece { // a convex part of a flat face, numbers of vertices in body.corners
    uint32_t first, count;
    struct vec3 normal;
};

struct body_edge { // between two faces
    uint32_t v[2]; // counter-clockwise along the first face
    struct vec3 normals[2];
    bool loose; // it has not just two sides
};

enum { BODY_WIDTHS = 13 };

// A part of a solid: a convex one, or one closed surface with the voids inside of it.
struct body {
    struct mesh mesh;
    bool convex;
    double widths[BODY_WIDTHS]; // extents along the axes and diagonals of a cube
    uint32_t *anchors;          // a vertex of each surface that bounds it from outside
    uint32_t anchor_count;
    struct corners corners_of_convex; // {0} unless convex; else the rest is empty
    struct body_piece *pieces;
    struct body_edge *edges;
    uint32_t *corners;
    uint32_t piece_count, piece_room, edge_count, edge_room, corner_count, corner_room;
};

struct bodies {
    struct body *items;
    uint32_t count, room;
};

// None of a solid with coordinates that are not finite.
void bodies_of_solid(struct bodies *out, const struct solid *s);
void bodies_free(struct bodies *b); // leaves {0}
// Whether a moved copy of `inner` might lie inside of `outer`; true when in doubt.
bool body_may_hold(const struct body *outer, const struct body *inner);

// The faces and edges of body.mesh as pieces and edges.
void body_cut_surface(struct body *b);

// For each side of each triangle (3 t + i runs from corner i on) the one that runs back along it;
// UINT32_MAX when these are not just two. *group, unless NULL, numbers triangles that hang together
// by sides from 0; returns how many numbers.
uint32_t mesh_find_twins(const struct mesh *m, uint32_t *twins, uint32_t *group);
