// triangulate.cpp - flat shapes cut into triangles.
#include "geom/triangulate_cutter.hpp"

#include <cstring>

namespace
{
using triangulation::Plain;
using triangulation::Tracking;
using triangulation::Triangles;

constexpr uint32_t PIECE_POINTS = 2000;

// Right for one convex path. For others the triangles overlap, but close what they have to close.
void fan(const outline &o, Triangles &out)
{
    for (uint32_t path = 0, begin = 0; path < o.path_count; begin = o.ends[path++])
        for (uint32_t i = begin + 2; i < o.ends[path]; i++)
            out.push_back({begin, i - 1, i});
}

bool is_finite(const outline &o)
{
    return std::all_of(o.points, o.points + o.point_count,
                       [](vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

template <class T> bool try_to_cut(const outline &o, Triangles &out)
{
    try {
        out.clear();
        triangulation::cutter<T>(o, out).cut();
        return true;
    } catch (const std::exception &) {
        return false;
    }
}

void cut_any(const outline &o, Triangles &out)
{
    if (outline_is_convex(&o) || !is_finite(o)) {
        fan(o, out);
        return;
    }
    if (try_to_cut<Plain>(o, out) || try_to_cut<Tracking>(o, out))
        return;
    out.clear();
    fan(o, out);
}

// The paths that reach from `low` to `high` along an axis.
struct stretch {
    double low, high;
    uint32_t path;
};

std::vector<stretch> stretches(const outline &o)
{
    box bounds = outline_bounds(&o);
    double vec2::*along =
        bounds.max.x - bounds.min.x >= bounds.max.y - bounds.min.y ? &vec2::x : &vec2::y;
    std::vector<stretch> all;
    for (uint32_t path = 0, i = 0; path < o.path_count; path++) {
        stretch s = {INFINITY, -INFINITY, path};
        for (; i < o.ends[path]; i++) {
            s.low = std::fmin(s.low, o.points[i].*along);
            s.high = std::fmax(s.high, o.points[i].*along);
        }
        all.push_back(s);
    }
    std::sort(all.begin(), all.end(), [](const stretch &a, const stretch &b) {
        return a.low < b.low || (a.low == b.low && a.path < b.path);
    });
    return all;
}

// Paths one after the other along an axis, as those of a long text, are cut piece by piece: in a
// strip, neighbours in the order of spatial_sort may lie far apart.
void cut_pieces(const outline &o, Triangles &out)
{
    double reach = -INFINITY;
    outline piece = {};
    std::vector<uint32_t> numbers; // of the points of the piece
    auto flush = [&] {
        Triangles found;
        cut_any(piece, found);
        for (const auto &t : found)
            out.push_back({numbers[t[0]], numbers[t[1]], numbers[t[2]]});
        outline_free(&piece);
        numbers.clear();
    };
    for (const stretch &s : stretches(o)) {
        if (s.low > reach && numbers.size() >= PIECE_POINTS)
            flush();
        for (uint32_t i = s.path ? o.ends[s.path - 1] : 0; i < o.ends[s.path]; i++) {
            outline_add(&piece, o.points[i]);
            numbers.push_back(i);
        }
        outline_close(&piece);
        reach = std::fmax(reach, s.high);
    }
    flush();
}

void give(const Triangles &found, uint32_t (**triangles)[3], uint32_t *count)
{
    size_t size = found.size() * sizeof found[0];
    *triangles = static_cast<uint32_t(*)[3]>(mem_alloc(size));
    if (size)
        memcpy(*triangles, found.data(), size);
    *count = static_cast<uint32_t>(found.size());
}
} // namespace

extern "C" void outline_triangulate(const struct outline *o, uint32_t (**triangles)[3],
                                    uint32_t *count)
{
    Triangles found;
    if (o->point_count > 2 * PIECE_POINTS && is_finite(*o))
        cut_pieces(*o, found);
    else if (o->path_count > 0)
        cut_any(*o, found);
    give(found, triangles, count);
}

extern "C" bool outline_try_triangulate(const struct outline *o, uint32_t (**triangles)[3],
                                        uint32_t *count)
{
    Triangles found;
    if (!is_finite(*o) || !try_to_cut<Plain>(*o, found))
        return false;
    give(found, triangles, count);
    return true;
}
