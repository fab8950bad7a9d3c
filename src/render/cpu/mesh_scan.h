// mesh_scan.h - crossings of triangles with the rays of a block, by scan conversion.
#pragma once
#include "render/cpu/tile.h"

#define mesh_scan ISA_PASTE(mesh_scan, ISA)

// Makes the pool's crossings those of the mesh of a leaf with the current block, in no order.
void mesh_scan(struct tile *t, const struct tile_leaf *l);
