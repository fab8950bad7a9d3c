// read_surface.c - height fields from text (.dat) and PNG pictures.
#include "io/read_surface.h"
