// agree.h - do two pictures of a body agree, pixel by pixel?
//
// Devices round differently, so that the border of a shape may lie a pixel further. Away from such
// places depths have to be equal. A pixel is at a silhouette when what it shows in the first
// picture does not go on in one of its neighbours there: when the planes of the two faces do not
// meet between their centres.
#pragma once
#include "subject.h"

// Of first surfaces, or of all spans.
struct agreement_of {
    uint64_t others; // pixels with another leaf, or with other leaves at the ends of their spans
    uint64_t apart;  // of these: with another depth too
    double depth; // largest difference away from silhouettes; INFINITY: there only in one picture
    int x, y;     // of that, or the first with another leaf when no depth is beyond the tolerance
};

struct agreement {
    uint64_t pixels, hits, silhouettes;
    uint64_t unequal; // pictures of the second way that its settings have changed
    struct agreement_of surface, spans;
};

// `tolerance`: depths that differ by less are one, and such a step is no silhouette.
void agree_compare(struct agreement *out, const struct body *body, const struct rays *rays,
                   const struct picture *first, const struct picture *second, double tolerance);
void agree_add(struct agreement *sum, const struct agreement *one);
