// read_off.c - OFF meshes of any polygons.
#include "io/read_off.h"

#include "geom/polygon.h"
#include "io/scan.h"

#include <stdlib.h>
#include <string.h>

// "OFF", also with letters in front for what vertices carry beyond their place (C colours, N
// normals, ST texture); files without it begin with the counts.
static bool read_header(struct scan *s, struct error *err)
{
    const char *word;
    if (!scan_to_word(s)) {
        scan_error(s, err, "no OFF file: empty");
        return false;
    }
    if (*s->at >= '0' && *s->at <= '9')
        return true;
    size_t length = scan_word(s, &word);
    static const char *const forms[] = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"};
    bool known = false;
    for (size_t i = 0; i < array_count(forms); i++)
        known |= scan_is(word, length, forms[i]);
    if (!known) {
        scan_error(s, err, "no OFF file: expected OFF in front");
        return false;
    }
    if (scan_in_line(s) && strncmp(s->at, "BINARY", 6) == 0) {
        scan_error(s, err, "binary OFF files cannot be read");
        return false;
    }
    return true;
}

static bool read_vertices(struct scan *s, uint32_t count, struct mesh_builder *b, struct error *err)
{
    for (uint32_t i = 0; i < count; i++) {
        double v[3];
        for (int k = 0; k < 3; k++)
            if (!scan_to_word(s) || !scan_number(s, &v[k])) {
                scan_error(s, err, "expected three finite numbers for each vertex");
                return false;
            }
        mesh_add_vertex(b, (struct vec3){v[0], v[1], v[2]});
        scan_skip_line(s);
    }
    return true;
}

struct corners {
    uint32_t *items;
    uint32_t count, room;
};

static bool read_face(struct scan *s, uint32_t vertex_count, struct corners *c, struct error *err)
{
    uint32_t wanted;
    if (!scan_to_word(s) || !scan_count(s, &wanted)) {
        scan_error(s, err, "expected the number of corners of a face");
        return false;
    }
    c->count = 0;
    for (uint32_t i = 0; i < wanted; i++) { // grows with what is there, not with what is said
        uint32_t vertex;
        if (!scan_to_word(s) || !scan_count(s, &vertex) || vertex >= vertex_count) {
            scan_error(s, err, "expected the number of a vertex as corner of a face");
            return false;
        }
        array_reserve(&c->items, &c->room, (size_t)c->count + 1);
        c->items[c->count++] = vertex;
    }
    scan_skip_line(s);
    return true;
}

static bool read_all(struct scan *s, struct mesh_builder *b, struct messages *messages,
                     struct error *err)
{
    uint32_t vertices, faces, edges, failed = 0;
    if (!read_header(s, err))
        return false;
    if (!scan_to_word(s) || !scan_count(s, &vertices) || !scan_to_word(s) ||
        !scan_count(s, &faces)) {
        scan_error(s, err, "expected the numbers of vertices and faces");
        return false;
    }
    if (scan_in_line(s))
        scan_count(s, &edges); // says nothing that is needed
    scan_skip_line(s);
    if (!read_vertices(s, vertices, b, err))
        return false;

    struct polygon_cutter *cutter = polygon_cutter_new();
    struct corners corners = {0};
    bool ok = true;
    for (uint32_t i = 0; i < faces && ok; i++) {
        ok = read_face(s, vertices, &corners, err);
        if (ok && !polygon_cut(cutter, b, corners.items, corners.count))
            failed += polygon_failed(cutter);
    }
    if (failed)
        messages_add(messages, MESSAGE_WARNING, (struct place){s->path, 0, 0}, POLYGONS_LEFT_OUT,
                     failed);
    free(corners.items);
    polygon_cutter_delete(cutter);
    return ok;
}

bool read_off(const char *path, const char *data, size_t size, struct mesh *out,
              struct messages *messages, struct error *err)
{
    struct mesh_builder b = {0};
    struct scan s;
    scan_open(&s, path, data, size);
    s.hash_comments = true;
    bool ok = read_all(&s, &b, messages, err);
    scan_close(&s);
    if (!ok) {
        mesh_free(&b.mesh);
        return false;
    }
    mesh_weld(&b.mesh);
    *out = b.mesh;
    return true;
}
