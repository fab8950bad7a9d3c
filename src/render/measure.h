// measure.h - volume, surface, centre of mass of a model, each with the error it may have.
//
// Parallel rays along x, y and z cut the solid into intervals. A lattice of rays of which each
// stands for the area c of its cell gives, along axis a,
//   volume   sum of c * length                    over intervals
//   moment   sum of c * length * position         over intervals
//   surface  sum of c * |n_a|, added for the axes over crossings with faces of unit normal n:
//            a face of area A is met by A * |n_a| / c rays along a, so that each axis counts
//            A * n_a^2, which is A for the three together; a face seen edge-on counts little
//            rather than being divided by its slope.
// A lattice whose origin is random within its cell is right on average for any solid, whatever its
// resolution. Six of them are thrown along each axis, turned by angles of irrational slope, so that
// no row of rays runs along edges; how much the sums of the six differ among each other tells how
// far off their mean may be. The bound is ten standard errors of that mean, which is about how far
// one of a million is off, and
// - what depths lose by rounding;
// - all of each leaf that no ray met and whose box is so small that it could have been missed;
// - for what the filter of thin intervals takes off sharp edges: as many crossings as there are
//   with solid or gaps of one to two epsilon, since in a wedge the ones below epsilon are as many;
//   twice that, for the spread.
// It rests on chance, and is no proof. The number of rays grows fourfold until the bounds of volume
// and area are as asked for or the effort is spent; what is reported is what was reached.
//
// Measured is what is drawn: the main body, without what is marked %. Numbers are the same for any
// number of threads.
#pragma once
#include "render/device.h"

#define MEASURE_ACCURACY 1e-3 // relative, for what people read

struct measured {
    double value, bound; // the true number is within value - bound .. value + bound
};

struct measure {
    bool flat;                 // all of it: area is that of the shapes, volume is 0
    struct measured volume;    // mm^3
    struct measured area;      // mm^2
    struct measured centre[3]; // of mass, mm; of an empty model 0
    uint64_t open_rays;        // on which a mesh did not close: with any, no bound holds
};

// Of the model's main body. `accuracy` is relative, at least 1e-6.
void measure_model(struct measure *out, struct device *device, const struct model *model,
                   const struct render_settings *settings, double accuracy);

// In g, of a material with `density` g/cm^3.
struct measured measure_mass(const struct measure *m, double density);
