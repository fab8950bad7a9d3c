// clip_sum.cpp - Minkowski sums of flat shapes.
#include "geom/clip_grid.hpp"

using namespace clip;

namespace
{
// Sums of so few pairs of sides are made of all pairs, as OpenSCAD makes them: then the order of
// their vertices is the same too. Quicker ways take over above.
constexpr double PAIRS_FEW = 4096;

Path moved(const Path &path, const IntPoint &by)
{
    Path result;
    result.reserve(path.size());
    for (const IntPoint &p : path)
        result.push_back(p + by);
    return result;
}

// What the boundary of one path covers when it goes along the other one, side by side.
void add_sweep(Paths *terms, const Path &a, const Path &b)
{
    for (size_t i = 0; i < b.size(); i++) {
        Path here = moved(a, b[i]), there = moved(a, b[(i + 1) % b.size()]);
        for (size_t j = 0, k = 1; j < a.size(); j++, k = (j + 1) % a.size()) {
            Path quad = {here[j], there[j], there[k], here[k]};
            if (!Orientation(quad))
                ReversePath(quad);
            terms->push_back(std::move(quad));
        }
    }
}

// `a` at one point of each part of `b`: with it the sweeps have no gaps.
void add_insides(Paths *terms, const Paths &a, const Paths &b)
{
    for (const Path &part : b)
        if (Orientation(part))
            for (const Path &path : a)
                terms->push_back(moved(path, part[0]));
}

bool is_convex(const Paths &paths)
{
    struct outline o = {};
    store(paths, 1, &o);
    bool convex = outline_is_convex(&o);
    outline_free(&o);
    return convex;
}

Path from_lowest(Path path)
{
    path.erase(std::unique(path.begin(), path.end()), path.end());
    auto lowest = std::min_element(path.begin(), path.end(), [](auto &a, auto &b) {
        return a.Y < b.Y || (a.Y == b.Y && a.X < b.X);
    });
    std::rotate(path.begin(), lowest, path.end());
    return path;
}

// The sum of two convex paths that begin at their lowest points: the sides of both by direction.
// A path of two points is a segment, there and back.
Path convex_sum(const Path &a, const Path &b)
{
    Path sum;
    for (size_t i = 0, j = 0; i < a.size() || j < b.size();) {
        IntPoint from_a = a[i % a.size()], from_b = b[j % b.size()];
        double turn = cross(a[(i + 1) % a.size()] - from_a, b[(j + 1) % b.size()] - from_b);
        sum.push_back(from_a + from_b);
        bool a_next = j == b.size() || (i < a.size() && turn >= 0);
        bool b_next = i == a.size() || (j < b.size() && turn <= 0);
        i += a_next;
        j += b_next;
    }
    return sum;
}

// With a convex shape each side of the other one covers a convex region, so that there are as many
// terms as sides. Their outer sides are those of the sweeps, hence the result's as well.
void add_convex_sweep(Paths *terms, const Paths &a, const Path &convex)
{
    for (const Path &path : a)
        for (size_t i = 0; i < path.size(); i++) {
            const IntPoint &p = path[i], &q = path[(i + 1) % path.size()];
            terms->push_back(convex_sum(from_lowest({p, q}), convex));
        }
    add_insides(terms, a, {convex});
}

Paths sum_terms(const Paths &a, const Paths &b)
{
    Paths terms;
    double pairs = point_count(a) * point_count(b);
    if (pairs > PAIRS_FEW) {
        bool a_convex = is_convex(a), b_convex = is_convex(b);
        if (a_convex && b_convex)
            return {convex_sum(from_lowest(a[0]), from_lowest(b[0]))};
        if (pairs * (a_convex || b_convex ? 1 : 4) > static_cast<double>(CLIP_POINTS_MOST))
            refuse("too many points");
        if (a_convex || b_convex) {
            add_convex_sweep(&terms, a_convex ? b : a, from_lowest(a_convex ? a[0] : b[0]));
            return terms;
        }
    }
    for (const Path &along : b)
        for (const Path &path : a)
            add_sweep(&terms, path, along);
    add_insides(&terms, a, b);
    add_insides(&terms, b, a);
    return terms;
}
} // namespace

bool clip_minkowski(struct outline *out, const struct outline *a, const struct outline *b)
{
    return guarded(out, GRID, [=] {
        return cleaned(executed(ctUnion, sum_terms(paths_of(a), paths_of(b)), {}, pftNonZero));
    });
}
