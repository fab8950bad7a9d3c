// mesh.c - intervals of closed triangle meshes on the rays of a block, by winding number.
#include "render/cpu/mesh_scan.h"

#include "base/mem.h"

#include <float.h>

static bool before(const struct mesh_crossing *a, const struct mesh_crossing *b)
{
    if (a->key != b->key)
        return a->key < b->key;
    return a->sign != b->sign ? a->sign < b->sign : a->triangle < b->triangle;
}

// By ray, then along the ray.
static void sort_crossings(struct mesh_pool *m)
{
    uint32_t next[BLOCK_PIXELS + 1] = {0};
    array_reserve(&m->sorted, &m->sorted_capacity, m->crossing_count);
    for (uint32_t i = 0; i < m->crossing_count; i++)
        next[m->crossings[i].ray + 1]++;
    for (int i = 0; i < BLOCK_PIXELS; i++)
        next[i + 1] += next[i];
    for (uint32_t i = 0; i < m->crossing_count; i++)
        m->sorted[next[m->crossings[i].ray]++] = m->crossings[i];
    for (uint32_t i = 1; i < m->crossing_count; i++) {
        struct mesh_crossing c = m->sorted[i];
        uint32_t j = i;
        for (; j && m->sorted[j - 1].ray == c.ray && before(&c, &m->sorted[j - 1]); j--)
            m->sorted[j] = m->sorted[j - 1];
        m->sorted[j] = c;
    }
}

// Appends an interval to those of the ray that begin at `begun`.
static void add_interval(struct tile *t, uint32_t begun, struct mesh_interval now)
{
    struct mesh_pool *m = &t->mesh;
    float start = t->frame->start, end = t->frame->end;
    if (m->interval_count > begun && m->intervals[m->interval_count - 1].leave >= now.enter) {
        const struct mesh_interval *last = &m->intervals[--m->interval_count];
        now.enter = last->enter; // touching: one interval
        now.enter_triangle = last->enter_triangle;
        now.enter_steep = last->enter_steep;
    }
    if (now.leave <= start || now.enter >= end || now.leave <= now.enter)
        return;
    now.enter = now.enter < start ? start : now.enter;
    if (now.leave >= end) { // cut open there
        now.leave = end;
        now.leave_triangle = SURFACE_CAP;
        now.leave_steep = 1;
    }
    array_reserve(&m->intervals, &m->interval_capacity, m->interval_count + 1);
    m->intervals[m->interval_count++] = now;
}

// A face of a mesh that does not close: just thick enough to exist.
static struct mesh_interval sheet(const struct tile *t, const struct mesh_crossing *c)
{
    const struct frame *f = t->frame;
    float growth = f->rays->orthographic ? 1 : 1 - c->key / (float)f->t0; // as in find_band
    float width = 2 * f->epsilon * growth * growth / fmaxf(c->steep, STEEP_LEAST);
    return (struct mesh_interval){.enter = c->key,
                                  .leave = fmaxf(c->key + width, nextafterf(c->key, FLT_MAX)),
                                  .enter_triangle = c->triangle,
                                  .leave_triangle = c->triangle,
                                  .enter_steep = c->steep,
                                  .leave_steep = c->steep};
}

// Makes intervals of the sorted crossings of one ray. The winding number before the first crossing
// is `winding`; inside is where it is not 0. Of what never closes only the faces are there.
static void make_intervals(struct tile *t, const struct mesh_crossing *c, uint32_t n, int winding)
{
    struct mesh_interval now = {
        .enter = t->frame->start, .enter_triangle = SURFACE_CAP, .enter_steep = 1};
    uint32_t begun = t->mesh.interval_count, open = 0;

    for (uint32_t i = 0; i < n; i++) {
        int before_it = winding;
        winding += c[i].sign;
        if (!before_it) {
            now.enter = c[i].key;
            now.enter_triangle = c[i].triangle;
            now.enter_steep = c[i].steep;
        } else if (!winding) {
            now.leave = c[i].key;
            now.leave_triangle = c[i].triangle;
            now.leave_steep = c[i].steep;
            add_interval(t, begun, now);
            open = i + 1;
        }
    }
    t->open_rays += winding != 0;
    for (uint32_t i = open; winding && i < n; i++)
        add_interval(t, begun, sheet(t, &c[i]));
}

struct block_leaf *tile_mesh_block(struct tile *t, struct tile_leaf *l, struct block_leaf *out)
{
    const struct frame *f = t->frame;
    struct mesh_pool *m = &t->mesh;
    bool orthographic = f->rays->orthographic;

    mesh_scan(t, l);
    if (!m->crossing_count)
        return NULL;
    sort_crossings(m);
    bool may_start_inside = !orthographic && f->leaves[l->frame_leaf].near <= f->start;
    out->interval = m->interval_count;
    out->near = FLT_MAX;
    out->far = -FLT_MAX;
    float steep = FLT_MAX;
    uint32_t at = 0;
    for (uint32_t ray = 0; ray < BLOCK_PIXELS; ray++) {
        out->first[ray] = m->interval_count - out->interval;
        uint32_t begun = at;
        int sum = 0;
        for (; at < m->crossing_count && m->sorted[at].ray == ray; at++) {
            sum += m->sorted[at].sign;
            steep = m->sorted[at].steep < steep ? m->sorted[at].steep : steep;
        }
        make_intervals(t, m->sorted + begun, at - begun, may_start_inside ? -sum : 0);
    }
    out->first[BLOCK_PIXELS] = m->interval_count - out->interval;
    for (uint32_t i = out->interval; i < m->interval_count; i++) {
        out->near = fminf(out->near, m->intervals[i].enter);
        out->far = fmaxf(out->far, m->intervals[i].leave);
    }
    if (!(out->near < out->far))
        return NULL;
    float growth = orthographic ? 1 : 1 - out->near / (float)f->t0;
    out->band = 1.01f * f->epsilon * growth * growth / fmaxf(steep, STEEP_LEAST);
    out->mesh = true;
    out->front = out->back = 0;
    return out;
}
