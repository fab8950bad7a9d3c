// orient.h - turning triangles so that all of a closed mesh face the same way.
#pragma once
#include "geom/solid.h"

// Of a welded mesh in which every edge has exactly two triangles, but some neighbours face opposite
// ways: turns triangles until neighbours agree, and whole components that were mixed until they
// face outward. Components that agree already stay. Where edges have other numbers of triangles,
// one that is written twice is dropped once; if that does not help, none turns. The faces that
// were turned are in m->turned.
void mesh_orient(struct mesh *m);
