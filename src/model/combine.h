// combine.h - what nodes make of the objects below them; combine_*.c.
#pragma once
#include "model/operands.h"

extern const struct parameters parameters_linear_extrude, parameters_rotate_extrude,
    parameters_offset, parameters_fill, parameters_hull, parameters_minkowski, parameters_resize,
    parameters_projection;
void combine_linear_extrude(struct operands *o, struct value *out);
void combine_rotate_extrude(struct operands *o, struct value *out);
void combine_offset(struct operands *o, struct value *out);
void combine_fill(struct operands *o, struct value *out);
void combine_hull(struct operands *o, struct value *out);
void combine_minkowski(struct operands *o, struct value *out);
void combine_resize(struct operands *o, struct value *out);
void combine_projection(struct operands *o, struct value *out);
