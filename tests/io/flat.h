// flat.h - what the tests of DXF and SVG share: shapes as sets of points.
#pragma once
#include "copy.h"
#include "geom/outline.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static inline bool has_point(const struct outline *o, struct vec2 p)
{
    for (uint32_t i = 0; i < o->point_count; i++)
        if (fabs(o->points[i].x - p.x) <= 2e-5 && fabs(o->points[i].y - p.y) <= 2e-5)
            return true;
    return false;
}

// These points and no others, however they are ordered.
static inline void expect_points(const struct outline *o, const double (*points)[2], size_t count)
{
    assert_true(o->clean);
    assert_int_equal(o->point_count, count);
    for (size_t i = 0; i < count; i++)
        if (!has_point(o, (struct vec2){points[i][0], points[i][1]}))
            fail_msg("no point at %g %g", points[i][0], points[i][1]);
}

#define EXPECT(o, ...)                                                                             \
    do {                                                                                           \
        static const double points[][2] = {__VA_ARGS__};                                           \
        expect_points(&(o), points, array_count(points));                                          \
        outline_free(&(o));                                                                        \
    } while (0)
