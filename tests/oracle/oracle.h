// oracle.h - the truth: one ray, all triangles, the plain expression, in double precision.
//
// Shares nothing with the devices or the core. A ray meets a closed mesh an even number of times
// because edges are decided by exact signs, ties by a symbolic shift of the ray.
#pragma once
#include "geom/solid.h"
#include "hcsg/expr.h"
#include "render/rays.h"

struct oracle_leaf {
    const struct mesh *mesh; // borrowed
    struct affine to_world;
};

struct oracle_placed {               // a leaf in the world
    struct vec3 *vertices, *normals; // a normal per triangle, outward, of length 1 (0: degenerate)
    const struct mesh *mesh;
    int sign; // -1: mirrored
    struct vec3 centre;
    double radius; // of a sphere around all of it
};

struct oracle {
    struct oracle_placed *leaves;
    uint32_t leaf_count;
    int *polarity;                   // per leaf: -1 under an odd number of subtractions, else 1
    const struct expr_token *tokens; // borrowed
    size_t token_count;
    uint32_t max_vertices;
};

struct oracle_crossing {
    double depth;
    struct vec3 normal; // of the face in the world
    double cosine;      // |normal . direction|: depth times it is thickness across the face
    uint32_t leaf, face;
    int delta; // +1 into the leaf, -1 out of it
};

enum oracle_bound { BOUND_FACE, BOUND_NEAR, BOUND_FAR };

struct oracle_boundary { // where the result changes, before the filter
    double depth, cosine;
    struct vec3 normal;
    enum oracle_bound kind;
};

struct oracle_ray { // {0} is valid; one per thread, reused from ray to ray
    struct vec3 origin, direction;
    struct oracle_crossing *crossings; // sorted by depth
    uint32_t crossing_count, crossing_capacity;
    struct oracle_boundary *boundaries; // the first one enters, the next one leaves, and so on
    uint32_t boundary_count, boundary_capacity;
    uint32_t open_leaves; // leaves whose crossings do not sum to zero
    int *count;           // per leaf, while walking
    bool *stack;
    double (*projected)[3];
    uint32_t count_capacity, stack_capacity, projected_capacity;
};

struct oracle_end {
    double low, high; // the end lies between these depths
    const struct oracle_boundary *at;
};

struct oracle_span {
    struct oracle_end enter, leave;
};

struct oracle_answer { // {0} is valid
    struct oracle_span *spans;
    uint32_t count, capacity;
};

void oracle_init(struct oracle *out, const struct oracle_leaf *leaves, uint32_t leaf_count,
                 const struct expr_token *tokens, size_t token_count);
void oracle_free(struct oracle *o); // leaves {0}

// All crossings and boundaries of the ray through (x, y), in pixels as rays.h counts them.
void oracle_cast(const struct oracle *o, const struct rays *rays, double x, double y,
                 struct oracle_ray *ray);
void oracle_ray_free(struct oracle_ray *ray); // leaves {0}

// The spans of a cast ray when solids and gaps thinner than epsilon across their faces are left
// out. Borrows the boundaries of the ray.
void oracle_spans(const struct oracle_ray *ray, double epsilon, struct oracle_answer *out);
void oracle_answer_free(struct oracle_answer *a); // leaves {0}

// Evaluates the expression; inside[leaf] above 0 means that the leaf holds the point.
bool oracle_evaluate(const struct oracle *o, const int *inside, bool *stack);
