// clip_grid.hpp - flat shapes as Clipper's paths on an integer grid, and back.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <polyclipping/clipper.hpp>
#include <vector>

extern "C" { // below the headers of the system, which do not bear it
#include "geom/clip.h"
}

namespace clip
{
using namespace ClipperLib;

constexpr double GRID = 65536;

// Thrown like Clipper's own refusals; `guarded` turns all of them into `false`.
[[noreturn]] void refuse(const char *why);

Path quantised(const struct vec2 *points, uint32_t count, double grid);
// The paths on the grid as they are; none of NULL.
Paths paths_as_given(const struct outline *o);
// The same of a clean shape; others are cleaned.
Paths paths_of(const struct outline *o);

// Clipper's operation, with the paths of the result in OpenSCAD's order.
Paths executed(ClipType type, Paths subject, Paths others, PolyFillType fill);
Paths paths_of_tree(const PolyTree &tree);
// Without what is thinner than the grid.
Paths cleaned(const Paths &paths);

inline IntPoint operator+(const IntPoint &a, const IntPoint &b)
{
    return {a.X + b.X, a.Y + b.Y};
}

inline IntPoint operator-(const IntPoint &a, const IntPoint &b)
{
    return {a.X - b.X, a.Y - b.Y};
}

inline double cross(const IntPoint &a, const IntPoint &b)
{
    return static_cast<double>(a.X) * static_cast<double>(b.Y) -
           static_cast<double>(a.Y) * static_cast<double>(b.X);
}

inline double point_count(const Paths &paths)
{
    double count = 0;
    for (const Path &path : paths)
        count += static_cast<double>(path.size());
    return count;
}

// Adds paths to an outline, which is then called clean.
void store(const Paths &paths, double grid, struct outline *out);

// Fills *out by work(), which returns paths on the grid and may throw: then *out is empty.
template <typename Work> bool guarded(struct outline *out, double grid, Work work) noexcept
{
    *out = {};
    out->clean = true;
    try {
        store(work(), grid, out);
        return true;
    } catch (const clipperException &) {
        return false;
    }
}
} // namespace clip
