// read_stl.c - STL meshes, binary and text.
#include "io/read_stl.h"

#include "geom/weld.h"
#include "io/scan.h"

#include <string.h>

enum { HEADER = 84, RECORD = 50, BLOCK = WELD_BLOCK / 3 };

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

// The corners of up to BLOCK triangles; returns the number of the first one with a coordinate that
// is not finite, or `count`.
static uint32_t read_corners(const unsigned char *record, uint32_t count, struct vec3 *corners)
{
    for (uint32_t t = 0; t < count; t++, record += RECORD)
        for (int i = 0; i < 3; i++) {
            const unsigned char *v = record + 12 + 12 * i;
            struct vec3 at = {read_float(v), read_float(v + 4), read_float(v + 8)};
            if (!isfinite(at.x) || !isfinite(at.y) || !isfinite(at.z))
                return t;
            *corners++ = at;
        }
    return count;
}

// Corners are welded as they come: six times fewer are kept than there are.
static bool read_binary(const char *path, const char *data, size_t size, struct mesh_builder *b,
                        struct error *err)
{
    const unsigned char *p = (const unsigned char *)data + HEADER;
    uint32_t count = (uint32_t)((size - HEADER) / RECORD);
    struct welder welder = {0};
    welder_expect(&welder, count / 2); // of a closed mesh
    array_reserve(&b->mesh.triangles, &b->triangle_room, count);
    array_reserve(&b->mesh.faces, &b->face_room, count);
    bool ok = true;
    for (uint32_t t = 0, n; t < count && ok; t += n, p += n * RECORD) {
        struct vec3 corners[3 * BLOCK];
        uint32_t numbers[3 * BLOCK];
        n = count - t < BLOCK ? count - t : BLOCK;
        uint32_t finite = read_corners(p, n, corners);
        ok = finite == n;
        if (!ok)
            error_set(err, "%s: triangle %u has a coordinate that is not finite", path, t + finite);
        welder_add(&welder, corners, 3 * finite, numbers);
        for (uint32_t i = 0; i < finite; i++)
            mesh_add_triangle(b, numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2],
                              mesh_add_face(b));
    }
    b->mesh.vertices = welder.points;
    b->mesh.vertex_count = welder.count;
    welder.points = NULL;
    welder_free(&welder);
    mesh_drop_unused(&b->mesh);
    return ok;
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
        if (ok)
            mesh_weld(&b.mesh);
    } else
        error_set(err, "%s: no STL file: neither text nor as long as its count of triangles says",
                  path);
    if (!ok) {
        mesh_free(&b.mesh);
        return false;
    }
    *out = b.mesh;
    return true;
}
