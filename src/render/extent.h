// extent.h - the box of what is solid, without ever making its mesh.
#pragma once
#include "render/device.h"

// Of the main body. Exact for unions of leaves, and on every side where the outermost leaf shows.
// Elsewhere it is measured in pictures along the axes, each refined around what stands out most,
// and right within EXTENT_TOLERANCE of the diagonal, unless what stands out is narrower than
// 1/EXTENT_PIXELS of the part of the outermost union that it belongs to, and touches nothing wider.
// Never larger than the box of the leaves. Empty when nothing is solid.
#define EXTENT_TOLERANCE 1e-6
enum { EXTENT_PIXELS = 192 };

struct box extent_find(struct cpu_device *d, const struct model *m,
                       const struct render_settings *settings);
