// read_stl.c - STL meshes, binary and text.
#include "io/read_stl.h"

#include "geom/mesh.h"
#include "io/scan.h"

#include <string.h>

enum { HEADER = 84, RECORD = 50 };

static uint32_t little_endian(const unsigned char *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static bool is_binary(const char *data, size_t size)
{
    return size >= HEADER &&
           size == HEADER + (uint64_t)RECORD * little_endian((const unsigned char *)data + 80);
}

static float read_float(const unsigned char *p)
{
    uint32_t bits = little_endian(p);
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static bool read_binary(const char *path, const char *data, size_t size, struct mesh_builder *b,
                        struct error *err)
{
    const unsigned char *p = (const unsigned char *)data + HEADER;
    for (size_t left = (size - HEADER) / RECORD; left; left--, p += RECORD) {
        uint32_t first = b->mesh.vertex_count;
        for (int i = 0; i < 3; i++) {
            const unsigned char *v = p + 12 + 12 * i;
            struct vec3 at = {read_float(v), read_float(v + 4), read_float(v + 8)};
            if (!isfinite(at.x) || !isfinite(at.y) || !isfinite(at.z)) {
                error_set(err, "%s: triangle %u has a coordinate that is not finite", path,
                          b->mesh.triangle_count);
                return false;
            }
            mesh_add_vertex(b, at);
        }
        mesh_add_triangle(b, first, first + 1, first + 2, mesh_add_face(b));
    }
    return true;
}

// Only `vertex` lines and the ends of loops count.
static bool read_text(struct scan *s, struct mesh_builder *b, struct error *err)
{
    uint32_t corners[3], count = 0;
    for (; scan_to_word(s); scan_skip_line(s)) {
        const char *word;
        size_t length = scan_word(s, &word);
        if (scan_is(word, length, "outer") || scan_is(word, length, "endloop"))
            count = 0;
        if (!scan_is(word, length, "vertex"))
            continue;
        double v[3];
        for (int i = 0; i < 3; i++)
            if (!scan_in_line(s) || !scan_number(s, &v[i])) {
                scan_error(s, err, "expected three finite numbers after 'vertex'");
                return false;
            }
        if (count == 3) {
            scan_error(s, err, "a fourth vertex in one facet");
            return false;
        }
        corners[count++] = mesh_add_vertex(b, (struct vec3){v[0], v[1], v[2]});
        if (count == 3)
            mesh_add_triangle(b, corners[0], corners[1], corners[2], mesh_add_face(b));
    }
    return true;
}

bool read_stl(const char *path, const char *data, size_t size, struct mesh *out, struct error *err)
{
    struct mesh_builder b = {0};
    bool ok = false;
    if (is_binary(data, size))
        ok = read_binary(path, data, size, &b, err);
    else if (size >= 5 && memcmp(data, "solid", 5) == 0) {
        struct scan s;
        scan_open(&s, path, data, size);
        ok = read_text(&s, &b, err);
        scan_close(&s);
    } else
        error_set(err, "%s: no STL file: neither text nor as long as its count of triangles says",
                  path);
    if (!ok) {
        mesh_free(&b.mesh);
        return false;
    }
    mesh_weld(&b.mesh);
    *out = b.mesh;
    return true;
}
