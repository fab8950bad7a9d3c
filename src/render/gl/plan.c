// plan.c - how the budget of a picture is divided among its buffers.
#include "render/gl/plan.h"

#include "shaders/shared.h"

enum {
    PIXEL_COMMON = 4 * 5 + sizeof(struct pixel_state), // counts, offsets, pending twice, spans
    PIXEL_SURFACE = PIXEL_COMMON + 12,
    PIXEL_SPANS = PIXEL_COMMON + sizeof(struct span_data),
    FRAGMENT_SPANS = sizeof(struct fragment) + sizeof(struct span_data) / 2,
    FRAME_BYTES = 4096, // the frame, counters, a histogram
    MISSES_MOST = 4 << 20,
    STAGING_MOST = 16 << 20,
    CLAIMS_MOST = 1 << 16,
};

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

// Sums of blocks, over all levels.
static size_t scan_bytes(size_t n)
{
    return 4 * (n / SCAN_BLOCK + n / SCAN_BLOCK / SCAN_BLOCK + 3);
}

bool gl_plan_make(struct gl_plan *out, size_t budget, size_t storage, int width, int height,
                  uint32_t leaves, bool spans, bool linked, struct error *err)
{
    struct gl_plan p = {.claims = CLAIMS_MOST};
    size_t misses = least(budget / 16, MISSES_MOST) / 4 * 4;
    size_t pieces = least(budget / 8, storage) / 16 * 16;
    p.staging = least(budget / 16, STAGING_MOST) / 4 * 4;
    while (p.claims > 1 && p.claims * 4 > budget / 64)
        p.claims /= 2;

    size_t each = spans ? PIXEL_SPANS : PIXEL_SURFACE;
    size_t pixels = least(budget / 4 / each, storage / (2 * sizeof(struct pixel_state)));
    p.columns = (int)least(pixels, (size_t)width);
    p.rows = p.columns ? (int)least(pixels / (size_t)p.columns, (size_t)height) : 0;
    p.rows = p.columns < width ? 1 : p.rows;
    pixels = (size_t)p.columns * (size_t)p.rows;

    p.numbers = (pixels < leaves ? leaves : pixels) + 1;
    size_t others = misses + pieces + p.staging + p.claims * 4 + pixels * each +
                    scan_bytes(p.numbers) + FRAME_BYTES;
    if (budget < GL_MEMORY_LEAST || others >= budget - budget / 4) {
        error_set(err, "%zu bytes of memory are too few for the gl device", budget);
        return false;
    }
    size_t rest = budget - others, places = storage / sizeof(struct span_data);
    size_t one = (spans ? FRAGMENT_SPANS : sizeof(struct fragment)) + (linked ? 4 : 0);
    size_t fragments = least(rest / one, storage / sizeof(struct fragment));
    if (spans)
        fragments = least(fragments, 2 * (places - pixels));
    p.fragments =
        (uint32_t)least(fragments, UINT32_MAX - 1); // the largest number is a sum too large
    p.pieces = (uint32_t)least(pieces / 16, (size_t)GROUPS_WIDE * UINT16_MAX);
    p.miss_words = (uint32_t)(misses / 4);
    *out = p;
    return true;
}
