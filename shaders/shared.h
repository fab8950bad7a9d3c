// shared.h - what C and the shaders agree on: constants, numbers of bindings, layouts of records.
// Compiled as both. Records hold only uint, int, float, double and arrays of them, whose places are the
// same in C and std430; constants are #define.
#pragma once
#ifndef GL_core_profile
#include <stdint.h>
#define uint uint32_t
#endif

// Bindings of the buffers. Passes that bind two of one number never need both.
#define BIND_FRAME     0  // struct frame_data
#define BIND_LEAVES    1  // struct leaf_data, per leaf
#define BIND_VIEWS     2  // struct leaf_view, per leaf
#define BIND_VERTICES  3  // double[3], per vertex of all solids
#define BIND_TRIANGLES 4  // uint[3], per triangle of all solids: vertices of its solid
#define BIND_PLANES    5  // double[4], per triangle: unit normal n and d, n.p = d, local
#define BIND_FACES     6  // uint, per triangle
#define BIND_STARTS    7  // uint, per leaf: number of triangles drawn of the leaves before
#define BIND_LARGE     8  // uint[4], per piece of a large triangle
#define BIND_COUNTS    9  // uint, per pixel of the band, or per bin of keys
#define BIND_FRAGMENTS 10 // struct fragment
#define BIND_TABLE     11 // uint[2]: the records of hcsg/table.h
#define BIND_NODES     11 // uint: the expression, for the array method, which needs no table
#define BIND_STATES    12 // struct pixel_state, per pixel of the band
#define BIND_COUNTERS  13 // struct counters
#define BIND_OFFSETS   14 // uint, per pixel of the band and one more: its first fragment
#define BIND_LINKS     14 // uint: linked lists of fragments, see crossings.glsl
#define BIND_OUTPUT    15 // uint[3] per pixel: depth, leaf, face; or spans
#define BIND_VALUES    2  // uint[4], per leaf: value, class, leaf flags      (resolve)
#define BIND_PENDING   7  // uint: pixels to be walked                        (resolve)
#define BIND_MISSED    3  // uint: pixels that met an unknown combination     (resolve)
#define BIND_MISSES    8  // uint: records of unknown combinations            (resolve)
#define BIND_CLAIMS    9  // uint: which unknown combinations are recorded    (resolve)
#define BIND_SPANS     4  // uint, per pixel: how many spans it has            (resolve)
#define BIND_SCAN_IN   0  // uint                                             (scan)
#define BIND_SCAN_OUT  1  // uint                                             (scan)
#define BIND_SCAN_SUMS 2  // uint, per block                                  (scan)

#define GROUP_SIZE        64   // threads of a work group, but for:
#define SCAN_GROUP   256  // of the scan,
#define SCAN_BLOCK   1024 // which sums up so many numbers in a group
#define GROUPS_WIDE  32768u // groups in x of a dispatch; more of them go on in y
#define SMALL_PIXELS 32     // triangles whose rectangle has no more pixels take one thread
#define PIECE        32     // larger ones are cut into squares of so many pixels
#define BINS         256    // of a histogram of keys
#define REDUCE_SIDE  8      // of a square of rays of which one records what it misses
#define NO_PIXEL     0xffffffffu

// Grid of picture coordinates: 2^GRID_BITS units a pixel, at most 2^COORDINATE_BITS units in all.
#define GRID_BITS       18
#define COORDINATE_BITS 29
#define STEEP_LEAST     1e-3 // faces less steep than this count as that steep
#define CROSSINGS_MOST  0xf0000000u // in lists that are linked, as far as they can be counted
#define AHEAD           64   // clusters behind an unknown combination that are recorded as well
#define AHEAD_FRAMES    16   // the same where discovery goes on over frames, as in the paper

// Leaf flags.
#define LEAF_MIRRORED   1u
#define LEAF_SUBTRACTED 2u
#define LEAF_OPEN       4u  // winding numbers may not come back to 0
#define LEAF_WINDING    8u  // they may be other than that, or below 0
#define LEAF_REGION     16u // times 2^(2 axis + high): that side of its region of interest cuts it

