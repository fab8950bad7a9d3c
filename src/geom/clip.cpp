// clip.cpp - 2D booleans, on the Clipper library with OpenSCAD's grid.
#include "geom/clip_grid.hpp"

using namespace clip;

namespace
{
// The first shape is the subject, all the others clip it at once.
Paths combined(ClipType type, Paths (*paths)(const struct outline *),
               const struct outline *const *shapes, uint32_t count)
{
    Paths others;
    for (uint32_t i = 1; i < count; i++) {
        Paths more = paths(shapes[i]);
        std::move(more.begin(), more.end(), std::back_inserter(others));
    }
    return cleaned(executed(type, paths(shapes[0]), std::move(others), pftNonZero));
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
