// lists.c - the passes that list the crossings of rays: which leaves, how many crossings, where.
#include "render/gl/pass.h"

#include <epoxy/gl.h>

size_t gl_links_size(size_t pixels, size_t crossings)
{
    return (2 * pixels + 1 + crossings) * 4;
}

enum { SCAN_LEVELS = 3 }; // 2^30 numbers

static bool scan_levels(struct gl_work *w, const struct gl_buffer *from, const struct gl_buffer *to,
                        size_t n, struct error *err)
{
    size_t count[SCAN_LEVELS + 1] = {n};
    const struct gl_buffer *level[SCAN_LEVELS + 1] = {to};
    uint32_t levels = 0;
    do {
        count[levels + 1] = (count[levels] + SCAN_BLOCK - 1) / SCAN_BLOCK;
        level[levels + 1] = &w->sums[levels];
        if (!gl_buffer_grow(&w->sums[levels], w->memory, "sums", count[levels + 1] * 4, err))
            return false;
    } while (count[++levels] > 1);
    for (uint32_t i = 0; i < levels; i++) {
        gl_buffer_bind_part(from, BIND_SCAN_IN, 0, n * 4);
        gl_buffer_bind_part(level[i], BIND_SCAN_OUT, 0, count[i] * 4);
        gl_buffer_bind_part(level[i + 1], BIND_SCAN_SUMS, 0, count[i + 1] * 4);
        if (!gl_pass_take(w, "scan", i ? "IN_PLACE" : "SCAN", count[i + 1], err))
            return false;
    }
    for (uint32_t i = levels - 1; i-- > 0;) {
        gl_buffer_bind_part(level[i], BIND_SCAN_OUT, 0, count[i] * 4);
        gl_buffer_bind_part(level[i + 1], BIND_SCAN_SUMS, 0, count[i + 1] * 4);
        if (!gl_pass_take(w, "scan", "ADD", count[i + 1], err))
            return false;
    }
    return true;
}

// to[i] = the sum of from[0 .. i) for n numbers.
static bool scan(struct gl_work *w, const struct gl_buffer *from, const struct gl_buffer *to,
                 size_t n, struct error *err)
{
    gl_timer_begin(&w->timers, "scan");
    bool fine = scan_levels(w, from, to, n, err);
    gl_timer_end(&w->timers);
    return fine;
}

static void bind_triangles(const struct gl_work *w, const struct gl_scene *scene,
                           const struct gl_buffer *counts)
{
    gl_pass_bind(w, scene);
    gl_buffer_bind(&w->views, BIND_VIEWS);
    gl_buffer_bind(&scene->solids->vertices, BIND_VERTICES);
    gl_buffer_bind(&scene->solids->triangles, BIND_TRIANGLES);
    gl_buffer_bind(&scene->solids->planes, BIND_PLANES);
    gl_buffer_bind(&w->starts, BIND_STARTS);
    gl_buffer_bind(&w->large, BIND_LARGE);
    gl_buffer_bind(counts, BIND_COUNTS);
    gl_pass_bind_lists(w);
    gl_buffer_bind(&w->states, BIND_STATES);
}

// Takes all triangles, then all pieces of large ones; `define` says what for.
static bool draw(struct gl_work *w, const struct gl_scene *scene, const struct gl_buffer *counts,
                 const char *pass, const char *define, const char *define_pieces, struct error *err)
{
    bind_triangles(w, scene, counts);
    gl_timer_begin(&w->timers, pass);
    bool fine = gl_pass_take(w, "arguments", "TRIANGLES", 1, err) &&
                gl_pass_take_counted(w, "fragments", define, err) &&
                gl_pass_take(w, "arguments", "", 1, err) &&
                gl_pass_take_counted(w, "fragments", define_pieces, err);
    gl_timer_end(&w->timers);
    return fine;
}

static bool select_leaves(struct gl_work *w, const struct gl_scene *scene, struct error *err)
{
    gl_pass_bind(w, scene);
    gl_buffer_bind(&w->views, BIND_VIEWS);
    gl_buffer_bind(&w->counts, BIND_COUNTS);
    gl_timer_begin(&w->timers, "select");
    bool fine = gl_pass_take(w, "select", "", scene->leaf_count / GROUP_SIZE + 1, err);
    gl_timer_end(&w->timers);
    return fine && scan(w, &w->counts, &w->starts, (size_t)scene->leaf_count + 1, err);
}

static bool make_fragments(struct gl_work *w, size_t room, struct error *err)
{
    return gl_buffer_grow(&w->fragments, w->memory, "fragments", room * sizeof(struct fragment),
                          err);
}

static void count_anew(const struct gl_work *w)
{
    static const uint32_t none;
    gl_buffer_write(&w->counters, offsetof(struct counters, large), &none, 4);
    gl_buffer_write(&w->counters, offsetof(struct counters, fragments), &none, 4);
    gl_buffer_write(&w->counters, offsetof(struct counters, wrapped), &none, 4);
}

