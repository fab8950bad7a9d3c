// read_nef3.c - NEF3 solids: CGAL's text form of Nef polyhedra, which OpenSCAD writes.
//
// A header gives the number of items of each kind; then each item has a line
//     number { numbers of other items, by commas | coordinates } mark
// Facets come twice, once for each side, with the volume there and a normal into it. A boundary of
// a facet is a ring of shalfedges, each of which starts at a halfedge and so at its vertex.
// Coordinates are whole numbers of any length over a common last one.
#include "io/read_nef3.h"

#include "geom/mesh.h"
#include "geom/outline.h"
#include "io/number.h"
#include "io/scan.h"

#include <stdlib.h>
#include <string.h>

enum kind { VERTICES, HALFEDGES, FACETS, VOLUMES, SHALFEDGES, SHALFLOOPS, SFACES, KINDS };

static const struct {
    const char *counted, *wrong;
} kinds[KINDS] = {
    {"vertices", "expected the line of a vertex"},
    {"halfedges", "expected the line of a halfedge"},
    {"facets", "expected the line of a facet"},
    {"volumes", "expected the line of a volume"},
    {"shalfedges", "expected the line of a shalfedge"},
    {"shalfloops", "expected the line of a shalfloop"},
    {"sfaces", "expected the line of an sface"},
};

// The shortest line of an item has as many bytes.
enum { ITEM_BYTES = 5 };
// Of a coordinate: more are cut off on both sides of the fraction.
enum { DIGITS_MOST = 300 };

struct facet {
    uint32_t twin, volume, rings_end; // its rings begin where those of the facet before end
    struct vec3 normal;               // of any length
};

struct nef {
    struct scan s;
    uint32_t counts[KINDS];
    uint32_t *halfedge_vertex;
    struct facet *facets;
    uint32_t *rings; // a shalfedge of each
    uint32_t ring_count, ring_room;
    bool *marked;                    // volumes
    uint32_t *start_halfedge, *next; // of shalfedges
    bool *walked;                    // shalfedges
    struct outline flat;             // of the facet at work
    uint32_t *corners;               // the vertices of its points
    uint32_t corner_room;
};

// ---------------------------------------------------------------- parts of a line

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool take_sign(struct nef *n, char sign)
{
    bool here = scan_to_word(&n->s) && *n->s.at == sign;
    n->s.at += here;
    return here;
}

// A whole number of any length, with its sign.
static bool take_digits(struct nef *n, const char **text, size_t *length)
{
    if (!scan_to_word(&n->s))
        return false;
    const char *p = n->s.at, *digits = p + (*p == '-');
    *text = p;
    for (p = digits; is_digit(*p);)
        p++;
    *length = (size_t)(p - *text);
    n->s.at = p;
    return p > digits && strchr(" \t\r\n,|{}", *p); // also at the end
}

static bool take_number(struct nef *n, uint32_t limit, uint32_t *out)
{
    const char *text;
    size_t length;
    uint64_t value = 0;
    if (!take_digits(n, &text, &length))
        return false;
    for (size_t i = 0; i < length && value < limit; i++)
        value = is_digit(text[i]) ? value * 10 + (uint64_t)(text[i] - '0') : limit;
    *out = (uint32_t)value;
    return value < limit;
}

// Passes numbers that are not needed, and the sign behind them.
static bool skip_past(struct nef *n, char sign)
{
    while (scan_to_word(&n->s) && *n->s.at != sign &&
           (is_digit(*n->s.at) || *n->s.at == ',' || *n->s.at == '-'))
        n->s.at++;
    return take_sign(n, sign);
}

static bool take_begin(struct nef *n)
{
    uint32_t number;
    return take_number(n, UINT32_MAX, &number) && take_sign(n, '{');
}

static bool take_end(struct nef *n, bool *mark)
{
    uint32_t value = 0;
    bool ok = take_sign(n, '}') && take_number(n, 2, &value);
    *mark = value;
    return ok;
}

static double leading_digits(const struct nef *n, const char *text, size_t length)
{
    char digits[DIGITS_MOST + 1];
    const char *stop;
    double value = 0;
    memcpy(digits, text, length);
    digits[length] = 0;
    return number_read(digits, n->s.numbers, &value, &stop) ? value : 0;
}

// Four coordinates, divided by one power of ten, to the end of the line.
static bool take_coordinates(struct nef *n, double out[4])
{
    const char *text[4];
    size_t lengths[4], longest = 0;
    bool mark;
    for (int i = 0; i < 4; i++) {
        if (!take_digits(n, &text[i], &lengths[i]))
            return false;
        longest = lengths[i] > longest ? lengths[i] : longest;
    }
    size_t dropped = longest > DIGITS_MOST ? longest - DIGITS_MOST : 0;
    for (int i = 0; i < 4; i++)
        out[i] = leading_digits(n, text[i], lengths[i] > dropped ? lengths[i] - dropped : 0);
    return take_end(n, &mark);
}

