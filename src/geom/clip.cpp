// clip.cpp - 2D booleans, offsets and sums, on the Clipper library with OpenSCAD's grid.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <polyclipping/clipper.hpp>
#include <vector>

extern "C" { // below the headers of the system, which do not bear it
#include "base/angle.h"
#include "geom/clip.h"
}

using namespace ClipperLib;

namespace
{
constexpr double GRID = 65536;
constexpr double STROKE_GRID = 10000; // OpenSCAD's for the lines of SVG files
constexpr double MITRE_LIMIT = 1e6;
// Sums of so few pairs of sides are made of all pairs, as OpenSCAD makes them: then the order of
// their vertices is the same too. Quicker ways take over above.
constexpr double PAIRS_FEW = 4096;

// Thrown like Clipper's own refusals; `guarded` turns all of them into `false`.
[[noreturn]] void refuse(const char *why)
{
    throw clipperException(why);
}

cInt cut_off(double x, double grid)
{
    double scaled = x * grid;
    if (!(std::fabs(scaled) <= static_cast<double>(hiRange))) // also for NaN
        refuse("coordinate out of range");
    return static_cast<cInt>(scaled);
}

Path quantised(const struct vec2 *points, uint32_t count, double grid)
{
    Path path;
    path.reserve(count);
    for (uint32_t i = 0; i < count; i++)
        path.emplace_back(cut_off(points[i].x, grid), cut_off(points[i].y, grid));
    return path;
}

void store(const Paths &paths, double grid, struct outline *out)
{
    for (const Path &path : paths) {
        for (const IntPoint &p : path)
            outline_add(out, {static_cast<double>(p.X) / grid, static_cast<double>(p.Y) / grid});
        outline_close(out);
    }
    out->clean = true;
}

// The paths of a result in OpenSCAD's order, without what is thinner than the grid.
Paths cleaned(const PolyTree &tree)
{
    Paths paths;
    for (const PolyNode *node = tree.GetFirst(); node; node = node->GetNext()) {
        Path path;
        CleanPolygon(node->Contour, path);
        if (path.size() > 2)
            paths.push_back(std::move(path));
    }
    return paths;
}

// The paths on the grid as they are.
Paths paths_as_given(const struct outline *o)
{
    Paths paths;
    if (!o)
        return paths;
    if (o->point_count > CLIP_POINTS_MOST)
        refuse("too many points");
    for (uint32_t i = 0, begin = 0; i < o->path_count; begin = o->ends[i++])
        paths.push_back(quantised(o->points + begin, o->ends[i] - begin, GRID));
    return paths;
}

// Paths of a shape that is not clean are made to run the same way round, which changes the result's
// vertices in corner cases, and become the shape of what lies in an odd number of them.
Paths paths_of(const struct outline *o)
{
    Paths paths = paths_as_given(o);
    if (!o || o->clean)
        return paths;

    for (Path &path : paths)
        if (!Orientation(path))
            ReversePath(path);
    Clipper clipper;
    PolyTree tree;
    clipper.AddPaths(paths, ptSubject, true);
    clipper.Execute(ctUnion, tree, pftEvenOdd);
    return cleaned(tree);
}

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

// All shapes at once: the first is the subject, the others clip it.
Paths combined(ClipType type, Paths (*paths)(const struct outline *),
               const struct outline *const *shapes, uint32_t count)
{
    Clipper clipper;
    PolyTree tree;
    for (uint32_t i = 0; i < count; i++)
        clipper.AddPaths(paths(shapes[i]), i == 0 ? ptSubject : ptClip, true);
    clipper.Execute(type, tree, pftNonZero, pftNonZero);
    return cleaned(tree);
}

Paths common(const struct outline *const *shapes, uint32_t count)
{
    Paths subject = paths_of(shapes[0]);
    PolyTree tree;
    for (uint32_t i = 1; i < count; i++) {
        Clipper clipper;
        clipper.AddPaths(subject, ptSubject, true);
        clipper.AddPaths(paths_of(shapes[i]), ptClip, true);
        clipper.Execute(ctIntersection, tree, pftNonZero, pftNonZero);
        PolyTreeToPaths(tree, subject);
    }
    return cleaned(tree);
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
    return guarded(out, GRID, [=] { return combined(ctUnion, paths_as_given, shapes, count); });
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
        Clipper clipper;
        PolyTree tree;
        for (const Path &path : paths_of(in))
            if (Orientation(path))
                clipper.AddPath(path, ptSubject, true);
        clipper.Execute(ctUnion, tree, pftNonZero, pftNonZero);
        return cleaned(tree);
    });
}

