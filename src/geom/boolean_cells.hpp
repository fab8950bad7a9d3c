// boolean_cells.hpp - the winding numbers of the cells that an arrangement cuts space into.
//
// Q. Zhou, E. Grinspun, D. Zorin, A. Jacobson: Mesh Arrangements for Solid Geometry, 2016.
#pragma once
#include "geom/boolean_exact.hpp"

#include <CGAL/Bbox_3.h>
#include <algorithm>
#include <tuple>

namespace arrangement
{
// Triangles that meet in whole edges and corners only. Side 2 i is in front of triangle i, side
// 2 i + 1 behind it; sides of one cell are one set.
class cells
{
  public:
    cells(const point_table &table, const std::vector<triangle> &all)
        : points(table), triangles(all), sides(2 * all.size()), parts(all.size())
    {
        for (uint32_t t = 0; t < triangles.size(); t++)
            for (unsigned i = 0; i < 3; i++) {
                const auto &c = triangles[t].corner;
                uint32_t from = c[i], to = c[(i + 1) % 3];
                wedges.push_back(
                    {std::min(from, to), std::max(from, to), c[(i + 2) % 3], t, from < to});
            }
        std::sort(wedges.begin(), wedges.end(), [](const wedge &a, const wedge &b) {
            return std::tie(a.from, a.to, a.triangle) < std::tie(b.from, b.to, b.triangle);
        });
        for (size_t i = 0, end; i < wedges.size(); i = end) {
            for (end = i + 1; end < wedges.size() && wedges[end].from == wedges[i].from &&
                              wedges[end].to == wedges[i].to;)
                end++;
            balance(i, end);
            join_around(i, end);
        }
    }

    // Whether the triangles of an operand bound a volume at all.
    bool is_closed(unsigned operand) const
    {
        return even[operand];
    }

    // False when numbers contradict each other, which closed operands rule out.
    bool wind()
    {
        group();
        weights.assign(sides.size(), {});
        known.assign(sides.size(), 0);
        for (const part &p : all_parts)
            if (!seed(p))
                return false;
        return true;
    }
    // A number that is not 0 means inside. Where the triangles of an operand disagree on where
    // outside is, its numbers are 0 and 1: inside is what is in an odd number of shells.
    winding in_front(uint32_t t)
    {
        return weights[sides.find(2 * t)];
    }
    winding behind(uint32_t t)
    {
        return weights[sides.find(2 * t + 1)];
    }

  private:
    struct wedge { // a triangle at one of its edges
        uint32_t from, to, apex, triangle;
        bool forward; // the triangle has the edge in this direction
    };
    struct part { // triangles connected by edges: of `grouped`, from begin to end
        size_t begin, end;
        CGAL::Bbox_3 box;
    };

    void balance(size_t begin, size_t end)
    {
        winding turned, count;
        for (size_t i = begin; i < end; i++) {
            const winding &w = triangles[wedges[i].triangle].weight;
            turned += wedges[i].forward ? w : -w;
            count += w;
        }
        for (unsigned i = 0; i < 2; i++) {
            oriented[i] = oriented[i] && turned.of[i] == 0;
            even[i] = even[i] && count.of[i] % 2 == 0;
        }
    }

    // The sides that face each other around an edge belong to one cell.
    void join_around(size_t begin, size_t end)
    {
        if (end - begin > 2)
            sort_around(begin, end);
        for (size_t i = begin; i < end; i++) {
            const wedge &a = wedges[i], &b = wedges[i + 1 < end ? i + 1 : begin];
            sides.join(2 * a.triangle + !a.forward, 2 * b.triangle + b.forward);
            parts.join(a.triangle, b.triangle);
        }
    }

    // By angle from the first one on, towards the front of triangles that have the edge forward.
    void sort_around(size_t begin, size_t end)
    {
        const wedge first = wedges[begin];
        const exact::Point_3 &from = points[first.from], &to = points[first.to];
        auto turn = [&](const wedge &a, const wedge &b) {
            return CGAL::orientation(from, to, points[a.apex], points[b.apex]);
        };
        std::vector<std::pair<int, wedge>> order; // 0 in the first half turn, 1 opposite, 2 beyond
        for (size_t i = begin + 1; i < end; i++)
            order.emplace_back(1 - turn(first, wedges[i]), wedges[i]);
        std::sort(order.begin(), order.end(), [&](const auto &a, const auto &b) {
            return a.first != b.first ? a.first < b.first
                                      : a.first != 1 && turn(a.second, b.second) > 0;
        });
        for (size_t i = 0; i < order.size(); i++)
            wedges[begin + 1 + i] = order[i].second;
    }

