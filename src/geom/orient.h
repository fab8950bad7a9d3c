// orient.h - turning triangles so that all of a closed mesh face the same way.
#pragma once
#include "geom/solid.h"

// Of a welded mesh in which every edge has exactly two triangles, but some neighbours face opposite
// ways: turns triangles until neighbours agree, and whole components that were mixed until they
// face outward. Components that agree already stay, as do meshes with other edges.
void mesh_orient(struct mesh *m);
