// read_svg.c - flat shapes from SVG pictures.
#include "io/read_svg.h"
