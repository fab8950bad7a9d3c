// bend.cpp - the flat parts of a bent face, from the hull of its corners.
//
// From one edge to all parts: the part at an edge is that of the corners that lie furthest outside
// around it. It leaves a smaller polygon behind each of its other sides.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <utility>
#include <vector>

extern "C" { // below the headers of the system, which do not bear it
#include "base/mem.h"
#include "geom/bend.h"
}

namespace
{
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

constexpr double CELLS = 0x1p20; // per mm
// Parts are found in the square of the number of corners; sides of larger faces are as short as
// lines are wide.
constexpr uint32_t CORNERS_MOST = 1000;

void push(uint32_t *&items, uint32_t &count, uint32_t &room, uint32_t item)
{
    size_t needed = static_cast<size_t>(count) + 1;
    items = static_cast<uint32_t *>(mem_array_grow(items, &room, needed, sizeof *items));
    items[count++] = item;
}

void add_corner(bends *b, uint32_t corner)
{
    push(b->corners, b->corner_count, b->corner_room, corner);
}

void close_part(bends *b)
{
    push(b->ends, b->count, b->end_room, b->corner_count);
}

// The corners between `low` and `high` that lie in the outermost plane through both.
std::vector<uint32_t> outermost(const std::vector<Point> &p, uint32_t low, uint32_t high,
                                CGAL::Orientation outside)
{
    std::vector<uint32_t> found{low + 1};
    for (uint32_t k = low + 2; k < high; k++) {
        CGAL::Orientation side = CGAL::orientation(p[low], p[found.front()], p[high], p[k]);
        if (side == outside)
            found.clear();
        if (side == outside || side == CGAL::COPLANAR)
            found.push_back(k);
    }
    return found;
}
} // namespace

extern "C" void bend_face(struct bends *b, const struct vec3 *corners, uint32_t count,
                          bool clockwise)
{
    std::vector<Point> points;
    auto on_grid = [](double x) { return std::trunc(x * CELLS); };
    for (uint32_t i = 0; i < count; i++)
        points.emplace_back(on_grid(corners[i].x), on_grid(corners[i].y), on_grid(corners[i].z));
    std::vector<std::pair<uint32_t, uint32_t>> rest;
    if (count > CORNERS_MOST) {
        for (uint32_t i = 0; i < count; i++)
            add_corner(b, i);
        close_part(b);
    } else if (count >= 3)
        rest.emplace_back(0, count - 1);
    while (!rest.empty()) {
        auto [low, high] = rest.back();
        rest.pop_back();
        add_corner(b, low);
        uint32_t before = low;
        std::vector<uint32_t> next =
            outermost(points, low, high, clockwise ? CGAL::NEGATIVE : CGAL::POSITIVE);
        next.push_back(high);
        for (uint32_t k : next) {
            add_corner(b, k);
            if (k > before + 1)
                rest.emplace_back(before, k);
            before = k;
        }
        close_part(b);
    }
}

extern "C" void bends_free(struct bends *b)
{
    free(b->corners);
    free(b->ends);
    *b = {};
}
