// plane_list.h - which of many planes can count in a square of pixels?
//
// The entry of a convex solid is the largest key of its front planes, the exit the smallest of its
// back planes. Keys are affine functions of the pixel, so a plane that is behind another one at the
// corners of a square is behind it in all of the square and need not be looked at there.
#pragma once
#include "render/cpu/tile.h"

#include <float.h>
#include <string.h>

// Keys beyond this are "never"; keeps products with pixel offsets finite.
#define KEY_LIMIT 1e30f
#define REACH     (0.5f * TILE) // pixels from the centre of the tile
#define INLINE    static inline __attribute__((always_inline))

INLINE v8f load(const float *p)
{
    v8f v;
    memcpy(&v, p, sizeof v);
    return v;
}

// A key that stays finite as a float, in products with pixel offsets too.
INLINE float limited(double key)
{
    key = key < KEY_LIMIT ? key : KEY_LIMIT;
    return (float)(key > -KEY_LIMIT ? key : -KEY_LIMIT);
}

INLINE void list_pad(struct plane_list *l)
{
    for (uint32_t i = l->n; i % 8; i++) {
        l->a[i] = -FLT_MAX;
        l->b[i] = l->c[i] = l->slack[i] = 0;
    }
}

// Where a list is compressed from: arrays with a sign, and lanes to be left out.
struct plane_source {
    const float *a, *b, *c, *slack;
    const float *side; // takes lanes in which side * sign < 0; NULL takes all
    uint32_t id, n;    // number of the first plane
    float sign;        // 1 front planes, -1 back planes
};

// The plane whose key at (x, y) is the largest; its number in the list or UINT32_MAX.
INLINE uint32_t largest_at(const struct plane_source *s, float x, float y)
{
    v8f best = v8_set(-FLT_MAX), sign = v8_set(s->sign);
    v8i lane = {0, 1, 2, 3, 4, 5, 6, 7}, found = v8_seti(-1);
    for (uint32_t i = 0; i < s->n; i += 8) {
        v8f v = sign * ((load(s->a + i) + load(s->b + i) * x) + load(s->c + i) * y);
        v8i better = (v > best) & (lane < v8_seti((int32_t)s->n));
        if (s->side)
            better &= load(s->side + i) * sign < v8_set(0);
        best = v8_select(better, v, best);
        found = v8_selecti(better, lane, found);
        lane += v8_seti(8);
    }
    uint32_t at = UINT32_MAX;
    float most = -FLT_MAX;
    for (int i = 0; i < 8; i++)
        if (found[i] >= 0 && best[i] > most) {
            most = best[i];
            at = (uint32_t)found[i];
        }
    return at;
}

// Plane q hides p when its key is larger in the whole square of half-width h around (x, y), with a
// margin for rounding.
struct hidden_by {
    v8f a, b, c, x, y, h, sign, centre, slack;
};

INLINE struct hidden_by hidden_by(const struct plane_source *s, uint32_t q, float x, float y,
                                  float h)
{
    float centre = (s->a[q] + s->b[q] * x) + s->c[q] * y;
    return (struct hidden_by){.a = v8_set(s->a[q]),
                              .b = v8_set(s->b[q]),
                              .c = v8_set(s->c[q]),
                              .x = v8_set(x),
                              .y = v8_set(y),
                              .h = v8_set(h),
                              .sign = v8_set(s->sign),
                              .centre = v8_set(centre),
                              .slack = v8_set(-s->slack[q])};
}

// Bit i: plane i of the eight that begin at `at` is on the source's side and not hidden.
INLINE int shown(const struct hidden_by *k, const struct plane_source *s, uint32_t at)
{
    v8f a = load(s->a + at), b = load(s->b + at), c = load(s->c + at);
    v8f ahead = k->sign * (((a + b * k->x) + c * k->y) - k->centre) +
                (v8_abs(b - k->b) + v8_abs(c - k->c)) * k->h + load(s->slack + at);
    v8i keep = ahead >= k->slack; // equal where all numbers are 0, as for q itself
    if (s->side)
        keep &= load(s->side + at) * k->sign < v8_set(0);
    int bits = v8_bits(keep);
    return s->n - at < 8 ? bits & ((1 << (s->n - at)) - 1) : bits;
}

