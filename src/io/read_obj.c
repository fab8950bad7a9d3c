// read_obj.c - Wavefront OBJ meshes.
#include "io/read_obj.h"

#include "geom/polygon.h"
#include "io/scan.h"

#include <stdlib.h>

struct numbers {
    uint32_t *items;
    uint32_t count, room;
};

struct reader {
    struct scan scan;
    struct mesh_builder mesh;
    struct polygon_cutter *cutter;
    struct numbers vertices; // of the mesh, by their number in the file: cutting adds others
    struct numbers corners;  // of the face at hand
    uint32_t failed;         // faces
};

static void append(struct numbers *n, uint32_t item)
{
    array_reserve(&n->items, &n->room, (size_t)n->count + 1);
    n->items[n->count++] = item;
}

// To the next word of the line or, after a backslash, of the next one.
static bool to_word(struct scan *s)
{
    while (scan_in_line(s)) {
        if (*s->at != '\\')
            return true;
        scan_skip_line(s);
    }
    return false;
}

static bool read_vertex(struct reader *r)
{
    double v[3];
    for (int i = 0; i < 3; i++)
        if (!to_word(&r->scan) || !scan_number(&r->scan, &v[i]))
            return false;
    append(&r->vertices, mesh_add_vertex(&r->mesh, (struct vec3){v[0], v[1], v[2]}));
    return true;
}

// The vertex of "7", "7/1", "7/1/2" or "7//2"; -1 is the last vertex so far.
static bool read_corner(struct reader *r, const char *word, size_t length, uint32_t *out)
{
    uint64_t value = 0;
    bool back = length && *word == '-';
    size_t begin = back, i = begin;
    for (; i < length && word[i] >= '0' && word[i] <= '9' && value <= UINT32_MAX; i++)
        value = value * 10 + (uint64_t)(word[i] - '0');
    if (i == begin || (i < length && word[i] != '/') || value == 0 || value > r->vertices.count)
        return false;
    *out = r->vertices.items[back ? r->vertices.count - value : value - 1];
    return true;
}

static bool read_face(struct reader *r)
{
    r->corners.count = 0;
    while (to_word(&r->scan)) {
        const char *word;
        uint32_t vertex;
        size_t length = scan_word(&r->scan, &word);
        if (!read_corner(r, word, length, &vertex))
            return false;
        append(&r->corners, vertex);
    }
    if (!polygon_cut(r->cutter, &r->mesh, r->corners.items, r->corners.count))
        r->failed += polygon_failed(r->cutter);
    return true;
}

// Lines of vertices and faces; whatever else stands in the file says nothing of the shape.
static bool read_lines(struct reader *r, struct error *err)
{
    for (; scan_to_word(&r->scan); scan_skip_line(&r->scan)) {
        const char *word;
        size_t length = scan_word(&r->scan, &word);
        if (scan_is(word, length, "v") && !read_vertex(r)) {
            scan_error(&r->scan, err, "expected three finite numbers after 'v'");
            return false;
        }
        if (scan_is(word, length, "f") && !read_face(r)) {
            scan_error(&r->scan, err, "expected the numbers of vertices after 'f'");
            return false;
        }
    }
    return true;
}

bool read_obj(const char *path, const char *data, size_t size, struct mesh *out,
              struct messages *messages, struct error *err)
{
    struct reader r = {.cutter = polygon_cutter_new()};
    scan_open(&r.scan, path, data, size);
    r.scan.hash_comments = true;
    bool ok = read_lines(&r, err);
    if (r.failed)
        messages_add(messages, MESSAGE_WARNING, (struct place){path, 0, 0}, POLYGONS_LEFT_OUT,
                     r.failed);
    scan_close(&r.scan);
    polygon_cutter_delete(r.cutter);
    free(r.vertices.items);
    free(r.corners.items);
    if (!ok) {
        mesh_free(&r.mesh.mesh);
        return false;
    }
    mesh_weld(&r.mesh.mesh);
    *out = r.mesh.mesh;
    return true;
}
