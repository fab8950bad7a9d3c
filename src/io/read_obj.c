// read_obj.c - Wavefront OBJ meshes.
#include "io/read_obj.h"
