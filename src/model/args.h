// args.h - the arguments of a node by the names of its parameters.
#pragma once
#include "model/builder.h"

enum { PARAMETERS_MAX = 16 };

struct parameters {
    const char *names[PARAMETERS_MAX]; // NULL ends the list
    uint32_t positional;               // so many of them may be given without a name, in this order
};

struct args {
    const struct csg_node *node;
    const struct csg_value *values[PARAMETERS_MAX]; // NULL: not given
    struct detail detail;                           // $fn, $fa, $fs that hold in the node
    bool own_detail;                                // one of them was among the arguments
};

// Says what does not fit as warnings: unknown names, surplus and repeated arguments.
void args_bind(struct args *out, struct builder *b, const struct csg_node *node,
               const struct parameters *parameters, struct detail inherited);

// A value of another kind leaves *out alone and gives false.
bool value_number(const struct csg_value *v, double *out);
bool value_true(const struct csg_value *v); // only `true` itself
// All elements are numbers and there are between `least` and `most`: their number, else 0.
uint32_t value_numbers(const struct csg_value *v, double *out, uint32_t least, uint32_t most);
// Element of a vector of either kind as a value; *hold gives it a place.
const struct csg_value *value_item(const struct csg_value *v, uint32_t i, struct csg_value *hold);
bool value_is_vector(const struct csg_value *v);

// $fn, $fa, $fs of one name; false when it is none of them.
bool detail_set(struct detail *d, const char *name, const struct csg_value *v);
// Those that a block assigns, given its first node: they hold for all of it, also before the place
// where they stand. False when there are none.
bool detail_assigned(struct detail *d, const struct csg_node *first);