// ---------------------------------------------------------------- items

static bool read_vertex(struct nef *n, struct mesh_builder *b)
{
    double c[4];
    if (!skip_past(n, '|') || !take_coordinates(n, c))
        return false;
    struct vec3 p = {c[0] / c[3], c[1] / c[3], c[2] / c[3]};
    mesh_add_vertex(b, p);
    return isfinite(p.x) && isfinite(p.y) && isfinite(p.z);
}

static bool read_halfedge(struct nef *n, uint32_t i)
{
    double c[4];
    uint32_t twin;
    return take_number(n, n->counts[HALFEDGES], &twin) && take_sign(n, ',') &&
           take_number(n, n->counts[VERTICES], &n->halfedge_vertex[i]) && skip_past(n, '|') &&
           take_coordinates(n, c);
}

static bool read_facet(struct nef *n, uint32_t i)
{
    struct facet *f = &n->facets[i];
    double c[4];
    if (!take_number(n, n->counts[FACETS], &f->twin) || !take_sign(n, ','))
        return false;
    while (scan_to_word(&n->s) && is_digit(*n->s.at)) {
        array_reserve(&n->rings, &n->ring_room, (size_t)n->ring_count + 1);
        if (!take_number(n, n->counts[SHALFEDGES], &n->rings[n->ring_count++]))
            return false;
    }
    f->rings_end = n->ring_count;
    // Shalfloops, of single points in the facet, are passed.
    if (!take_sign(n, ',') || !skip_past(n, ',') ||
        !take_number(n, n->counts[VOLUMES], &f->volume) || !take_sign(n, '|') ||
        !take_coordinates(n, c))
        return false;
    f->normal = (struct vec3){c[0], c[1], c[2]};
    return true;
}

static bool read_volume(struct nef *n, uint32_t i)
{
    while (scan_to_word(&n->s) && *n->s.at != '}') {
        uint32_t sface;
        if (!take_number(n, n->counts[SFACES], &sface))
            return false;
    }
    return take_end(n, &n->marked[i]);
}

static bool read_shalfedge(struct nef *n, uint32_t i)
{
    // twin, previous and next around the vertex, start, sface, previous and next around the facet
    enum { START = 3, NEXT = 6, FIELDS };
    double c[4];
    for (int field = 0; field < FIELDS; field++) {
        uint32_t number;
        enum kind kind = field == START ? HALFEDGES : field == START + 1 ? SFACES : SHALFEDGES;
        if (!take_number(n, n->counts[kind], &number) || !take_sign(n, ','))
            return false;
        if (field == START)
            n->start_halfedge[i] = number;
        else if (field == NEXT)
            n->next[i] = number;
    }
    return skip_past(n, '|') && take_coordinates(n, c);
}

static bool read_item(struct nef *n, enum kind kind, uint32_t i, struct mesh_builder *b)
{
    double c[4];
    bool mark;
    if (!take_begin(n))
        return false;
    switch (kind) {
    case VERTICES:
        return read_vertex(n, b);
    case HALFEDGES:
        return read_halfedge(n, i);
    case FACETS:
        return read_facet(n, i);
    case VOLUMES:
        return read_volume(n, i);
    case SHALFEDGES:
        return read_shalfedge(n, i);
    case SHALFLOOPS:
        return skip_past(n, '|') && take_coordinates(n, c);
    default: // here all stands in front of the end
        while (scan_to_word(&n->s) && (is_digit(*n->s.at) || *n->s.at == ','))
            n->s.at++;
        return take_end(n, &mark);
    }
}

static bool take_word(struct nef *n, const char *text)
{
    const char *word;
    if (!scan_to_word(&n->s))
        return false;
    size_t length = scan_word(&n->s, &word);
    return scan_is(word, length, text);
}

static bool read_header(struct nef *n, struct error *err)
{
    static const char *const words[] = {"Selective", "Nef", "Complex", "standard"};
    uint64_t total = 0;
    for (uint32_t i = 0; i < array_count(words); i++)
        if (!take_word(n, words[i])) {
            scan_error(&n->s, err, "no NEF3 file: expected 'Selective Nef Complex standard'");
            return false;
        }
    for (int kind = 0; kind < KINDS; kind++) {
        if (!take_word(n, kinds[kind].counted) || !take_number(n, UINT32_MAX, &n->counts[kind])) {
            scan_error(&n->s, err, "expected the numbers of items of all kinds");
            return false;
        }
        total += n->counts[kind];
    }
    if (total > (uint64_t)(n->s.end - n->s.at) / ITEM_BYTES) {
        scan_error(&n->s, err, "more items than the file has room for");
        return false;
    }
    return true;
}

