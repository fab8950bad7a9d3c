// hull.c - convex hulls.
#include "geom/hull.h"
