// cost.c - what leaves cost: the crossings of rays with their faces.
#include "render/cost.h"

#include "base/mem.h"

#include <stdlib.h>

static void drop(void *context, uint32_t worker, const struct span_block *block)
{
    (void)context;
    (void)worker;
    (void)block;
}

void cost_count(const struct body *body, const struct rays *rays,
                const struct render_settings *settings, uint64_t *crossings)
{
    struct render_settings counting = *settings;
    counting.crossings = mem_zalloc(((size_t)body->leaf_count + 1) * sizeof *counting.crossings);
    struct device *d = cpu_device_new();
    device_spans(d, body, rays, &counting, drop, NULL, NULL);
    for (uint32_t i = 0; i < body->leaf_count; i++)
        crossings[i] += atomic_load_explicit(&counting.crossings[i], memory_order_relaxed);
    free((void *)counting.crossings);
    device_delete(d);
}