static bool read_items(struct nef *n, struct mesh_builder *b, struct error *err)
{
    n->halfedge_vertex = mem_alloc(n->counts[HALFEDGES] * sizeof *n->halfedge_vertex);
    n->facets = mem_alloc(n->counts[FACETS] * sizeof *n->facets);
    n->marked = mem_alloc(n->counts[VOLUMES] * sizeof *n->marked);
    n->start_halfedge = mem_alloc(n->counts[SHALFEDGES] * sizeof *n->start_halfedge);
    n->next = mem_alloc(n->counts[SHALFEDGES] * sizeof *n->next);
    for (enum kind kind = 0; kind < KINDS; kind++)
        for (uint32_t i = 0; i < n->counts[kind]; i++)
            if (!read_item(n, kind, i, b)) {
                scan_error(&n->s, err, kinds[kind].wrong);
                return false;
            }
    return true;
}

// ---------------------------------------------------------------- the surface

// Seen against the normal, along its main axis: a coordinate less leaves the others exact.
static struct vec2 flattened(struct vec3 p, struct vec3 normal)
{
    double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z), side = normal.z;
    struct vec2 q = {p.x, p.y};
    if (x >= y && x >= z) {
        q = (struct vec2){p.y, p.z};
        side = normal.x;
    } else if (y >= z) {
        q = (struct vec2){p.z, p.x};
        side = normal.y;
    }
    return side < 0 ? (struct vec2){q.y, q.x} : q;
}

// False where the shalfedges from `first` on do not come back to it.
static bool walk_ring(struct nef *n, uint32_t first, struct vec3 normal, const struct mesh *m)
{
    uint32_t at = first;
    do {
        if (n->walked[at])
            return false;
        n->walked[at] = true;
        uint32_t vertex = n->halfedge_vertex[n->start_halfedge[at]], i = n->flat.point_count;
        array_reserve(&n->corners, &n->corner_room, (size_t)i + 1);
        n->corners[i] = vertex;
        outline_add(&n->flat, flattened(m->vertices[vertex], normal));
        at = n->next[at];
    } while (at != first);
    outline_close(&n->flat);
    return true;
}

static bool add_facet(struct nef *n, uint32_t facet, struct mesh_builder *b)
{
    static uint32_t whole[1][3] = {{0, 1, 2}};
    const struct facet *f = &n->facets[facet];
    n->flat.point_count = n->flat.path_count = 0;
    for (uint32_t i = facet ? f[-1].rings_end : 0; i < f->rings_end; i++)
        if (!walk_ring(n, n->rings[i], f->normal, &b->mesh))
            return false;
    uint32_t(*triangles)[3] = whole, count = 1;
    if (n->flat.point_count != 3)
        outline_triangulate(&n->flat, &triangles, &count);
    uint32_t face = mesh_add_face(b);
    for (uint32_t t = 0; t < count; t++)
        mesh_add_triangle(b, n->corners[triangles[t][0]], n->corners[triangles[t][1]],
                          n->corners[triangles[t][2]], face);
    if (triangles != whole)
        free(triangles);
    return true;
}

// From outside only: facets between two marked volumes, or two that are not, bound nothing.
static bool add_facets(struct nef *n, struct mesh_builder *b, struct error *err)
{
    n->walked = mem_zalloc(n->counts[SHALFEDGES] * sizeof *n->walked);
    n->flat.clean = true;
    for (uint32_t i = 0; i < n->counts[FACETS]; i++) {
        const struct facet *f = &n->facets[i];
        if (n->marked[f->volume] || !n->marked[n->facets[f->twin].volume])
            continue;
        if (!add_facet(n, i, b)) {
            error_at(err, (struct place){n->s.path, 0, 0}, "facet %u has no boundary that closes",
                     i);
            return false;
        }
    }
    return true;
}

bool read_nef3(const char *path, const char *data, size_t size, struct mesh *out, struct error *err)
{
    struct nef n = {0};
    struct mesh_builder b = {0};
    scan_open(&n.s, path, data, size);
    bool ok = read_header(&n, err) && read_items(&n, &b, err) && add_facets(&n, &b, err);
    scan_close(&n.s);
    free(n.halfedge_vertex);
    free(n.facets);
    free(n.rings);
    free(n.marked);
    free(n.start_halfedge);
    free(n.next);
    free(n.walked);
    free(n.corners);
    outline_free(&n.flat);
    if (!ok) {
        mesh_free(&b.mesh);
        return false;
    }
    mesh_weld(&b.mesh);
    *out = b.mesh;
    return true;
}
