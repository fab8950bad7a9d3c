// section.c - flat shapes from solids: what projection() makes of a leaf.
//
// Both shapes come as directed lines that form closed loops; what the loops wind around is inside.
#include "geom/section.h"

#include "base/mem.h"
#include "geom/clip.h"

#include <stdlib.h>

// Ends are pairs of vertices: an edge stands for where it meets the plane z = 0, the same for both
// of its triangles, and a vertex paired with itself for the vertex seen along z.
struct line {
    uint64_t from, to;
};

struct lines {
    struct line *items;
    uint32_t count, room;
};

static uint64_t pair_key(uint32_t i, uint32_t j)
{
    return i < j ? (uint64_t)i << 32 | j : (uint64_t)j << 32 | i;
}

static void add_line(struct lines *l, uint64_t from, uint64_t to)
{
    array_reserve(&l->items, &l->room, (size_t)l->count + 1);
    l->items[l->count++] = (struct line){from, to};
}

static int compare_keys(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

// In long double, so that a result that a double can say is that double and is not cut off to the
// grid place below it.
static struct vec2 place(const struct mesh *m, uint64_t pair)
{
    struct vec3 a = m->vertices[pair >> 32], b = m->vertices[pair & UINT32_MAX];
    if (a.z == b.z || a.z == 0)
        return (struct vec2){a.x, a.y};
    long double t = (long double)a.z / ((long double)a.z - b.z);
    return (struct vec2){(double)(a.x + t * ((long double)b.x - a.x)),
                         (double)(a.y + t * ((long double)b.y - a.y))};
}

static uint32_t first_from(const struct lines *l, uint64_t from)
{
    uint32_t low = 0, high = l->count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (l->items[middle].from < from)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

// Joins lines end to end. As many lines start as end everywhere, so that a way that takes each line
// once only ends where it began, whichever it takes of several.
static void trace(const struct mesh *m, struct lines *l, struct outline *out)
{
    if (l->count)
        qsort(l->items, l->count, sizeof *l->items, compare_keys);
    uint32_t *taken = mem_zalloc((size_t)l->count * sizeof *taken); // of those from one place
    for (uint32_t i = 0; i < l->count;) {
        uint32_t first = first_from(l, l->items[i].from);
        if (taken[first] > i - first) {
            i++;
            continue;
        }
        uint32_t start = out->point_count;
        uint64_t at = l->items[first].from, end = at;
        do {
            uint32_t next = first_from(l, at);
            uint32_t take = next < l->count ? next + taken[next] : next;
            if (take >= l->count || l->items[take].from != at) { // an open mesh
                out->point_count = start;
                break;
            }
            taken[next]++;
            outline_add(out, place(m, at));
            at = l->items[take].to;
        } while (at != end);
        outline_close(out);
    }
    free(taken);
    free(l->items);
    *l = (struct lines){0};
}

// The lines in which triangles meet the plane, the solid to their left seen from above. Vertices in
// the plane count as being above it or below it: as if the plane lay a little lower or higher.
static void cut_lines(const struct mesh *m, bool zero_is_above, struct lines *out)
{
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *c = m->triangles[t];
        bool above[3];
        for (int i = 0; i < 3; i++) {
            double z = m->vertices[c[i]].z;
            above[i] = z > 0 || (z == 0 && zero_is_above);
        }
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            if (above[i] == above[j] || above[i] == above[k])
                continue;
            uint64_t right = pair_key(c[i], c[j]), left = pair_key(c[k], c[i]);
            if (above[i])
                add_line(out, right, left);
            else
                add_line(out, left, right);
        }
    }
}

struct edge {
    uint64_t pair;
    int32_t turn; // 1 from the smaller to the larger number
};

static double facing(const struct mesh *m, const uint32_t *c)
{
    struct vec3 a = m->vertices[c[0]], b = m->vertices[c[1]], d = m->vertices[c[2]];
    return (b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x);
}

// The edges that bound all triangles that face up, or down; edges between two of them cancel. The
// loops wind around each point as often as triangles cover it, whatever these overlap, so that
// they say the union of the triangles and no triangle needs to be united with another.
static void border_lines(const struct mesh *m, bool up, struct lines *out)
{
    struct edge *edges = mem_alloc((size_t)m->triangle_count * 3 * sizeof *edges);
    size_t count = 0;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *c = m->triangles[t];
        double side = facing(m, c);
        for (int i = 0; i < 3 && (up ? side > 0 : side < 0); i++) {
            uint32_t from = c[i], to = c[(i + 1) % 3];
            edges[count++] = (struct edge){pair_key(from, to), (from < to) == up ? 1 : -1};
        }
    }
    qsort(edges, count, sizeof *edges, compare_keys);
    for (size_t i = 0, end; i < count; i = end) {
        int32_t turn = 0;
        for (end = i; end < count && edges[end].pair == edges[i].pair; end++)
            turn += edges[end].turn;
        uint32_t low = (uint32_t)(edges[i].pair >> 32), high = (uint32_t)edges[i].pair;
        for (; turn > 0; turn--)
            add_line(out, pair_key(low, low), pair_key(high, high));
        for (; turn < 0; turn++)
            add_line(out, pair_key(high, high), pair_key(low, low));
    }
    free(edges);
}

// The union of what two sets of lines run around.
static bool unite(struct outline *out, const struct mesh *m,
                  void (*find_lines)(const struct mesh *m, bool first, struct lines *out))
{
    struct outline parts[2] = {{0}, {0}};
    for (int i = 0; i < 2; i++) {
        struct lines l = {0};
        find_lines(m, i == 1, &l);
        trace(m, &l, &parts[i]);
    }
    const struct outline *shapes[2] = {&parts[0], &parts[1]};
    bool done = clip_nonzero(out, shapes, 2);
    outline_free(&parts[0]);
    outline_free(&parts[1]);
    return done;
}

// The sections a little above and a little below the plane, both shrunk onto it, are all of the
// solid's points in the plane but for those where it only touches it in lines and points: a face
// that lies in the plane bounds one of the two.
bool section_cut(struct outline *out, const struct mesh *m)
{
    return unite(out, m, cut_lines);
}

// Of a closed mesh either half would do: a line along z that meets no edge leaves the solid as
// often as it enters it. Open meshes, which OpenSCAD projects too, need both.
bool section_shadow(struct outline *out, const struct mesh *m)
{
    return unite(out, m, border_lines);
}
