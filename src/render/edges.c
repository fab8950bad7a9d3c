// edges.c - how much of a pixel an edge covers, as OpenSCAD's preview draws them.
#include "render/edges.h"

#define HALF_WIDTH 1.414 // pixels within a triangle, over all of which the line fades

// A ray in the coordinates of a leaf.
struct local_ray {
    struct vec3 origin, direction;
};

static struct local_ray local_ray(const struct leaf *leaf, const struct rays *rays, int x, int y)
{
    return (struct local_ray){affine_point(&leaf->to_local, rays_origin(rays, x, y)),
                              affine_vector(&leaf->to_local, rays_direction(rays, x, y))};
}

static double fade(double share, double beside, double above)
{
    double t = share / (HALF_WIDTH * (fabs(beside - share) + fabs(above - share)));
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return 1 - t * t * (3 - 2 * t);
}

double edges_cover(const struct facets *d, const struct leaf *leaf, uint32_t face,
                   const struct rays *rays, int x, int y)
{
    struct facet t;
    struct local_ray r = local_ray(leaf, rays, x, y);
    if (!facets_find(d, leaf->solid, face, r.origin, r.direction, &t))
        return 0;
    // A pixel is as large as its distance to the other one of the pair that a GPU works on; pairs
    // are counted from the lower left.
    int other_y = rays->height - 1 - ((rays->height - 1 - y) ^ 1);
    struct local_ray side = local_ray(leaf, rays, x ^ 1, y);
    struct local_ray over = local_ray(leaf, rays, x, other_y);
    struct vec3 here = facets_shares(&t, r.origin, r.direction);
    struct vec3 beside = facets_shares(&t, side.origin, side.direction);
    struct vec3 above = facets_shares(&t, over.origin, over.direction);
    double cover = 0;
    if (t.edge[0])
        cover = fade(here.x, beside.x, above.x);
    if (t.edge[1])
        cover = fmax(cover, fade(here.y, beside.y, above.y));
    if (t.edge[2])
        cover = fmax(cover, fade(here.z, beside.z, above.z));
    return cover >= 0 ? cover : 0;
}
