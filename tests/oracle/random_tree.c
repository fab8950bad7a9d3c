// random_tree.c - random solids, placements, expressions and cameras.
#include "random_tree.h"

#include "base/hash.h"
#include "base/mem.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum placement {
    PLACE_FREE,   // any affine map
    PLACE_GRID,   // faces on multiples of 5 mm: most faces coincide with others
    PLACE_TURNED, // a grid turned as a whole, numbers rounded as in a file
    PLACE_MIXED,
    PLACE_FINE, // thousands of small solids
};

struct maker {
    struct random_scene *scene;
    uint64_t random;
    enum placement placement;
    struct affine turn;
    bool rounded;
    double cube_share; // how many solids are cubes
};

static uint32_t below(struct maker *m, uint32_t n)
{
    return (uint32_t)(random_next(&m->random) % n);
}

static bool chance(struct maker *m, double p)
{
    return random_unit(&m->random) < p;
}

static double between(struct maker *m, double a, double b)
{
    return a + (b - a) * random_unit(&m->random);
}

static struct vec3 random_direction(struct maker *m)
{
    for (;;) {
        struct vec3 v = {between(m, -1, 1), between(m, -1, 1), between(m, -1, 1)};
        double l = vec3_length(v);
        if (l > 0.1 && l < 1)
            return vec3_scale(v, 1 / l);
    }
}

static struct affine random_rotation(struct maker *m)
{
    struct vec3 x = random_direction(m), y;
    do
        y = vec3_cross(x, random_direction(m));
    while (vec3_length(y) < 0.1);
    y = vec3_normalized(y);
    struct vec3 z = vec3_cross(x, y);
    return (struct affine){{{x.x, y.x, z.x, 0}, {x.y, y.y, z.y, 0}, {x.z, y.z, z.z, 0}}};
}

// Six significant digits, as numbers arrive in a file.
static void round_map(struct affine *a)
{
    for (int i = 0; i < 12; i++) {
        char text[32];
        double *number = &a->m[i / 4][i % 4];
        snprintf(text, sizeof text, "%g", *number);
        *number = strtod(text, NULL);
    }
}

static struct affine free_map(struct maker *m, double smallest, double largest, double spread)
{
    struct affine map = random_rotation(m);
    struct affine local = AFFINE_IDENTITY;
    for (int i = 0; i < 3; i++)
        local.m[i][i] = between(m, smallest, largest);
    if (chance(m, 0.2))
        local.m[0][1] = between(m, -1, 1) * local.m[1][1];
    if (chance(m, 0.2))
        local.m[0][0] = -local.m[0][0];
    map = affine_mul(&map, &local);
    for (int i = 0; i < 3; i++)
        map.m[i][3] = between(m, -spread, spread);
    return map;
}

// A signed permutation of the axes, whole sizes, centres on a grid of half a cell.
static struct affine grid_map(struct maker *m)
{
    struct affine map = {0};
    uint32_t first = below(m, 3), step = 1 + below(m, 2);
    for (uint32_t i = 0; i < 3; i++) {
        double size = 10 * (1 + below(m, 6));
        map.m[i][(first + i * step) % 3] = chance(m, 0.2) ? -size : size;
        map.m[i][3] = 5 * ((double)below(m, 13) - 6);
    }
    return map;
}

static uint32_t add_mesh(struct maker *m)
{
    struct random_scene *s = m->scene;
    array_reserve(&s->meshes, &s->mesh_capacity, s->mesh_count + 1);
    struct random_mesh *mesh = &s->meshes[s->mesh_count];
    mesh->shape = chance(m, m->cube_share) ? SHAPE_CUBE : (enum shape)below(m, SHAPES);
    mesh->fn = 3 + (int)below(m, mesh->shape == SHAPE_STAR ? 6 : 22);
    mesh->convex = shape_make(&mesh->mesh, mesh->shape, mesh->fn) && chance(m, 0.8);
    return s->mesh_count++;
}

static void add_token(struct random_scene *s, enum expr_op op, uint32_t arg)
{
    array_reserve(&s->tokens, &s->token_capacity, s->token_count + 1);
    s->tokens[s->token_count++] = (struct expr_token){op, arg};
}

static void add_leaf(struct maker *m)
{
    struct random_scene *s = m->scene;
    uint32_t mesh =
        s->mesh_count < 12 || m->placement == PLACE_FREE ? add_mesh(m) : below(m, s->mesh_count);
    bool grid = m->placement == PLACE_GRID || m->placement == PLACE_TURNED ||
                (m->placement == PLACE_MIXED && chance(m, 0.6));
    struct affine map = grid                         ? grid_map(m)
                        : m->placement == PLACE_FINE ? free_map(m, 4, 16, 55)
                                                     : free_map(m, 8, 70, 35);
    if (m->placement == PLACE_TURNED)
        map = affine_mul(&m->turn, &map);
    if (m->rounded)
        round_map(&map);
    array_reserve(&s->leaves, &s->leaf_capacity, s->leaf_count + 1);
    s->leaves[s->leaf_count] = (struct random_leaf){mesh, map};
    add_token(s, EXPR_LEAF, s->leaf_count++);
}

static enum expr_op random_op(struct maker *m)
{
    uint32_t r = below(m, 10);
    return r < 4 ? EXPR_UNION : r < 8 ? EXPR_DIFFERENCE : EXPR_INTERSECTION;
}

// Intersections of many operands are mostly empty: fewer of them.
static enum expr_op random_op_of(struct maker *m, uint32_t operands)
{
    enum expr_op op = random_op(m);
    return op == EXPR_INTERSECTION && operands > 2 && chance(m, 0.7) ? EXPR_UNION : op;
}