    void group()
    {
        grouped.resize(triangles.size());
        std::iota(grouped.begin(), grouped.end(), 0U);
        std::vector<uint32_t> root(triangles.size());
        for (uint32_t t = 0; t < root.size(); t++)
            root[t] = parts.find(t);
        std::sort(grouped.begin(), grouped.end(), [&](uint32_t a, uint32_t b) {
            return std::tie(root[a], a) < std::tie(root[b], b);
        });
        for (size_t i = 0; i < grouped.size(); i++) {
            if (i == 0 || root[grouped[i]] != root[grouped[i - 1]])
                all_parts.push_back({i, i, CGAL::Bbox_3()});
            all_parts.back().end = i + 1;
            all_parts.back().box += box_of(grouped[i]);
        }
        first_of_cell.assign(sides.size(), NONE);
        next_of_cell.assign(sides.size(), NONE);
        for (uint32_t s = 0; s < sides.size(); s++) {
            uint32_t c = sides.find(s);
            next_of_cell[s] = first_of_cell[c];
            first_of_cell[c] = s;
        }
    }

    CGAL::Bbox_3 box_of(uint32_t t) const
    {
        const auto &c = triangles[t].corner;
        return points[c[0]].bbox() + points[c[1]].bbox() + points[c[2]].bbox();
    }

    // Numbers one side of one triangle, and from there all cells of the part.
    bool seed(const part &p)
    {
        for (size_t i = p.begin; i < p.end; i++) {
            uint32_t t = grouped[i];
            int facing = facing_x(t);
            if (facing == 0)
                continue;
            uint32_t c = sides.find(2 * t + (facing > 0));
            weights[c] = reduced(below(t));
            known[c] = 1;
            return spread(c);
        }
        return false; // never, of a part that bounds something
    }

    bool spread(uint32_t from)
    {
        std::vector<uint32_t> open = {from};
        while (!open.empty()) {
            uint32_t c = open.back();
            open.pop_back();
            for (uint32_t s = first_of_cell[c]; s != NONE; s = next_of_cell[s]) {
                const winding &step = triangles[s / 2].weight;
                winding there = reduced(weights[c] + (s % 2 ? -step : step));
                uint32_t other = sides.find(s ^ 1);
                if (!known[other]) {
                    known[other] = 1;
                    weights[other] = there;
                    open.push_back(other);
                } else if (!(weights[other] == there)) {
                    return false;
                }
            }
        }
        return true;
    }

    winding reduced(winding w) const
    {
        for (unsigned i = 0; i < 2; i++)
            if (!oriented[i])
                w.of[i] &= 1;
        return w;
    }

    exact::Point_2 along_x(uint32_t corner) const
    {
        return {points[corner].y(), points[corner].z()};
    }
    int facing_x(uint32_t t) const
    {
        const auto &c = triangles[t].corner;
        return CGAL::orientation(along_x(c[0]), along_x(c[1]), along_x(c[2]));
    }

    // The winding numbers right below the middle of a triangle, below meaning towards smaller x:
    // what a ray meets that comes from there. The middle counts as moved by an infinitely small
    // length along y and a still smaller one along z, so that the ray meets no edge.
    winding below(uint32_t t) const
    {
        const auto &c = triangles[t].corner;
        exact::Point_3 middle = CGAL::centroid(points[c[0]], points[c[1]], points[c[2]]);
        CGAL::Bbox_3 box = middle.bbox();
        auto in_reach = [&](const CGAL::Bbox_3 &b) {
            return b.xmin() <= box.xmax() && b.ymin() <= box.ymax() && b.ymax() >= box.ymin() &&
                   b.zmin() <= box.zmax() && b.zmax() >= box.zmin();
        };
        winding sum;
        for (const part &p : all_parts) {
            if (!in_reach(p.box))
                continue;
            for (size_t i = p.begin; i < p.end; i++)
                if (grouped[i] != t && in_reach(box_of(grouped[i])))
                    sum += crossed(grouped[i], middle);
        }
        return sum;
    }

    winding crossed(uint32_t t, const exact::Point_3 &p) const
    {
        const auto &c = triangles[t].corner;
        exact::Point_2 q(p.y(), p.z());
        int turns = 0;
        for (unsigned i = 0; i < 3; i++) {
            uint32_t from = c[i], to = c[(i + 1) % 3];
            bool rises = CGAL::compare_z(points[from], p) != CGAL::LARGER;
            if (rises != (CGAL::compare_z(points[to], p) == CGAL::LARGER))
                continue;
            if (CGAL::orientation(along_x(from), along_x(to), q) ==
                (rises ? CGAL::LEFT_TURN : CGAL::RIGHT_TURN))
                turns += rises ? 1 : -1;
        }
        if (turns == 0)
            return {};
        bool in_front = CGAL::orientation(points[c[0]], points[c[1]], points[c[2]], p) > 0;
        if (in_front != (turns > 0))
            return {};
        return turns > 0 ? -triangles[t].weight : triangles[t].weight;
    }

    const point_table &points;
    const std::vector<triangle> &triangles;
    sets sides, parts;
    std::vector<wedge> wedges;
    std::array<bool, 2> oriented = {true, true}, even = {true, true};
    std::vector<part> all_parts;
    std::vector<uint32_t> grouped, first_of_cell, next_of_cell;
    std::vector<winding> weights;
    std::vector<uint8_t> known;
};
} // namespace arrangement
