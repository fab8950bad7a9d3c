// compare.h - does the device's answer for a pixel agree with the oracle?
//
// A pixel is unstable when the oracle itself changes its mind nearby: when a solid or gap is
// between a fifth of and five times the filter's thickness, or when a ray a thousandth of a pixel
// aside sees other spans or a step in depth. There the device may give any of the answers seen
// nearby.
#pragma once
#include "subject.h"

enum fit { // what does not fit
    FITS,
    FIT_NO_LEAF,
    FIT_OWNER_TURNED,
    FIT_OWNER_IDLE,
    FIT_OWNER_ELSEWHERE,
    FIT_FACE,
    FIT_CAP_ELSEWHERE,
    FIT_CAP_OWNER,
    FIT_ENTER,
    FIT_LEAVE,
    FIT_VISITS,
    FIT_SPANS,
    FIT_OPEN_END,
    FIT_EXTRA,
    FIT_MISSING,
    FITS_COUNT
};
extern const char *const fit_text[FITS_COUNT];

enum verdict {
    VERDICT_AGREES,
    VERDICT_OWNER,       // but an end belongs to a coincident face that does not make it
    VERDICT_FORGIVEN,    // unstable, and one of the answers nearby
    VERDICT_UNEXPLAINED, // unstable, and none of them
    VERDICT_WRONG,
    VERDICTS
};

struct comparison { // {0} but for what is borrowed; one per thread
    const struct oracle *oracle;
    const struct rays *rays;
    double epsilon;
    double tolerance; // of depth
    struct oracle_ray ray, around[9];
    struct oracle_answer answer, trial;
    enum fit reason; // at the pixel itself
    bool strict;     // owners must face the right way and matter
    bool nearby;     // owners may be on any of the rays around
    double slack;    // faces closer than this times epsilon are in one place
};

enum verdict compare_pixel(struct comparison *c, const struct picture *p, int x, int y);
bool compare_unstable(struct comparison *c, int x, int y); // after compare_pixel of this pixel
void compare_free(struct comparison *c);
