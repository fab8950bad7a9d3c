// extent.h - the box of what is solid, without ever making its mesh.
#pragma once
#include "render/device.h"

// Of the main body. Exact for unions of leaves, and on every side where the outermost leaf shows.
// Elsewhere it is measured in pictures along the axes: one of the whole, then of each part of the
// outermost union that may reach further, refined around what stands out most. It is right within
// EXTENT_TOLERANCE of the diagonal, unless what stands out is narrower than 1/EXTENT_PIXELS of its
// part and touches nothing wider, or than that of the whole behind a hundred parts that may reach
// further and do not. Never larger than the box of the leaves. Empty when nothing is solid.
#define EXTENT_TOLERANCE 1e-6
enum { EXTENT_PIXELS = 192 };

struct box extent_find(struct device *d, const struct model *m,
                       const struct render_settings *settings);
