// clip_effort.cpp - how long Clipper will work, and a shorter way where there is one.
#include "geom/clip_effort.hpp"

#include "geom/clip_grid.hpp"

#include <utility>

extern "C" {
#include "base/hash.h"
}

namespace clip
{
static constexpr double VISITS_FEW = 1 << 25; // two seconds
static constexpr size_t TRIES_MORE = 1 << 16;
static constexpr double VISITS_MOST = 4.0 * (1 << 30); // some minutes

using side = std::pair<const IntPoint *, const IntPoint *>;

template <typename Visit> static void for_sides(const Paths &paths, Visit visit)
{
    for (const Path &path : paths)
        for (size_t i = 0; i < path.size(); i++)
            visit(path[i], path[i + 1 < path.size() ? i + 1 : 0]);
}

// Positive where p lies to the left of the line through a side.
static double left_of(side s, const IntPoint &p)
{
    IntPoint a = *s.second - *s.first, b = p - *s.first;
    return cross(a, b);
}

static bool cross_each_other(side s, side t)
{
    return left_of(s, *t.first) * left_of(s, *t.second) < 0 &&
           left_of(t, *s.first) * left_of(t, *s.second) < 0;
}

double crossing_count(const std::vector<const Paths *> &shapes, double least)
{
    double count = 0;
    for (const Paths *paths : shapes)
        count += point_count(*paths);
    double pairs = count * count / 2;
    if (pairs <= least)
        return 0;
    std::vector<side> sides;
    for (const Paths *paths : shapes)
        for_sides(*paths,
                  [&](const IntPoint &p, const IntPoint &q) { sides.emplace_back(&p, &q); });
    // Few hits are chance, so more pairs are tried then.
    size_t hits = 0, tries = 0, most = sides.size();
    uint64_t random = 0;
    for (; tries < most; tries++) {
        hits += cross_each_other(sides[random_next(&random) % sides.size()],
                                 sides[tries % sides.size()]);
        if (hits == 1)
            most = sides.size() + TRIES_MORE;
    }
    return pairs * static_cast<double>(hits) / static_cast<double>(tries);
}

void check_crossings(const Paths &a, const Paths &b, double most)
{
    if (crossing_count({&a, &b}, most) > most)
        refuse("too many crossings");
}

// How many sides a line visits that sweeps over all corners in the order of one coordinate.
static double visits(const Paths &a, const Paths &b, cInt IntPoint::*along)
{
    std::vector<cInt> levels;
    for (const Paths *paths : {&a, &b})
        for (const Path &path : *paths)
            for (const IntPoint &p : path)
                levels.push_back(p.*along);
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());

    double count = 0;
    auto add = [&](const IntPoint &p, const IntPoint &q) {
        auto low = std::lower_bound(levels.begin(), levels.end(), std::min(p.*along, q.*along));
        auto high = std::lower_bound(low, levels.end(), std::max(p.*along, q.*along));
        count += static_cast<double>(high - low);
    };
    for_sides(a, add);
    for_sides(b, add);
    return count;
}

bool better_sideways(const Paths &a, const Paths &b)
{
    double points = point_count(a) + point_count(b);
    if (points * points <= VISITS_FEW)
        return false;
    double upwards = visits(a, b, &IntPoint::Y);
    if (upwards <= VISITS_FEW)
        return false;
    double rightwards = visits(a, b, &IntPoint::X);
    if (std::min(upwards, rightwards) > VISITS_MOST)
        refuse("too many sides beside each other");
    return rightwards < upwards / 4;
}

void turn_sideways(Paths *paths)
{
    for (Path &path : *paths) {
        for (IntPoint &p : path)
            std::swap(p.X, p.Y);
        ReversePath(path);
    }
}
} // namespace clip
