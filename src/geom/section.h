// section.h - flat shapes from solids: what projection() makes of a leaf.
#pragma once
#include "geom/outline.h"
#include "geom/solid.h"

// The cut of a closed mesh with the plane z = 0, clean. Faces that lie in the plane count, whether
// the solid is above or below them. False when coordinates are beyond the range of clip.h.
bool section_cut(struct outline *out, const struct mesh *m);
// The shadow along z, clean, with the holes that light falls through.
bool section_shadow(struct outline *out, const struct mesh *m);
