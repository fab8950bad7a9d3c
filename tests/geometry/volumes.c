// volumes.c - compares a model with an STL file by dexels along the three axes.
//
// volumes MODEL.csg THEIRS.stl: prints one line that says how they differ and exits with 1 if they
// do.
#include "csg/csg.h"
#include "dexels.h"
#include "geom/mesh.h"
#include "mesh_file.h"

#include <math.h>

#define TOLERANCE 1e-3 // of the volume, counted ray by ray, and of the surface

static void model_load(struct model *out, struct csg_tree *tree, const char *path)
{
    struct messages messages = {0};
    struct solid_store *store = solid_store_new();
    csg_parse_file(tree, path, &messages);
    model_build(out, tree, store, &MODEL_DEFAULTS, &messages);
    solid_store_delete(store);
    messages_free(&messages);
}

struct sums {
    double ours, theirs, differing; // solid lengths
    double ours_met, theirs_met;    // crossings
};

static struct sums sum(const struct dexels *ours, const struct dexels *theirs)
{
    struct sums s = {0};
    for (size_t i = 0; i < (size_t)DEXELS_SIDE * DEXELS_SIDE; i++) {
        s.ours += ours->length[i];
        s.theirs += theirs->length[i];
        s.differing += fabs(ours->length[i] - theirs->length[i]);
        s.ours_met += ours->crossings[i];
        s.theirs_met += theirs->crossings[i];
    }
    return s;
}

static bool compare_along(const struct model *m, const struct mesh *theirs, int axis)
{
    struct box bounds = box_union(m->bounds, mesh_bounds(theirs));
    struct rays rays = dexels_rays(bounds, axis);
    struct dexels a, b;
    dexels_of_body(&a, &m->bodies[0], &rays, model_epsilon(m, -1));
    dexels_of_mesh(&b, theirs, &rays, model_epsilon(m, -1));
    struct sums s = sum(&a, &b);
    dexels_free(&a);
    dexels_free(&b);
    if (s.differing <= TOLERANCE * s.theirs &&
        fabs(s.ours_met - s.theirs_met) <= TOLERANCE * s.theirs_met)
        return true;
    double cell = vec3_dot(rays.step_x, rays.step_x);
    printf("along %c: volume %.6g %.6g, differing %.3g %%, surface across %.6g %.6g; ", "xyz"[axis],
           s.ours * cell, s.theirs * cell, 100 * s.differing / s.theirs, s.ours_met * cell,
           s.theirs_met * cell);
    return false;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: %s MODEL.csg THEIRS.stl\n", argv[0]);
        return 2;
    }
    struct mesh theirs = {0};
    struct csg_tree tree = {0};
    struct model model;
    mesh_load(&theirs, argv[2]);
    model_load(&model, &tree, argv[1]);
    bool same = true;
    for (int axis = 0; axis < 3; axis++)
        same &= compare_along(&model, &theirs, axis);
    if (!same)
        printf("\n");
    model_free(&model);
    csg_free(&tree);
    mesh_free(&theirs);
    return !same;
}
