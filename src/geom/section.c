// section.c - flat shapes from solids: what projection() makes of a leaf.
#include "geom/section.h"
