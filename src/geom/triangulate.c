// triangulate.c - flat shapes: closed paths in the plane.
#include "geom/outline.h"
