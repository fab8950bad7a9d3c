// tile.h - one tile of the picture: its leaves, their planes and triangles, their crossings per
// block.
//
// The files that include this are compiled once per instruction set; ISA names the variant. A
// worker owns one struct tile and uses it for tile after tile. All pools are of fixed size: what
// does not fit is forgotten and made again when it is asked for, so memory is bounded whatever the
// scene.
#pragma once
#include "base/simd.h"
#include "render/cpu/frame.h"

#ifndef ISA
#define ISA baseline
#endif
#define ISA_PASTE_(a, b) a##_##b
#define ISA_PASTE(a, b)  ISA_PASTE_(a, b)
#define tile_init        ISA_PASTE(tile_init, ISA)
#define tile_bytes       ISA_PASTE(tile_bytes, ISA)
#define tile_free        ISA_PASTE(tile_free, ISA)
#define tile_enter       ISA_PASTE(tile_enter, ISA)
#define tile_prepare     ISA_PASTE(tile_prepare, ISA)
#define tile_block       ISA_PASTE(tile_block, ISA)
#define tile_crossings   ISA_PASTE(tile_crossings, ISA)
#define tile_planes      ISA_PASTE(tile_planes, ISA)
#define tile_face        ISA_PASTE(tile_face, ISA)
#define tile_coplanar    ISA_PASTE(tile_coplanar, ISA)
#define tile_thickness   ISA_PASTE(tile_thickness, ISA)
#define tile_mesh_block  ISA_PASTE(tile_mesh_block, ISA)

// Steepness below this counts as this: it bounds how far along a ray faces can be within epsilon.
#define STEEP_LEAST 1e-3f

// As a face: the border of a leaf's region of interest, which is no surface.
#define FACE_REGION (UINT32_MAX - 1)

enum leaf_state { LEAF_NEW, LEAF_READY, LEAF_ABSENT };

// A leaf in the tile. Front planes bound the entry from below, back planes the exit from above.
struct tile_leaf {
    uint32_t frame_leaf; // index in frame.leaves
    uint32_t leaf;       // number in the body
    uint32_t part;
    enum leaf_state state;
    uint32_t plane, front, back; // in the plane pool: front planes, then back planes
    uint32_t serial;             // of the block for which `slot` holds
    uint32_t slot;               // in the block pool; SLOT_ABSENT: no ray of the block meets it
    float band;                  // of the newest block it was in, see block_leaf
    float near, far;             // keys that bound it
    float x0, y0, x1, y1;        // see frame_leaf
};
#define SLOT_ABSENT UINT32_MAX

// Planes of tile leaves: key(x, y) = a + b x + c y, pixels counted from the centre of the tile.
// Floats to find out which planes count, doubles for the constants of a block: on a face seen at a
// grazing angle a tile is many metres deep.
struct plane_exact {
    double a, b, c;
};
struct plane_pool {
    float *a, *b, *c, *slack;
    struct plane_exact *exact;
    // n . direction, thickness across the face per depth: steep + steep_x x + steep_y y
    float *steep, *steep_x, *steep_y;
    uint32_t *face;
    uint32_t used, size;
};

// Planes as key functions, negated for exits, so that in a list the largest key always counts.
// Padded with planes that are nowhere the largest.
struct plane_list {
    float *a, *b, *c, *slack; // slack bounds the rounding of the key
    uint32_t *id;
    uint32_t n;
};

// One interval of a mesh on a ray. SURFACE_CAP as a triangle: the start of the ray. Steepness as
// for planes.
struct mesh_interval {
    float enter, leave;
    uint32_t enter_triangle, leave_triangle;
    float enter_steep, leave_steep;
};

// The crossings of one leaf with the rays of one block. Convex leaves have one interval a ray, with
// enter > leave where the ray misses; meshes have intervals[first[i] .. first[i + 1]) for ray i.
struct block_leaf {
    _Alignas(32) float enter[BLOCK_PIXELS], leave[BLOCK_PIXELS];
    float near, far; // over all rays that hit
    float band;      // keys closer than this may be closer than epsilon across this leaf's faces
    bool mesh;
    uint32_t front, back; // planes that remain in this block, see tile_face
    uint32_t planes;      // in the index pool: front then back, numbers in the plane pool
    uint32_t interval;    // of a mesh: intervals[interval + first[i]] of the tile's pool is the
                          // first one of ray i
    bool known[2];        // planes of the entries, of the exits are found
    union {
        uint32_t first[BLOCK_PIXELS + 1]; // mesh
        uint32_t plane[2][BLOCK_PIXELS];  // convex: in the plane pool; UINT32_MAX: none
    };
};

