// dexels.h - solids as what parallel rays along an axis meet.
#pragma once
#include "geom/solid.h"
#include "render/device.h"

enum { DEXELS_SIDE = 512 };

// One pixel's solid length and number of crossings, row by row.
struct dexels {
    double *length;
    uint32_t *crossings;
};

// The rays along axis 0, 1 or 2 over the box. They miss what lies on round coordinates.
struct rays dexels_rays(struct box box, int axis);

// Solid and gaps thinner than epsilon across their faces do not count.
void dexels_of_body(struct dexels *out, const struct body *body, const struct rays *rays,
                    double epsilon);
void dexels_of_mesh(struct dexels *out, const struct mesh *m, const struct rays *rays,
                    double epsilon);
void dexels_free(struct dexels *d);
