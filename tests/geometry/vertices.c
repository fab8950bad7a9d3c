// vertices.c - compares two STL files: vertices as sets, signed volume, surface.
//
// vertices OURS THEIRS: prints how equal they are, or one line that says how they differ and exits
// with 1.
//   vertices   the vertices are equal
//   grid       they are equal but for one step of the grid that OpenSCAD puts flat shapes on: the
//              last bit of a number decides what it is cut off to
//   surface    those of one that the other lacks lie on its faces, as corners do that rounding has
//              made or unmade
#include "base/hash.h"
#include "base/mem.h"
#include "geom/mesh.h"
#include "mesh_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define TOLERANCE 1e-5
#define GRID_STEP 2.2e-5 // across a cell of 1/65536
#define FLOATS    1.2e-7 // of a coordinate: OpenSCAD's binary STL has 24 bits
#define MEASURES  1e-5   // of a volume or a surface

// Points by the cell of a grid that they are in.
struct cells {
    const struct mesh *mesh;
    double size;
    uint32_t *heads, *next; // chains of vertex numbers + 1
    uint32_t mask;
};

static uint32_t cell_of(const struct cells *c, const int64_t at[3])
{
    return (uint32_t)hash_bytes(1, at, 3 * sizeof *at) & c->mask;
}

static void cell_at(const struct cells *c, struct vec3 p, int64_t at[3])
{
    at[0] = (int64_t)floor(p.x / c->size);
    at[1] = (int64_t)floor(p.y / c->size);
    at[2] = (int64_t)floor(p.z / c->size);
}

static void cells_init(struct cells *c, const struct mesh *m, double size)
{
    *c = (struct cells){.mesh = m, .size = size, .mask = 1023};
    while (c->mask < m->vertex_count)
        c->mask = 2 * c->mask + 1;
    c->heads = mem_zalloc(((size_t)c->mask + 1) * sizeof *c->heads);
    c->next = mem_alloc(m->vertex_count * sizeof *c->next);
    for (uint32_t i = 0; i < m->vertex_count; i++) {
        int64_t at[3];
        cell_at(c, m->vertices[i], at);
        uint32_t cell = cell_of(c, at);
        c->next[i] = c->heads[cell];
        c->heads[cell] = i + 1;
    }
}

static void cells_free(struct cells *c)
{
    free(c->heads);
    free(c->next);
}

// Cells are larger than the tolerance: whatever is near lies in one of the 27 around.
static bool has_near(const struct cells *c, struct vec3 p, double tolerance)
{
    int64_t at[3];
    cell_at(c, p, at);
    for (int k = 0; k < 27; k++) {
        const int64_t near[3] = {at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1};
        for (uint32_t i = c->heads[cell_of(c, near)]; i; i = c->next[i - 1])
            if (vec3_length(vec3_sub(c->mesh->vertices[i - 1], p)) <= tolerance)
                return true;
    }
    return false;
}

static double distance_to_segment(struct vec3 p, struct vec3 a, struct vec3 b)
{
    struct vec3 along = vec3_sub(b, a), to = vec3_sub(p, a);
    double square = vec3_dot(along, along);
    double t = square > 0 ? fmax(0, fmin(1, vec3_dot(to, along) / square)) : 0;
    return vec3_length(vec3_sub(to, vec3_scale(along, t)));
}

static double distance_to_triangle(struct vec3 p, const struct vec3 c[3])
{
    struct vec3 n = vec3_normalized(vec3_cross(vec3_sub(c[1], c[0]), vec3_sub(c[2], c[0])));
    double least = INFINITY;
    bool inside = vec3_dot(n, n) > 0.5;
    for (int k = 0; k < 3; k++) {
        struct vec3 a = c[k], b = c[(k + 1) % 3];
        least = fmin(least, distance_to_segment(p, a, b));
        inside &= vec3_dot(n, vec3_cross(vec3_sub(b, a), vec3_sub(p, a))) >= 0;
    }
    return inside ? fabs(vec3_dot(n, vec3_sub(p, c[0]))) : least;
}

