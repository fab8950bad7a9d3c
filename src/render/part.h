// part.h - a part of a body as a body of its own, whose solids are borrowed.
#pragma once
#include "model/model.h"

// What stands under a node of the expression. *out must not move afterwards.
void part_init(struct body *out, const struct body *whole, uint32_t node);
// Fills what follows from leaves and expression. *body must not move afterwards.
void part_finish(struct body *body);
void part_free(struct body *part); // leaves {0}
