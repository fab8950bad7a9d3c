// winding.c - what the winding numbers around a mesh may be.
#include "geom/winding.h"

// The line along an axis enters the mesh through triangles that face back and leaves it through
// those that face forward. Where all of the former are in front of all of the latter, numbers go up
// first and down then, from 0 to 0.
static bool enters_first(const struct mesh *m, int axis)
{
    double last_enter = -INFINITY, first_leave = INFINITY;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        double p[3][3], low = INFINITY, high = -INFINITY;
        for (int i = 0; i < 3; i++) {
            struct vec3 v = m->vertices[m->triangles[t][i]];
            const double turned[5] = {v.x, v.y, v.z, v.x, v.y};
            for (int k = 0; k < 3; k++)
                p[i][k] = turned[axis + k];
            low = fmin(low, p[i][0]);
            high = fmax(high, p[i][0]);
        }
        double facing =
            (p[1][1] - p[0][1]) * (p[2][2] - p[0][2]) - (p[1][2] - p[0][2]) * (p[2][1] - p[0][1]);
        if (facing < 0)
            last_enter = fmax(last_enter, high);
        else if (facing > 0)
            first_leave = fmin(first_leave, low);
    }
    return last_enter <= first_leave;
}

bool mesh_is_never_inside_out(const struct mesh *m)
{
    return enters_first(m, 2) || enters_first(m, 0) || enters_first(m, 1);
}