static bool is_on(const struct mesh *m, struct vec3 p, double tolerance)
{
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        struct vec3 c[3];
        for (int k = 0; k < 3; k++)
            c[k] = m->vertices[m->triangles[i][k]];
        if (distance_to_triangle(p, c) <= tolerance)
            return true;
    }
    return false;
}

// The vertices of one mesh that are not among those of the other.
struct missing {
    uint32_t count, apart; // apart: not on the other's surface either
    struct vec3 first;     // of those apart, or of all
};

static struct missing find_missing(const struct mesh *of, const struct mesh *among,
                                   double tolerance, bool faces)
{
    struct cells cells;
    struct missing m = {0};
    cells_init(&cells, among, 2 * tolerance);
    for (uint32_t i = 0; i < of->vertex_count; i++) {
        struct vec3 p = of->vertices[i];
        if (has_near(&cells, p, tolerance))
            continue;
        bool apart = !faces || !is_on(among, p, tolerance);
        if (!m.count++ || (apart && !m.apart))
            m.first = p;
        m.apart += apart;
    }
    cells_free(&cells);
    return m;
}

static double surface(const struct mesh *m)
{
    double twice = 0;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        struct vec3 a = m->vertices[m->triangles[i][0]];
        twice += vec3_length(vec3_cross(vec3_sub(m->vertices[m->triangles[i][1]], a),
                                        vec3_sub(m->vertices[m->triangles[i][2]], a)));
    }
    return twice / 2;
}

static double farthest(const struct mesh *m)
{
    double far = 0;
    for (uint32_t i = 0; i < m->vertex_count; i++)
        far = fmax(far, vec3_length(m->vertices[i]));
    return far;
}

static void report(const struct missing *m, const char *whose)
{
    if (m->count)
        printf("%u of %s have no equal, as %.9g %.9g %.9g, %u lie elsewhere; ", m->count, whose,
               m->first.x, m->first.y, m->first.z, m->apart);
}

static bool same_measures(const struct mesh *ours, const struct mesh *theirs, double tolerance)
{
    double v[2] = {mesh_volume(ours), mesh_volume(theirs)};
    double s[2] = {surface(ours), surface(theirs)};
    if (fabs(v[0] - v[1]) <= MEASURES * fabs(v[1]) + tolerance * s[1] &&
        fabs(s[0] - s[1]) <= MEASURES * s[1] + tolerance)
        return true;
    printf("volume %.9g %.9g, surface %.9g %.9g; ", v[0], v[1], s[0], s[1]);
    return false;
}

static bool compare(const struct mesh *ours, const struct mesh *theirs)
{
    static const struct {
        const char *name;
        double tolerance;
        bool faces;
    } ways[] = {
        {"vertices", TOLERANCE, false}, {"grid", GRID_STEP, false}, {"surface", GRID_STEP, true}};
    double floats = FLOATS * farthest(theirs);
    struct missing extra = {0}, lost = {0};
    bool same = same_measures(ours, theirs, fmax(GRID_STEP, floats));
    for (size_t i = 0; i < array_count(ways) && same; i++) {
        double tolerance = fmax(ways[i].tolerance, floats);
        extra = find_missing(ours, theirs, tolerance, ways[i].faces);
        lost = find_missing(theirs, ours, tolerance, ways[i].faces);
        if (ways[i].faces ? !extra.apart && !lost.apart : !extra.count && !lost.count) {
            printf("%s\n", ways[i].name);
            return true;
        }
    }
    report(&extra, "ours");
    report(&lost, "theirs");
    printf("vertices %u %u\n", ours->vertex_count, theirs->vertex_count);
    return false;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: %s OURS.stl THEIRS.stl\n", argv[0]);
        return 2;
    }
    struct mesh ours = {0}, theirs = {0};
    mesh_load(&ours, argv[1]);
    mesh_load(&theirs, argv[2]);
    bool same = compare(&ours, &theirs);
    mesh_free(&ours);
    mesh_free(&theirs);
    return !same;
}
