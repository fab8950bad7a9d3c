// passes.h - the passes of a band and slab: which leaves, how many crossings, the crossings, walks.
#pragma once
#include "render/gl/array.h"
#include "render/gl/discover.h"
#include "render/gl/frame.h"
#include "render/gl/learner.h"
#include "render/gl/plan.h"
#include "render/gl/program.h"
#include "render/gl/readback.h"
#include "render/gl/scene.h"
#include "render/gl/timer.h"

// Buffers of a frame. All are kept from frame to frame and grow as needed, as far as planned.
struct gl_work {
    struct gl_memory *memory; // account of what follows from the picture
    struct gl_memory *model;  // and of what has as many entries as the body
    struct gl_plan plan;
    struct gl_programs *programs;
    struct gl_buffer frame, counters;
    struct gl_buffer views, starts, counts; // per leaf; counts of a select serve the scan only
    struct gl_buffer large;
    struct gl_buffer pixel_counts, offsets, links, states, output, span_counts;
    struct gl_buffer pending[2], misses, claims;
    struct gl_buffer fragments, bins;
    uint32_t crossings;       // of the band and slab, all rays together
    struct gl_buffer sums[3]; // of the blocks of a scan
    struct gl_readback readback;
    struct gl_timers timers;      // of the passes of a picture
    const struct gl_array *array; // walks go by it; NULL: by the table
    struct gl_learner *learner;   // unknown combinations go there; NULL: rays wait for them
    bool linked;                  // lists are, by their offsets
};

void gl_work_free(struct gl_work *w);

// Gives back what is larger than the plan for a picture of `budget` bytes allows.
void gl_work_begin(struct gl_work *w, const struct gl_plan *plan, size_t budget, bool spans);

// The others return false when there is no room, or when the driver cannot compile or was reset.

// Brings parts of buffers to the processor, in as many steps as planned.
bool gl_work_read(struct gl_work *w, const struct gl_part *parts, uint32_t count,
                  struct error *err);

// Room for everything that belongs to leaves and pixels of a band of `rows` rows.
bool gl_work_prepare(struct gl_work *w, const struct gl_scene *scene, const struct frame_data *f,
                     bool spans, struct error *err);
// How each leaf shows in the picture.
bool gl_work_views(struct gl_work *w, const struct gl_scene *scene, const struct frame_data *f,
                   struct error *err);
// Counts the crossings of a band and slab, and links them if lists are; *pieces: of large
// triangles. When these are more than f->large_most the count means nothing. UINT32_MAX: so many or
// more.
bool gl_work_count(struct gl_work *w, const struct gl_scene *scene, struct frame_data *f,
                   uint32_t *fragments, uint32_t *pieces, struct error *err);
// Room for so many pieces of large triangles.
bool gl_work_pieces(struct gl_work *w, uint32_t pieces, struct error *err);
// How many of the crossings that were counted lie in each of BINS parts of the keys [from, to].
bool gl_work_histogram(struct gl_work *w, const struct gl_scene *scene, struct frame_data *f,
                       float from, float to, uint32_t bins[BINS], struct error *err);
// Makes the crossings that were counted, unless they are linked, and room for what comes of them.
bool gl_work_scatter(struct gl_work *w, const struct gl_scene *scene, const struct frame_data *f,
                     uint32_t fragments, bool spans, struct error *err);
// Walks the rays until no combination is unknown. *stuck: rays of w->pending[0] that cannot go on,
// since the table has no room for what they need. *alive: rays that go on into the next slab.
bool gl_work_resolve(struct gl_work *w, struct gl_scene *scene, struct frame_data *f,
                     struct gl_table *table, const struct body *body, bool spans, uint32_t *stuck,
                     uint32_t *alive, struct render_stats *stats, struct error *err);
