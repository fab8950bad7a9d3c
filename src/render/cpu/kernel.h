// kernel.h - the work of one tile, compiled for several instruction sets.
#pragma once
#include "render/cpu/frame.h"

struct kernel_totals {
    uint64_t fragments, misses, open_rays;
    size_t bytes;
};

struct kernel_job {
    const struct frame *frame;
    size_t memory;               // for one worker
    struct surface_image *image; // first surface; NULL: spans
    void (*drawn)(void *context, struct pixel_rect rect, bool nothing); // NULL: nobody asks
    void (*sink)(void *context, uint32_t worker, const struct span_block *block);
    void *context;
};

// A worker is kept from frame to frame: its pools are large.
struct kernel {
    void *(*worker_new)(const struct kernel_job *job, uint32_t worker);
    bool (*worker_reuse)(void *worker, const struct kernel_job *job);     // false: it is too small
    void (*worker_add)(const void *worker, struct kernel_totals *add_to); // of this frame
    void (*worker_delete)(void *worker);
    void (*tile)(void *worker, const struct kernel_job *job, uint32_t tile_number);
};

extern const struct kernel kernel_baseline, kernel_avx2;
