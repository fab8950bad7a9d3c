// rounds.c - radii and numbers of corners as arguments give them.
#include "model/rounds.h"

uint32_t corners_around(struct builder *b, const struct args *args, double r, uint32_t most)
{
    struct detail d = args->detail;
    if (d.fa < 0.01 || d.fs < 0.01) {
        builder_warn(b, args->node, "$fa or $fs below 0.01; 0.01 is taken");
        d.fa = fmax(d.fa, 0.01);
        d.fs = fmax(d.fs, 0.01);
    }
    uint32_t n = circle_fragments(r, d);
    if (n > most) {
        builder_warn(b, args->node, "%s() has too many corners around; %u are drawn",
                     args->node->name, most);
        n = most;
    }
    return n;
}

bool radius_of(struct builder *b, const struct args *args, uint32_t radius, uint32_t diameter,
               double *out)
{
    double d;
    bool has_radius = value_number(args->values[radius], out);
    if (!value_number(args->values[diameter], &d))
        return has_radius;
    if (has_radius)
        builder_warn(b, args->node, "%s() has a radius and a diameter; the diameter is taken",
                     args->node->name);
    *out = d / 2;
    return true;
}
