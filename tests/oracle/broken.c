// broken.c - random harm to the meshes of a scene.
#include "broken.h"

#include "base/hash.h"
#include "base/mem.h"

#include <string.h>

enum harm { HARM_NONE, HARM_HOLES, HARM_TURNED, HARM_INVERTED, HARM_NESTED, HARM_OVERLAP, HARMS };

static double between(uint64_t *random, double a, double b)
{
    return a + (b - a) * random_unit(random);
}

static void turn(struct mesh *m, uint32_t triangle)
{
    uint32_t *t = m->triangles[triangle], swap = t[0];
    t[0] = t[1];
    t[1] = swap;
}

static void turn_some(struct mesh *m, double share, uint64_t *random)
{
    for (uint32_t i = 0; i < m->triangle_count; i++)
        if (random_unit(random) < share)
            turn(m, i);
}

static void drop_some(struct mesh *m, double share, uint64_t *random)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        if (random_unit(random) < share && m->triangle_count > 1)
            continue;
        memmove(m->triangles[kept], m->triangles[i], sizeof *m->triangles);
        m->faces[kept++] = m->faces[i];
    }
    m->triangle_count = kept;
}

// Adds another mesh, `size` times as large and moved.
static void add_copy(struct mesh *m, const struct mesh *from, double size, struct vec3 by)
{
    uint32_t vertices = m->vertex_count, triangles = m->triangle_count, faces = m->face_count;
    uint32_t vertex_room = vertices, triangle_room = triangles, face_room = triangles;
    array_reserve(&m->vertices, &vertex_room, vertices + from->vertex_count);
    array_reserve(&m->triangles, &triangle_room, triangles + from->triangle_count);
    array_reserve(&m->faces, &face_room, triangles + from->triangle_count);
    for (uint32_t i = 0; i < from->vertex_count; i++)
        m->vertices[vertices + i] = vec3_add(vec3_scale(from->vertices[i], size), by);
    for (uint32_t i = 0; i < from->triangle_count; i++) {
        for (int k = 0; k < 3; k++)
            m->triangles[triangles + i][k] = vertices + from->triangles[i][k];
        m->faces[triangles + i] = faces + from->faces[i];
    }
    m->vertex_count += from->vertex_count;
    m->triangle_count += from->triangle_count;
    m->face_count += from->face_count;
}

// Up to three copies, some of them inside out; `spread`: 0 when each is within the one before.
static void add_copies(struct mesh *m, double spread, uint64_t *random)
{
    struct mesh one;
    shape_copy(&one, m);
    one.turned = NULL;
    double size = 1;
    for (uint64_t n = 1 + random_next(random) % 3; n > 0; n--) {
        struct vec3 by = {between(random, -spread, spread), between(random, -spread, spread),
                          between(random, -spread, spread)};
        size *= spread > 0 ? 1 : between(random, 0.4, 0.9);
        turn_some(&one, random_unit(random) < 0.5, random);
        add_copy(m, &one, size, by);
    }
    shape_free(&one);
}

void broken_scene(struct random_scene *s, uint64_t seed)
{
    uint64_t random = hash_mix(seed ^ 0x62726f6b656e);
    for (uint32_t i = 0; i < s->mesh_count; i++) {
        struct mesh *m = &s->meshes[i].mesh;
        enum harm harm = (enum harm)(random_next(&random) % HARMS);
        if (harm == HARM_HOLES)
            drop_some(m, between(&random, 0, 0.5), &random);
        else if (harm == HARM_TURNED)
            turn_some(m, between(&random, 0, 0.3), &random);
        else if (harm == HARM_INVERTED)
            turn_some(m, 1, &random);
        else if (harm == HARM_NESTED)
            add_copies(m, 0, &random);
        else if (harm == HARM_OVERLAP)
            add_copies(m, 0.5, &random);
        s->meshes[i].convex = s->meshes[i].convex && harm == HARM_NONE;
    }
}