// Room for at least so many crossings that are linked.
static bool make_linked(struct gl_work *w, const struct frame_data *f, uint32_t fragments,
                        struct error *err)
{
    size_t room = gl_pass_reserve(fragments, w->plan.fragments);
    return make_fragments(w, room, err) &&
           gl_buffer_grow(&w->links, w->memory, "links", gl_links_size(gl_pass_pixels(f), room),
                          err);
}

// Links the crossings, as many as there is room for, and counts them.
static bool link_crossings(struct gl_work *w, const struct gl_scene *scene, struct frame_data *f,
                           struct counters *c, struct error *err)
{
    size_t others = gl_links_size(gl_pass_pixels(f), 0);
    if (!make_linked(w, f, 1, err))
        return false;
    size_t links = (w->links.size - others) / 4, most = w->fragments.size / sizeof(struct fragment);
    f->crossings_most = (uint32_t)(links < most ? links : most);
    gl_buffer_write(&w->frame, 0, f, sizeof *f);
    count_anew(w);
    gl_buffer_fill(&w->links, 0, others, 0);
    return draw(w, scene, &w->bins, "insert", "LINKED", "LINKED PIECES", err) &&
           gl_pass_read(w, &w->counters, c, sizeof *c, err);
}

static bool count_linked(struct gl_work *w, const struct gl_scene *scene, struct frame_data *f,
                         uint32_t *fragments, uint32_t *pieces, struct error *err)
{
    struct counters c;
    if (!link_crossings(w, scene, f, &c, err))
        return false;
    bool fits = c.large <= f->large_most && !c.wrapped && c.fragments <= w->plan.fragments;
    if (fits && c.fragments > f->crossings_most &&
        (!make_linked(w, f, c.fragments, err) || !link_crossings(w, scene, f, &c, err)))
        return false;
    *fragments = c.fragments < CROSSINGS_MOST ? c.fragments : UINT32_MAX;
    *pieces = c.wrapped ? UINT32_MAX : c.large;
    return true;
}

bool gl_work_count(struct gl_work *w, const struct gl_scene *scene, struct frame_data *f,
                   uint32_t *fragments, uint32_t *pieces, struct error *err)
{
    size_t pixels = gl_pass_pixels(f);
    f->large_most = (uint32_t)(w->large.size / 16);
    f->windings = scene->windings;
    gl_buffer_write(&w->frame, 0, f, sizeof *f);
    if (!select_leaves(w, scene, err))
        return false;
    if (w->linked)
        return count_linked(w, scene, f, fragments, pieces, err);
    count_anew(w);
    gl_buffer_fill(&w->pixel_counts, 0, (pixels + 1) * 4, 0);
    // A buffer of any size: nothing is written to it.
    if (!make_fragments(w, 1, err) ||
        !draw(w, scene, &w->pixel_counts, "count", "COUNT", "COUNT PIECES", err) ||
        !scan(w, &w->pixel_counts, &w->offsets, pixels + 1, err))
        return false;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl_buffer_copy(&w->offsets, pixels * 4, &w->counters, offsetof(struct counters, fragments), 4);
    struct counters c;
    if (!gl_pass_read(w, &w->counters, &c, sizeof c, err))
        return false;
    *fragments = c.fragments;
    *pieces = c.wrapped ? UINT32_MAX : c.large;
    return true;
}

bool gl_work_histogram(struct gl_work *w, const struct gl_scene *scene, struct frame_data *f,
                       float from, float to, uint32_t bins[BINS], struct error *err)
{
    f->bins_from = from;
    f->bins_each = (float)(BINS / ((double)to - (double)from));
    gl_buffer_write(&w->frame, 0, f, sizeof *f);
    gl_buffer_fill(&w->bins, 0, BINS * 4, 0);
    return draw(w, scene, &w->bins, "histogram", "HISTOGRAM", "HISTOGRAM PIECES", err) &&
           gl_pass_read(w, &w->bins, bins, BINS * 4, err);
}

bool gl_work_scatter(struct gl_work *w, const struct gl_scene *scene, const struct frame_data *f,
                     uint32_t fragments, bool spans, struct error *err)
{
    size_t room = gl_pass_reserve(fragments, w->plan.fragments);
    w->crossings = fragments;
    size_t places = room / 2 + gl_pass_pixels(f); // a ray of n crossings has n / 2 + 1 at most
    if (spans &&
        !gl_buffer_grow(&w->output, w->memory, "output", places * sizeof(struct span_data), err))
        return false;
    return w->linked || (make_fragments(w, room, err) && draw(w, scene, &w->pixel_counts, "scatter",
                                                              "SCATTER", "SCATTER PIECES", err));
}
