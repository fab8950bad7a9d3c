// sheet.h - matrices that press a shape flat, made invertible.
#pragma once
#include "base/vec.h"

// Does the map press space flat, exactly or but for the rounding of exported numbers?
bool sheet_is_flat(const struct affine *a);

// Gives the image of `local`, a box, at least the given thickness across its flat direction. False
// when the image is no sheet but a line or a point.
bool sheet_thicken(struct affine *a, struct box local, double thickness);