namespace
{
JoinType join_type(enum clip_join join)
{
    return join == CLIP_ROUND ? jtRound : join == CLIP_MITRE ? jtMiter : jtSquare;
}

EndType end_type(enum clip_cap cap)
{
    return cap == CLIP_CAP_ROUND ? etOpenRound : cap == CLIP_CAP_BUTT ? etOpenButt : etOpenSquare;
}

// The corners are moved before Clipper looks at the range of their coordinates.
void check_reach(const Paths &paths, double reach)
{
    for (const Path &path : paths)
        for (const IntPoint &p : path) {
            double largest =
                std::fmax(std::fabs(static_cast<double>(p.X)), std::fabs(static_cast<double>(p.Y)));
            if (!(largest + reach < static_cast<double>(hiRange)))
                refuse("coordinate out of range");
        }
}

// Each corner becomes an arc: how many points will there be?
void check_arcs(const Paths &paths, double pieces)
{
    double points = 0;
    for (const Path &path : paths)
        for (size_t i = 0, n = path.size(); i < n; i++) {
            const IntPoint &a = path[i], &b = path[(i + 1) % n], &c = path[(i + 2) % n];
            double in = std::atan2(b.Y - a.Y, b.X - a.X), out = std::atan2(c.Y - b.Y, c.X - b.X);
            points += 2 + pieces * std::fabs(std::remainder(out - in, 2 * M_PI)) / (2 * M_PI);
        }
    if (points > CLIP_POINTS_MOST)
        refuse("too many points");
}

Paths offset(const Paths &paths, double distance, enum clip_join join, struct detail detail)
{
    uint32_t most = CIRCLE_FRAGMENTS_MAX;
    double n = std::min(circle_fragments(std::fabs(distance), detail), most);
    double delta = distance * GRID;
    check_reach(paths, std::fabs(delta) * (join == CLIP_MITRE ? MITRE_LIMIT : 2));
    if (join == CLIP_ROUND)
        check_arcs(paths, n);
    ClipperOffset offset(MITRE_LIMIT, std::fabs(distance) * (1 - cos_degrees(180 / n)) * GRID);
    PolyTree tree;
    offset.AddPaths(paths, join_type(join), etClosedPolygon);
    offset.Execute(tree, delta);
    return cleaned(tree);
}
} // namespace

bool clip_offset(struct outline *out, const struct outline *in, double distance,
                 enum clip_join join, struct detail detail)
{
    return guarded(out, GRID, [=] { return offset(paths_of(in), distance, join, detail); });
}

bool clip_stroke(struct outline *out, const struct vec2 *line, uint32_t count, double width,
                 enum clip_cap cap, enum clip_join join)
{
    return guarded(out, STROKE_GRID, [=] {
        if (count > CLIP_POINTS_MOST)
            refuse("too many points");
        Paths lines = {quantised(line, count, STROKE_GRID)}, stroke;
        double delta = width * (STROKE_GRID / 2);
        check_reach(lines, 2 * std::fabs(delta));
        ClipperOffset offset; // with its own limit of mitres, 2, and fineness of arcs
        offset.AddPaths(lines, join_type(join), end_type(cap));
        offset.Execute(stroke, delta);
        return stroke;
    });
}

namespace
{
IntPoint operator+(const IntPoint &a, const IntPoint &b)
{
    return {a.X + b.X, a.Y + b.Y};
}

IntPoint operator-(const IntPoint &a, const IntPoint &b)
{
    return {a.X - b.X, a.Y - b.Y};
}

double cross(const IntPoint &a, const IntPoint &b)
{
    return static_cast<double>(a.X) * static_cast<double>(b.Y) -
           static_cast<double>(a.Y) * static_cast<double>(b.X);
}

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

double point_count(const Paths &paths)
{
    double count = 0;
    for (const Path &path : paths)
        count += static_cast<double>(path.size());
    return count;
}

Paths sum_terms(const Paths &a, const Paths &b)
{
    Paths terms;
    double pairs = point_count(a) * point_count(b);
    if (pairs > PAIRS_FEW) {
        bool a_convex = is_convex(a), b_convex = is_convex(b);
        if (a_convex && b_convex)
            return {convex_sum(from_lowest(a[0]), from_lowest(b[0]))};
        if (pairs * (a_convex || b_convex ? 1 : 4) > CLIP_POINTS_MOST)
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

Paths sum(const Paths &a, const Paths &b)
{
    Clipper clipper;
    PolyTree tree;
    clipper.AddPaths(sum_terms(a, b), ptSubject, true);
    clipper.Execute(ctUnion, tree, pftNonZero, pftNonZero);
    return cleaned(tree);
}
} // namespace

bool clip_minkowski(struct outline *out, const struct outline *a, const struct outline *b)
{
    return guarded(out, GRID, [=] { return sum(paths_of(a), paths_of(b)); });
}
