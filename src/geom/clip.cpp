// clip.cpp - 2D booleans, on the Clipper library with OpenSCAD's grid.
#include "geom/clip_effort.hpp"
#include "geom/clip_grid.hpp"

extern "C" {
#include "base/hash.h"
}

using namespace clip;

namespace
{
// Up to here all shapes are worked off at once, with OpenSCAD's roundings.
constexpr double CROSSINGS_FEW = 1 << 14, OVERLAPS_FEW = 1 << 13;
constexpr double POINTS_FEW = 512;

struct shape {
    Paths paths;
    IntPoint low, high;
};
using shapes_at = std::vector<shape>::iterator;

shape shape_of(Paths paths)
{
    shape s = {std::move(paths), {hiRange, hiRange}, {-hiRange, -hiRange}};
    for (const Path &path : s.paths)
        for (const IntPoint &p : path) {
            s.low = {std::min(s.low.X, p.X), std::min(s.low.Y, p.Y)};
            s.high = {std::max(s.high.X, p.X), std::max(s.high.Y, p.Y)};
        }
    return s;
}

// How many of all pairs of boxes overlap, by a sample.
double overlap_count(const std::vector<shape> &shapes)
{
    double count = static_cast<double>(shapes.size());
    if (count * count / 2 <= OVERLAPS_FEW)
        return 0;
    uint64_t random = 0;
    double hits = 0;
    for (const shape &s : shapes) {
        const shape &t = shapes[random_next(&random) % shapes.size()];
        hits += &s != &t && s.low.X < t.high.X && t.low.X < s.high.X && s.low.Y < t.high.Y &&
                t.low.Y < s.high.Y;
    }
    return hits * count / 2;
}

bool is_heap(const std::vector<shape> &shapes)
{
    if (shapes.size() < 3)
        return false;
    std::vector<const Paths *> paths;
    for (const shape &s : shapes)
        paths.push_back(&s.paths);
    return overlap_count(shapes) > OVERLAPS_FEW ||
           crossing_count(paths, CROSSINGS_FEW) > CROSSINGS_FEW;
}

Paths together(shapes_at begin, shapes_at end)
{
    Paths all;
    for (shapes_at s = begin; s != end; ++s)
        std::move(s->paths.begin(), s->paths.end(), std::back_inserter(all));
    return all;
}

// Near ones first: what many shapes cover is gone early, with all crossings inside of it. The depth
// is the logarithm of the number of shapes.
Paths united(shapes_at begin, shapes_at end)
{
    double points = 0;
    IntPoint low = begin->low, high = low;
    for (shapes_at s = begin; s != end; ++s) {
        points += point_count(s->paths);
        low = {std::min(low.X, s->low.X), std::min(low.Y, s->low.Y)};
        high = {std::max(high.X, s->low.X), std::max(high.Y, s->low.Y)};
    }
    if (points <= POINTS_FEW || end - begin == 1)
        return executed(ctUnion, together(begin, end), {}, pftNonZero);
    cInt IntPoint::*along = high.X - low.X > high.Y - low.Y ? &IntPoint::X : &IntPoint::Y;
    shapes_at middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [along](const shape &a, const shape &b) {
        return a.low.*along < b.low.*along;
    });
    return executed(ctUnion, united(begin, middle), united(middle, end), pftNonZero);
}

// The first shape is the subject, all the others clip it at once.
Paths combined(ClipType type, Paths (*paths)(const struct outline *),
               const struct outline *const *shapes, uint32_t count)
{
    std::vector<shape> all;
    for (uint32_t i = 0; i < count; i++)
        all.push_back(shape_of(paths(shapes[i])));
    bool heap = is_heap(all);
    if (heap && type == ctUnion)
        return cleaned(united(all.begin(), all.end()));
    Paths others = heap ? united(all.begin() + 1, all.end()) : together(all.begin() + 1, all.end());
    return cleaned(executed(type, std::move(all[0].paths), std::move(others), pftNonZero));
}

Paths common(const struct outline *const *shapes, uint32_t count)
{
    Paths all = paths_of(shapes[0]);
    for (uint32_t i = 1; i < count; i++)
        all = executed(ctIntersection, std::move(all), paths_of(shapes[i]), pftNonZero);
    return cleaned(all);
}

bool combine(ClipType type, struct outline *out, const struct outline *const *shapes,
             uint32_t count)
{
    if (count == 1 && shapes[0] && shapes[0]->clean) {
        outline_copy(out, shapes[0]);
        return true;
    }
    return guarded(out, GRID, [=]() -> Paths {
        if (count < 2)
            return count ? paths_of(shapes[0]) : Paths();
        return type == ctIntersection ? common(shapes, count)
                                      : combined(type, paths_of, shapes, count);
    });
}
} // namespace

bool clip_clean(struct outline *out, const struct outline *in)
{
    struct outline arbitrary = *in; // borrows the points
    arbitrary.clean = false;
    return guarded(out, GRID, [&] { return paths_of(&arbitrary); });
}

bool clip_union(struct outline *out, const struct outline *const *shapes, uint32_t count)
{
    return combine(ctUnion, out, shapes, count);
}

bool clip_nonzero(struct outline *out, const struct outline *const *shapes, uint32_t count)
{
    return guarded(out, GRID, [=] {
        return count ? combined(ctUnion, paths_as_given, shapes, count) : Paths();
    });
}

bool clip_difference(struct outline *out, const struct outline *const *shapes, uint32_t count)
{
    return combine(ctDifference, out, shapes, count);
}

bool clip_intersection(struct outline *out, const struct outline *const *shapes, uint32_t count)
{
    return combine(ctIntersection, out, shapes, count);
}

bool clip_fill(struct outline *out, const struct outline *in)
{
    return guarded(out, GRID, [=] {
        Paths outer;
        for (Path &path : paths_of(in))
            if (Orientation(path))
                outer.push_back(std::move(path));
        return cleaned(executed(ctUnion, std::move(outer), {}, pftNonZero));
    });
}
