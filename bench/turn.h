// turn.h - the views that every program of the bench draws.
//
// The camera of openscad without --camera: perspective, 22.5 degrees, rotation 55,0,25, looking at
// the centre of the model's box from where the sphere around that box just touches the edges of the
// picture (--viewall --autocenter). View i is turned by i * 360 / 13 degrees about z.
#pragma once
#include "model/model.h"
#include "render/rays.h"

enum { TURN_VIEWS = 13 };

struct rays turn_view(struct box scene, uint32_t view, int size); // any number; they repeat

// From the front, the right or the top, parallel, all of the model in view.
struct rays turn_side(struct box scene, uint32_t side, int size);
