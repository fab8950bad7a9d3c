// clip_offset.cpp - grown and shrunk shapes, and lines with a width.
#include "geom/clip_effort.hpp"
#include "geom/clip_grid.hpp"

extern "C" {
#include "base/angle.h"
}

using namespace clip;

namespace
{
constexpr double STROKE_GRID = 10000; // OpenSCAD's for the lines of SVG files
constexpr double POINTS_MOST = CLIP_POINTS_MOST;
constexpr double MITRE_LIMIT = 1e6;
constexpr double STROKE_MITRE_LIMIT = 2, ARC_TOLERANCE = 0.25; // Clipper's own choice

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

// How many points arcs at all corners have, when a full circle has so many pieces.
double arc_points(const Paths &paths, double pieces)
{
    double points = 0;
    for (const Path &path : paths)
        for (size_t i = 0, n = path.size(); i < n; i++) {
            const IntPoint &a = path[i], &b = path[(i + 1) % n], &c = path[(i + 2) % n];
            double in = std::atan2(b.Y - a.Y, b.X - a.X), out = std::atan2(c.Y - b.Y, c.X - b.X);
            points += 2 + pieces * std::fabs(std::remainder(out - in, 2 * M_PI)) / (2 * M_PI);
        }
    return points;
}

// What Clipper makes one shape of in the end, but for the outer corners: sides move, and at inner
// corners the path goes back to the corner in between.
Paths moved_sides(const Paths &paths, double delta)
{
    Paths result;
    for (const Path &path : paths) {
        Path sides;
        for (size_t i = 0, n = path.size(); i < n; i++) {
            const IntPoint &p = path[i], &q = path[(i + 1) % n];
            IntPoint along = q - p;
            double x = static_cast<double>(along.X), y = static_cast<double>(along.Y);
            double scale = delta / std::fmax(std::hypot(x, y), 1);
            IntPoint by(static_cast<cInt>(y * scale), static_cast<cInt>(-x * scale));
            sides.push_back(p + by);
            sides.push_back(q + by);
            if (cross(along, path[(i + 2) % n] - q) * delta < 0)
                sides.push_back(q);
        }
        result.push_back(std::move(sides));
    }
    return result;
}

Paths offset(Paths paths, double distance, enum clip_join join, struct detail detail)
{
    uint32_t most = CIRCLE_FRAGMENTS_MAX;
    double n = std::min(circle_fragments(std::fabs(distance), detail), most);
    double delta = distance * GRID;
    check_reach(paths, std::fabs(delta) * (join == CLIP_MITRE ? MITRE_LIMIT : 2));
    if (join == CLIP_ROUND && arc_points(paths, n) > POINTS_MOST)
        refuse("too many points");
    Paths moved = moved_sides(paths, delta);
    check_crossings(moved, {}, CROSSINGS_MOST);
    bool sideways = better_sideways(moved, {});
    if (sideways)
        turn_sideways(&paths);

    ClipperOffset offset(MITRE_LIMIT, std::fabs(distance) * (1 - cos_degrees(180 / n)) * GRID);
    PolyTree tree;
    offset.AddPaths(paths, join_type(join), etClosedPolygon);
    offset.Execute(tree, delta);
    Paths result = paths_of_tree(tree);
    if (sideways)
        turn_sideways(&result);
    return cleaned(result);
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
        Paths lines = {quantised(line, count, STROKE_GRID)}, stroke;
        double delta = width * (STROKE_GRID / 2);
        check_reach(lines, 2 * std::fabs(delta));
        double pieces = M_PI / std::acos(1 - ARC_TOLERANCE / std::fmax(std::fabs(delta), 1));
        if (!(pieces + arc_points(lines, pieces) <= POINTS_MOST)) // a single point is a circle
            refuse("too many points");
        check_crossings(lines, {}, CROSSINGS_MOST);
        ClipperOffset offset(STROKE_MITRE_LIMIT, ARC_TOLERANCE);
        offset.AddPaths(lines, join_type(join), end_type(cap));
        offset.Execute(stroke, delta);
        return stroke;
    });
}
