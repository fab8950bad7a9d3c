// rounds.h - radii and numbers of corners as arguments give them.
#pragma once
#include "model/args.h"

// The number of corners around, with the limits that OpenSCAD sets and one of ours.
uint32_t corners_around(struct builder *b, const struct args *args, double r, uint32_t most);
// The radius that two parameters give together: a diameter beats a radius. False when neither is
// there.
bool radius_of(struct builder *b, const struct args *args, uint32_t radius, uint32_t diameter,
               double *out);