// Bit i: plane i of the eight that begin at `at` is on the source's side.
INLINE int on_side(const struct plane_source *s, uint32_t at)
{
    int bits = s->side ? v8_bits(load(s->side + at) * s->sign < v8_set(0)) : 255;
    return s->n - at < 8 ? bits & ((1 << (s->n - at)) - 1) : bits;
}

static const v8i lanes = {0, 1, 2, 3, 4, 5, 6, 7};

// The numbers of the planes of the source that q does not hide, at `out` (which has room for eight
// more); returns how many.
INLINE uint32_t list_numbers(const struct tile *t, uint32_t *out, const struct plane_source *s,
                             uint32_t q, float x, float y, float h)
{
    struct hidden_by k = hidden_by(s, q, x, y, h);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < s->n; i += 8) {
        int bits = shown(&k, s, i);
        v8i number = t->front_lanes[bits] + v8_seti((int32_t)(s->id + i));
        memcpy(out + kept, &number, sizeof number);
        kept += (uint32_t)__builtin_popcount((unsigned)bits);
    }
    return kept;
}

INLINE void append(const struct tile *t, struct plane_list *out, const struct plane_source *s,
                   const uint32_t *ids, uint32_t at, int bits)
{
    v8i order = t->front_lanes[bits], number = lanes + v8_seti((int32_t)(s->id + at));
    v8f sign = v8_set(s->sign);
    if (ids)
        memcpy(&number, ids + at, sizeof number);
    v8f a = v8_permute(load(s->a + at) * sign, order),
        b = v8_permute(load(s->b + at) * sign, order);
    v8f c = v8_permute(load(s->c + at) * sign, order),
        slack = v8_permute(load(s->slack + at), order);
    v8f id = v8_permute((v8f)number, order);
    memcpy(out->a + out->n, &a, sizeof a);
    memcpy(out->b + out->n, &b, sizeof b);
    memcpy(out->c + out->n, &c, sizeof c);
    memcpy(out->slack + out->n, &slack, sizeof slack);
    memcpy(out->id + out->n, &id, sizeof id);
    out->n += (uint32_t)__builtin_popcount((unsigned)bits);
}

// Copies to `out` the planes of the source that q does not hide. `out` may be the source.
INLINE void list_take(const struct tile *t, struct plane_list *out, const struct plane_source *s,
                      const uint32_t *ids, uint32_t q, float x, float y, float h)
{
    struct hidden_by k = hidden_by(s, q, x, y, h);
    out->n = 0;
    for (uint32_t i = 0; i < s->n; i += 8)
        append(t, out, s, ids, i, shown(&k, s, i));
    list_pad(out);
}

// Copies to `out` all planes of the source's side.
INLINE void list_split(const struct tile *t, struct plane_list *out, const struct plane_source *s)
{
    out->n = 0;
    for (uint32_t i = 0; i < s->n; i += 8)
        append(t, out, s, NULL, i, on_side(s, i));
    list_pad(out);
}

// The planes of the source that may have the largest key somewhere in the square; not all of the
// others are dropped once `enough` or fewer are left.
INLINE void cull_planes(const struct tile *t, struct plane_list *out, const struct plane_source *s,
                        float x, float y, float h, uint32_t enough)
{
    const float cx[5] = {0, -1, 1, -1, 1}, cy[5] = {0, -1, -1, 1, 1};
    uint32_t q = largest_at(s, x, y);
    out->n = 0;
    if (q == UINT32_MAX)
        return;
    list_take(t, out, s, NULL, q, x, y, h);
    struct plane_source rest = {
        .a = out->a, .b = out->b, .c = out->c, .slack = out->slack, .sign = 1};
    for (int k = 1; k < 5 && out->n > enough; k++) {
        rest.n = out->n;
        q = largest_at(&rest, x + h * cx[k], y + h * cy[k]);
        list_take(t, out, &rest, out->id, q, x, y, h);
    }
}
