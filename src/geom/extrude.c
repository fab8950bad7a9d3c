// extrude.c - solids from flat shapes, with OpenSCAD's vertices, slices and diagonals.
#include "geom/extrude.h"
