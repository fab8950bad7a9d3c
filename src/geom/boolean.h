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

// Cut exactly, then rounded. Operands may touch and cross themselves, be inside out, or disagree on
// where outside is; the result may touch itself along edges. An empty result is a result. False
// when an operand is not closed; err then says which. Thread-safe.
bool boolean_mesh(struct mesh *out, enum boolean_op op, const struct mesh *a, const struct mesh *b,
                  struct error *err);

#ifdef __cplusplus
}
#endif
