// lattice.h - sums over the solid intervals that a lattice of parallel rays meets.
#pragma once
#include "render/device.h"
#include "render/normals.h"

// What lattices are thrown at. `seen` (per leaf of the body) is set for leaves that a ray enters or
// leaves the solid through.
struct lattice_target {
    struct device *device;
    const struct body *body;
    const struct normals *normals;
    struct render_settings settings;
    struct box box; // holds all that is solid
    atomic_bool *seen;
};

// Rays along `axis`: `rays` of them (about) meet the box, in rows turned by `angle` about the axis.
// `random` is the state of random_next that gives the lattice its place.
struct lattice {
    int axis;
    double rays, angle;
    uint64_t random;
};

struct lattice_sums {
    double cell;        // area that one ray stands for
    double covered;     // cells of rays that meet something solid
    double volume;      // cells times lengths
    struct vec3 moment; // of the volume, about the centre of the box
    double area;        // cells times |n| along the axis over crossings: of faces, their share
    double thin;        // of it, faces around solid or a gap thinner than twice epsilon
    double crossings;   // their number
    double effort;      // rays and crossings looked at
    uint64_t open_rays; // on which a mesh did not close
};

// The same numbers for any number of threads.
void lattice_sum(struct lattice_sums *out, const struct lattice_target *target,
                 const struct lattice *lattice);
