// clip_grid.cpp - flat shapes as Clipper's paths on an integer grid, and back.
#include "geom/clip_grid.hpp"

#include "geom/clip_effort.hpp"

namespace clip
{
void refuse(const char *why)
{
    throw clipperException(why);
}

static cInt cut_off(double x, double grid)
{
    double scaled = x * grid;
    if (!(std::fabs(scaled) <= static_cast<double>(hiRange))) // also for NaN
        refuse("coordinate out of range");
    return static_cast<cInt>(scaled);
}

Path quantised(const struct vec2 *points, uint32_t count, double grid)
{
    if (count > CLIP_POINTS_MOST)
        refuse("too many points");
    Path path;
    path.reserve(count);
    for (uint32_t i = 0; i < count; i++)
        path.emplace_back(cut_off(points[i].x, grid), cut_off(points[i].y, grid));
    return path;
}

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

Paths paths_of(const struct outline *o)
{
    Paths paths = paths_as_given(o);
    if (!o || o->clean)
        return paths;
    // The result does not depend on the directions but for corner cases: so OpenSCAD does it.
    for (Path &path : paths)
        if (!Orientation(path))
            ReversePath(path);
    return cleaned(executed(ctUnion, std::move(paths), {}, pftEvenOdd));
}

Paths executed(ClipType type, Paths subject, Paths others, PolyFillType fill)
{
    check_crossings(subject, others, fill == pftEvenOdd ? CROSSINGS_MOST_ODD : CROSSINGS_MOST);
    bool sideways = better_sideways(subject, others);
    if (sideways) {
        turn_sideways(&subject);
        turn_sideways(&others);
    }
    Clipper clipper;
    PolyTree tree;
    clipper.AddPaths(subject, ptSubject, true);
    clipper.AddPaths(others, ptClip, true);
    clipper.Execute(type, tree, fill, fill);
    Paths result = paths_of_tree(tree);
    if (sideways)
        turn_sideways(&result);
    return result;
}

Paths paths_of_tree(const PolyTree &tree)
{
    Paths paths;
    for (const PolyNode *node = tree.GetFirst(); node; node = node->GetNext())
        paths.push_back(node->Contour);
    return paths;
}

Paths cleaned(const Paths &paths)
{
    Paths result;
    for (const Path &path : paths) {
        Path kept;
        CleanPolygon(path, kept);
        if (kept.size() > 2)
            result.push_back(std::move(kept));
    }
    return result;
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
} // namespace clip