// A crossing of a ray of the block with a triangle.
struct mesh_crossing {
    float key, steep;
    uint32_t triangle;
    int16_t sign; // 1 enters, -1 leaves
    uint16_t ray;
};

struct mesh_pool {
    struct mesh_crossing *crossings, *sorted;
    uint32_t crossing_count, crossing_capacity, sorted_capacity;
    struct mesh_interval *intervals; // of all mesh leaves of the block
    uint32_t interval_count, interval_capacity;
};

// What the pools were made for.
struct tile_room {
    size_t memory;   // budget of one worker
    uint32_t planes; // of the largest convex solid
    uint32_t leaves, nodes;
};

struct tile {
    const struct frame *frame; // of the picture being drawn
    uint32_t worker;
    struct tile_room room;
    int x0, y0, x1, y1;                     // pixels [x0, x1) x [y0, y1)
    double cx, cy;                          // the centre, in pixel coordinates
    struct vec3 origin, direction, middle;  // the ray there; middle is at t0
    float slope_x, slope_y, lean_x, lean_y; // of the ray there, see put_steepness in planes.c

    struct tile_leaf *leaves;
    uint32_t leaf_count, leaf_capacity;
    struct plane_pool planes;

    // the current block
    uint32_t serial;
    float limit;  // crossings of leaves that begin beyond this key are not asked for
    int bx, by;   // its first pixel
    float mx, my; // its middle, in pixels from the centre of the tile
    struct block_leaf *slots;
    uint32_t slot_count, slot_size;
    uint32_t *index; // plane numbers of block leaves
    float *key;      // and their keys in the middle of the block
    uint32_t index_used, index_size;

    struct mesh_pool mesh;
    v8i front_lanes[256];   // for v8_permute: the lanes of the set bits of a number first
    float *scratch[5];      // planes_most floats each
    double *exact[3];       // planes_most
    struct plane_list list; // room for planes_most

    struct query *query;
    struct walk_lists *lists;
    uint64_t fragments, misses, open_rays;
};

// Planes of the leaf over the whole tile, which tightens near and far; may find it absent.
void tile_prepare(struct tile *t, struct tile_leaf *l);

// Pixels of a block from its middle: columns, and with [y] rows.
#define BLOCK_STEPS ((v8f){-3.5f, -2.5f, -1.5f, -0.5f, 0.5f, 1.5f, 2.5f, 3.5f})

void tile_init(struct tile *t, struct tile_room room, uint32_t worker);
size_t tile_bytes(const struct tile *t);
void tile_free(struct tile *t);

// Moves on to a tile: finds its leaves, parts front to back.
void tile_enter(struct tile *t, uint32_t tile_number);
// Moves on to the block at pixel (x, y) of the tile.
void tile_block(struct tile *t, int x, int y);

// The crossings of a leaf with the current block; NULL when no ray meets it. Valid until the next
// call.
struct block_leaf *tile_crossings(struct tile *t, struct tile_leaf *l);

// The planes by which the rays enter (or leave) a convex leaf, numbers in the plane pool.
const uint32_t *tile_planes(const struct tile *t, struct block_leaf *b, bool leaving);

// Which face the ray of pixel i enters (or leaves) a leaf by at `key`, and how steep the ray meets
// it. SURFACE_CAP when the key is the start of the ray.
uint32_t tile_face(struct tile *t, struct tile_leaf *l, int i, bool leaving, float key,
                   float *steep);

// Do the faces of two crossings of the ray of pixel i, that are known to be at one place, lie in
// one plane? Yes when one of them is none: the start of the ray, the border of a region.
struct face_at {
    struct tile_leaf *leaf;
    bool leaving;
    float key;
};
bool tile_coplanar(struct tile *t, int i, struct face_at a, struct face_at b);

// Thickness in mm across the faces of the interval between two keys on a ray of this tile.
double tile_thickness(const struct tile *t, float from, float to, float steep);

// mesh.c: the crossings of a mesh with the current block, or NULL.
struct block_leaf *tile_mesh_block(struct tile *t, struct tile_leaf *l, struct block_leaf *out);
