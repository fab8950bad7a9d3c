// device.h - what a renderer of bodies answers; who consumes it does not know which device ran.
#pragma once
#include "base/error.h"
#include "model/model.h"
#include "render/rays.h"

#include <stdatomic.h>

#define SURFACE_NONE UINT32_MAX // in `leaf`: nothing there
#define SURFACE_CAP  UINT32_MAX // in `face`: solid cut open by the near plane

// First visible surface of each pixel, row by row from the top. Where nothing is, depth is INFINITY
// and face is not written.
struct surface_image {
    int width, height;
    float *depth;   // depth - rays.reference in mm
    uint32_t *leaf; // leaf number within the body or SURFACE_NONE
    uint32_t *face; // face of the leaf's solid or SURFACE_CAP
};

// Pixels [x0, x1) x [y0, y1).
struct pixel_rect {
    int x0, y0, x1, y1;
};

// One solid interval of a ray.
struct span {
    float enter, leave;              // depth - rays.reference in mm
    uint32_t enter_leaf, enter_face; // enter_face is SURFACE_CAP when solid at the near plane
    uint32_t leave_leaf, leave_face; // leave_leaf is SURFACE_NONE when solid at the far plane
};

// Intervals of a rectangle of pixels, in the order of depth for each ray: pixel i = (y - y0) * (x1
// - x0) + (x - x0) has spans[first[i] .. first[i + 1]). Valid during the call only.
struct span_block {
    int x0, y0, x1, y1;
    const uint32_t *first;
    const struct span *spans;
};

enum walk {
    WALK_AUTO,
    WALK_HASH,  // first surfaces too by listed crossings
    WALK_ARRAY, // the same, with the expression over classes for each interval; for the bench
};

enum discovery_scheme {
    DISCOVER_AT_ONCE,     // no picture is wrong
    DISCOVER_OVER_FRAMES, // gl: what is unknown shows as empty until a later frame; for the bench
};

struct render_settings {
    double epsilon;   // intervals thinner than this across their faces do not exist, mm
    uint32_t threads; // 0: one per processor
    size_t memory;    // budget in bytes for a frame beyond model and outputs; 0: 256 MB
    uint32_t slabs;   // gl: at least so many slabs of depth; 0: as many as the budget demands
    enum walk walk;
    enum discovery_scheme discovery;
    bool linked; // gl: crossings in linked lists, in order at once; for the bench
    bool sparse; // where no leaf can be, outputs are neither written nor told
    // Per leaf of the body, or NULL: the crossings with it that are listed are added. By the cpu
    // device alone, see cost.h.
    _Atomic uint64_t *crossings;
    const atomic_bool *cancelled; // once true, the frame ends early and means nothing; NULL: never
};

// What the time of a frame went into.
struct render_pass {
    const char *name; // static; NULL: no more passes
    double seconds;   // of the graphics processor, but for "discover"
    uint64_t count;   // how often it was taken
};
enum { RENDER_PASSES = 14 };

// What the processor waited for the graphics processor.
struct render_waits {
    uint64_t count;
    double seconds, longest;
};
void render_waits_add(struct render_waits *sum, const struct render_waits *one);

struct render_stats {
    double seconds_setup, seconds_draw;
    uint64_t fragments;   // crossings made
    uint64_t misses;      // combinations evaluated during the frame
    uint64_t missing;     // rays that show an unknown one as empty: DISCOVER_OVER_FRAMES
    uint64_t open_rays;   // rays on which a mesh did not close
    size_t peak_bytes;    // beyond model and outputs
    size_t model_bytes;   // gl: of bodies, where shaders see them
    uint64_t table_bytes; // gl: of tables, sent there
    struct render_waits waits;
    struct render_pass passes[RENDER_PASSES]; // of devices that have them
};
void render_stats_add(struct render_stats *sum, const struct render_stats *one);
// Adds to the pass of that name, for devices.
void render_stats_pass(struct render_stats *stats, const struct render_pass *pass);

// The device on the processor: any number of threads, bit-identical results.
struct device;
struct device *cpu_device_new(void);

void device_delete(struct device *d); // NULL: nothing to do

// Fills *out (arrays of width * height, owned by the caller). `drawn`, unless NULL, is called for
// rectangles that cover the picture, each pixel once, when their surfaces are there, from several
// threads at once; `nothing` says that no pixel of it has a surface. NULL stats: nobody asks.
void device_first_surface(struct device *d, const struct body *body, const struct rays *rays,
                          const struct render_settings *settings, struct surface_image *out,
                          void (*drawn)(void *context, struct pixel_rect rect, bool nothing),
                          void *context, struct render_stats *stats);

// Calls `sink` for blocks that cover the picture, each pixel once, from several threads at once
// (worker numbers below parallel_workers(threads)).
void device_spans(struct device *d, const struct body *body, const struct rays *rays,
                  const struct render_settings *settings,
                  void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                  void *context, struct render_stats *stats);

// What has gone wrong since this was last asked, as one line; false: nothing. The pictures are
// whole nevertheless: from where a device fails, the one on the processor takes over for good.
bool device_failed(struct device *d, struct error *why);

// What a program lends to its device; what is NULL is not lent.
struct device_host {
    // Takes what an OpenGL driver and the compiler of its shaders have to say, one line each, from
    // whichever thread draws. Only while shaders are developed, in the folder HCSG_SHADERS.
    void (*say)(void *context, const char *line);
    // Makes a context of OpenGL 4.5 of the program's current on this thread, for drivers that give
    // none without a window. It has to stay until the device is deleted.
    bool (*open_context)(void *context, struct error *err);
    void *context;
};

// What makes a device: the functions above, with the same contracts, but that they return how many
// rows from the top are done and told, and that stats are never NULL. Fewer than all: the device
// has failed, *err says why, and it will be asked no more. A frame that was cancelled counts as
// done. Each device begins with a struct device.
struct device_kind {
    int (*first_surface)(struct device *d, const struct body *body, const struct rays *rays,
                         const struct render_settings *settings, struct surface_image *out,
                         void (*drawn)(void *context, struct pixel_rect rect, bool nothing),
                         void *context, struct render_stats *stats, struct error *err);
    int (*spans)(struct device *d, const struct body *body, const struct rays *rays,
                 const struct render_settings *settings,
                 void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                 void *context, struct render_stats *stats, struct error *err);
    void (*delete)(struct device *d);
};

struct device {
    const struct device_kind *kind;
    char description[300];  // what it draws with, "" for nothing to be said
    struct device *instead; // has taken over; NULL: this one works
    struct error failure;   // not yet asked for; empty: none
};
