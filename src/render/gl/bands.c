// bands.c - a picture cut into bands of rows and slabs of depth that fit the budget.
#include "render/gl/bands.h"

#include <math.h>

enum outcome { BAND_DONE, BAND_TOO_LARGE, BAND_FAILED };

static bool cancelled(const struct gl_drawing *g)
{
    const atomic_bool *c = g->settings->cancelled;
    return c && atomic_load_explicit(c, memory_order_relaxed);
}

// The nearest of the slabs to come.
static void next_slab(struct gl_drawing *g)
{
    g->frame.slab_end = g->slabs.ends[--g->slabs.count];
    g->frame.slab_last = !g->slabs.count;
}

// Puts slabs in place of the one that was counted, which begins behind `begin`.
static enum outcome split(struct gl_drawing *g, float begin, uint32_t fragments, uint32_t wanted)
{
    struct frame_data *f = &g->frame;
    uint32_t bins[BINS], most = g->work->plan.fragments;
    float end = fminf(f->slab_end, g->far);
    if (g->whole || !(begin < end))
        return BAND_TOO_LARGE;
    if (!gl_work_histogram(g->work, g->scene, f, begin, end, bins, g->err))
        return BAND_FAILED;
    uint64_t counted = 0;
    for (uint32_t i = 0; i < BINS; i++)
        counted += bins[i];
    // What is not in the bins is in every slab. Of each some is left for clusters that reach into
    // it.
    bool known = fragments < UINT32_MAX && counted < fragments;
    uint64_t room = most - most / 8, others = known ? fragments - counted : 0;
    if (others >= room)
        return BAND_TOO_LARGE;
    g->slabs.count++; // the slab that was counted stays, as the last of those
    bool fine = gl_slabs_cut(&g->slabs, bins, begin, end, room - others, wanted);
    next_slab(g);
    return fine ? BAND_DONE : BAND_TOO_LARGE;
}

// Makes the crossings of the nearest slab to come, or of as much of it as there is room for.
static enum outcome fill(struct gl_drawing *g, float begin)
{
    struct frame_data *f = &g->frame;
    const struct gl_plan *p = &g->work->plan;
    uint32_t fragments, pieces, wanted = f->slab_first ? g->settings->slabs : 0;
    next_slab(g);
    for (;;) {
        if (!gl_work_count(g->work, g->scene, f, &fragments, &pieces, g->err))
            return BAND_FAILED;
        if (pieces > p->pieces)
            return BAND_TOO_LARGE;
        if (pieces > f->large_most) {
            if (!gl_work_pieces(g->work, pieces, g->err))
                return BAND_FAILED;
            continue;
        }
        bool fits = fragments <= p->fragments;
        if (fits && (wanted <= 1 || !fragments))
            break;
        enum outcome o = split(g, begin, fragments, wanted);
        if (o != BAND_DONE && !(o == BAND_TOO_LARGE && fits))
            return o;
        wanted = 0;
    }
    g->stats->fragments += fragments;
    bool fine = gl_work_scatter(g->work, g->scene, f, fragments, g->spans, g->err);
    return fine ? BAND_DONE : BAND_FAILED;
}

static enum outcome draw_band(struct gl_drawing *g)
{
    struct frame_data *f = &g->frame;
    float begin = g->near;
    uint32_t alive = 1, stuck = 0;
    if (!gl_work_prepare(g->work, g->scene, f, g->spans, g->err) ||
        !gl_work_views(g->work, g->scene, f, g->err))
        return BAND_FAILED;
    gl_slabs_begin(&g->slabs, f->end);
    for (f->slab_first = true; alive && g->slabs.count; f->slab_first = false) {
        enum outcome o = fill(g, begin);
        if (o != BAND_DONE)
            return o;
        if (!gl_work_resolve(g->work, g->scene, f, g->table, g->body, g->spans, &stuck, &alive,
                             g->stats, g->err))
            return BAND_FAILED;
        if (stuck) {
            error_set(g->err, "%u rays meet combinations of which too many share a primary key",
                      stuck);
            return BAND_FAILED;
        }
        if (cancelled(g))
            break;
        if (!g->take(g, GL_SLAB))
            return BAND_FAILED;
        begin = f->slab_end;
    }
    return BAND_DONE;
}

// Halves what a band holds. False: it is one pixel.
static bool halve(const struct frame_data *f, int *rows, int *columns)
{
    if (f->rows > 1)
        *rows = f->rows / 2;
    else
        *columns = f->columns / 2;
    return *columns > 0;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

int gl_bands_draw(struct gl_drawing *g)
{
    struct frame_data *f = &g->frame;
    int rows = g->work->plan.rows, columns = g->work->plan.columns;
    for (f->band = f->column = 0; f->band < f->height;) {
        f->rows = least(rows, f->height - f->band);
        f->columns = least(columns, f->width - f->column);
        enum outcome o = draw_band(g);
        if (cancelled(g))
            return f->height;
        if (o == BAND_TOO_LARGE) {
            if (!g->take(g, GL_AGAIN))
                return f->band;
            if (halve(f, &rows, &columns))
                continue;
            error_set(g->err, "crossings at one depth of a pixel need more memory than there is");
            return f->band;
        }
        if (o == BAND_FAILED || gl_context_failed(g->context, g->err) || !g->take(g, GL_BAND))
            return f->band;
        f->column += f->columns;
        if (f->column < f->width)
            continue;
        if (!g->take(g, GL_ROWS))
            return f->band;
        f->column = 0;
        f->band += f->rows;
    }
    return f->height;
}