// An expression of about `leaves` leaves, `depth` levels deep at most.
static void add_tree(struct maker *m, uint32_t leaves, int depth)
{
    if (chance(m, 0.01)) {
        add_token(m->scene, random_op(m), 0);
        return;
    }
    if (leaves <= 1) {
        add_leaf(m);
        if (chance(m, 0.05))
            add_token(m->scene, random_op(m), 1);
        return;
    }
    uint32_t most = depth ? leaves < 6 ? leaves : 6 : leaves;
    uint32_t count = depth ? 2 + below(m, most - 1) : leaves;
    enum expr_op op = random_op_of(m, leaves);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t share = leaves / (count - i);
        if (i + 1 < count && share > 1)
            share = 1 + below(m, 2 * share - 1);
        leaves -= share;
        add_tree(m, share, depth - 1);
    }
    add_token(m->scene, op, count);
}

// ((((a - b) + c) - d) ...: one level per leaf.
static void add_chain(struct maker *m, uint32_t leaves)
{
    bool left = chance(m, 0.7);
    add_leaf(m);
    for (uint32_t i = 1; i < leaves; i++) {
        add_leaf(m);
        if (left)
            add_token(m->scene, random_op(m), 2);
    }
    for (uint32_t i = 1; i < leaves && !left; i++)
        add_token(m->scene, random_op(m), 2);
}

// A block from which hundreds are taken, or hundreds of small bodies.
static void add_many(struct maker *m, uint32_t leaves)
{
    m->placement = PLACE_FREE;
    m->rounded = chance(m, 0.5);
    add_leaf(m);
    m->scene->leaves[0].to_world = (struct affine){{{90, 0, 0, 0}, {0, 90, 0, 0}, {0, 0, 90, 0}}};
    m->placement = PLACE_FINE;
    uint32_t groups = 1 + below(m, 300);
    for (uint32_t i = 0; i < groups; i++)
        add_tree(m, leaves / groups ? leaves / groups : 1, 3);
    add_token(m->scene, chance(m, 0.5) ? EXPR_DIFFERENCE : EXPR_UNION, groups + 1);
}

static void make_camera(struct maker *m)
{
    struct random_scene *s = m->scene;
    struct rays *r = &s->rays;
    bool axis = chance(m, 0.3), inside = chance(m, 0.2), exact = axis && chance(m, 0.3);
    r->orthographic = chance(m, 0.5);
    r->width = 24 + 2 * (int)below(m, 8) + exact;
    r->height = 24 + 2 * (int)below(m, 8) + exact;
    struct affine turn = random_rotation(m);
    if (axis) {
        turn = (struct affine){0};
        uint32_t first = below(m, 3);
        for (uint32_t i = 0; i < 3; i++)
            turn.m[i][(first + i) % 3] = chance(m, 0.5) ? 1 : -1;
    }
    struct vec3 x = {turn.m[0][0], turn.m[1][0], turn.m[2][0]};
    struct vec3 y = {turn.m[0][1], turn.m[1][1], turn.m[2][1]};
    struct vec3 z = {turn.m[0][2], turn.m[1][2], turn.m[2][2]};
    double distance = inside ? between(m, -30, 30) : between(m, 150, 400);
    if (exact)
        distance = 5 * floor(distance / 5);
    double step = r->orthographic ? 120.0 / r->height : (inside ? 1.2 : 0.4) / r->height;
    if (exact && r->orthographic)
        step = 5;
    r->origin = vec3_scale(z, -distance);
    r->forward = z;
    r->step_x = vec3_scale(x, step);
    r->step_y = vec3_scale(y, step);
    struct vec3 corner = vec3_add(vec3_scale(r->step_x, -0.5 * (r->width - 1)),
                                  vec3_scale(r->step_y, -0.5 * (r->height - 1)));
    if (!exact) { // away from the planes of the grid
        struct vec3 off =
            vec3_add(vec3_scale(x, between(m, -2, 2)), vec3_scale(y, between(m, -2, 2)));
        r->origin = vec3_add(r->origin, off);
    }
    if (r->orthographic)
        r->origin = vec3_add(r->origin, corner);
    else
        r->forward = vec3_add(r->forward, corner);
    r->reference = fmax(distance, 50);
    r->near = r->orthographic ? (chance(m, 0.7) ? -1000 : between(m, 0, 20)) : 0.5;
    if (!inside && chance(m, 0.1))
        r->near = distance + between(m, -40, 20);
    r->far = chance(m, 0.1) ? fmax(r->near, distance - 30) + between(m, 5, 60) : 1e4;
    s->aligned = exact;
}

void random_scene_make(struct random_scene *out, uint64_t seed)
{
    *out = (struct random_scene){.epsilon = 1e-3};
    struct maker m = {.scene = out, .random = hash_mix(seed + 1)};
    m.placement = (enum placement)below(&m, 4);
    m.turn = random_rotation(&m);
    m.rounded = m.placement == PLACE_TURNED || chance(&m, 0.3);
    m.cube_share = m.placement == PLACE_FREE ? 0.2 : between(&m, 0.2, 1);
    uint32_t leaves = 2 + below(&m, 1 + below(&m, 59));
    if (seed % 400 == 399)
        add_many(&m, 2000);
    else if (chance(&m, 0.1))
        add_chain(&m, leaves);
    else
        add_tree(&m, leaves, (int)(1 + below(&m, 8)));
    make_camera(&m);
}

void random_scene_free(struct random_scene *s)
{
    for (uint32_t i = 0; i < s->mesh_count; i++)
        shape_free(&s->meshes[i].mesh);
    free(s->meshes);
    free(s->leaves);
    free(s->tokens);
    *s = (struct random_scene){0};
}
