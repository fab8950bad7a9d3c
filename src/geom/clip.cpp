// clip.cpp - 2D booleans, offsets and sums, on the Clipper library with OpenSCAD's grid.
#include "geom/clip.h"
