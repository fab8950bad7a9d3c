// boolean.cpp - union, intersection and difference of meshes as one mesh, on the CGAL library.
#include "geom/boolean.h"
