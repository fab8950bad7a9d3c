// minkowski.c - the Minkowski sum of two solids as a union of simple ones.
#include "geom/minkowski.h"
