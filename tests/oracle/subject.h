// subject.h - what is under test: bodies made as the model makes them, and the device's pictures.
#pragma once
#include "oracle.h"
#include "random_tree.h"
#include "render/device.h"

struct subject {
    struct solid *solids;
    uint32_t solid_count;
    struct body body;
};

void subject_make(struct subject *out, const struct random_scene *scene);
void subject_free(struct subject *s); // leaves {0}

// The leaves of a body for the oracle, and its expression in postfix order; the caller frees both.
struct oracle_leaf *subject_leaves(const struct body *body);
struct expr_token *subject_tokens(const struct expr *e, size_t *count);

// A device for each worker of parallel_for.
struct crew {
    struct device **devices;
    uint32_t count;
};
void crew_init(struct crew *out, uint32_t threads, bool gl);
void crew_free(struct crew *c); // leaves {0}

// The one under test. Where there is no OpenGL the program says so and ends: skipped.
struct device *device_under_test(bool gl);

struct pixel_spans {
    struct span *items;
    uint32_t count, visits;
};

struct picture {
    struct surface_image image;
    struct pixel_spans *spans; // per pixel
    struct render_stats surface_stats, span_stats;
};

void picture_render(struct picture *out, struct device *device, const struct body *body,
                    const struct rays *rays, const struct render_settings *settings);
void picture_free(struct picture *p); // leaves {0}
bool picture_equal(const struct picture *a, const struct picture *b, int *x, int *y);
