// device.c - the functions of a device, whichever kind it is.
#include "render/device.h"

void device_delete(struct device *d)
{
    if (d)
        d->kind->delete (d);
}

void device_first_surface(struct device *d, const struct body *body, const struct rays *rays,
                          const struct render_settings *settings, struct surface_image *out,
                          void (*drawn)(void *context, struct pixel_rect rect, bool nothing),
                          void *context, struct render_stats *stats)
{
    out->width = rays->width;
    out->height = rays->height;
    d->kind->first_surface(d, body, rays, settings, out, drawn, context, stats);
}

void device_spans(struct device *d, const struct body *body, const struct rays *rays,
                  const struct render_settings *settings,
                  void (*sink)(void *context, uint32_t worker, const struct span_block *block),
                  void *context, struct render_stats *stats)
{
    d->kind->spans(d, body, rays, settings, sink, context, stats);
}