// The low bit of fragment.leaf.
#define FRAGMENT_LEAVES 1u
// Bits of fragment.triangle.
#define FRAGMENT_MARK     0x80000000u // for the search for the owner of a cluster
#define FRAGMENT_BORDER   0x40000000u // no surface, but where the leaf meets its region's border
#define FRAGMENT_WINDING  0x20000000u // of a leaf with LEAF_WINDING, until that is settled
#define FRAGMENT_TRIANGLE 0x1fffffffu

#define BEYOND 3.4e38 // no key: behind everything

// Nodes of the expression, for the array method: 2^2 times the parent, and what a node does to it.
#define NODE_ADDS   0u
#define NODE_LIMITS 1u
#define NODE_CUTS   2u
#define NODE_ROOT   3u
#define NODE_INNER  0xffffffffu // in place of a class
#define NODE_WORDS  3

#define SURFACE_NO_LEAF  0xffffffffu
#define SURFACE_CAP_FACE 0xffffffffu

struct frame_data {
    double origin[3], forward[3], step_x[3], step_y[3]; // struct rays
    double axis[3];                                     // unit, into the picture
    double dual_x[3], dual_y[3]; // of a point relative to the eye: pixel times depth
    double t0, clip, near, far;
    double epsilon, margin; // of the filter; of regions of interest
    float start, end; // keys of near and far
    float to_depth, shift; // depth - reference = key / (1 - key * to_depth) + shift
    int width, height;
    int band, rows;      // of the picture: first row and number of rows
    int column, columns; // likewise; less than the width only for bands of one row
    uint orthographic, mirrored, borders; // mirrored: x, y and the depth are left-handed
    uint leaf_count, table_shift;
    float slab_end; // fragments up to this key are made
    uint slab_first, slab_last;
    uint pending; // pixels to be walked; 0: all of the band
    uint large_most, miss_most; // room for pieces; for words of misses
    uint crossings_most;        // room for crossings in lists that are linked
    uint windings;              // there are leaves with LEAF_WINDING
    uint claim_mask;            // number of claims, a power of two, less one
    uint ahead;                 // AHEAD or less
    float bins_from, bins_each; // of a histogram: first key; bins per unit
};

struct leaf_data {
    double to_world[12], to_local[12]; // affine, row by row
    double low[3], high[3];            // bounds of its solid, local
    double roi_low[3], roi_high[3];    // in the world
    uint first_vertex, first_triangle, triangle_count, flags;
};

struct leaf_view {
    double gx[4], gy[4], gt[4]; // of a local point: pixel times depth, twice; depth
    double origin[3], forward[3], step_x[3], step_y[3]; // the rays, local
    float x0, y0, x1, y1; // closed rectangle of pixels that holds every ray through it
    float near, far;      // keys that bound it
    int bits;             // a pixel is 2^bits units of the leaf's grid
    uint shows;
};

struct fragment {
    float key;
    uint leaf; // times two, and FRAGMENT_LEAVES
    uint triangle;
    float steep;
};

// Between slabs. What is nearer than `resume` is done with.
struct pixel_state {
    uint key[2];
    float resume;
    uint flags;
    float entered_key;
    uint entered_leaf, entered_face;
};
#define PIXEL_SOLID 1u
#define PIXEL_DONE  2u
#define PIXEL_MISSED 4u // OVER_FRAMES: what is in front of the slab still stands here

struct span_data {
    float enter, leave;
    uint enter_leaf, enter_face, leave_leaf, leave_face;
};

struct counters {
    uint large;  // pieces
    uint missed; // pixels
    uint misses; // words
    uint open;   // rays on which a mesh did not close
    uint alive;  // pixels that go on into the next slab
    uint resume; // the least of theirs, as an ordered number
    uint groups[3]; // of a dispatch, from `arguments`
    uint fragments; // in all
    uint wrapped;   // the number of pieces is larger than can be counted
};

#ifndef GL_core_profile
#undef uint
#endif
