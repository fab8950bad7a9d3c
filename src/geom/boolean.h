// boolean.h - union, intersection and difference of meshes as one mesh, on the CGAL library.
//
// Only where a node needs the vertices or the extent of a result; pictures need no such mesh.
#pragma once
#include "base/error.h"
#include "geom/solid.h"

#ifdef __cplusplus
extern "C" {
#endif

enum boolean_op { BOOLEAN_UNION, BOOLEAN_INTERSECTION, BOOLEAN_DIFFERENCE };

// Exact predicates throughout. An empty result is a result. False when an operand bounds no volume
// even after repair; err then says which. Thread-safe.
bool boolean_mesh(struct mesh *out, enum boolean_op op, const struct mesh *a, const struct mesh *b,
                  struct error *err);

#ifdef __cplusplus
}
#endif
