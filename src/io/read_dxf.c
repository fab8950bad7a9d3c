// read_dxf.c - flat shapes from DXF drawings.
#include "io/read_dxf.h"
