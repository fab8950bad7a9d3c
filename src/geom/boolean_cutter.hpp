// boolean_cutter.hpp - cutting triangles in space along each other.
#pragma once
#include "geom/boolean_overlay.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace arrangement
{
// More would take minutes; solids have far fewer.
constexpr size_t MOST_CONTACTS = 2000000; // of triangles that meet
constexpr size_t MOST_PAIRS = 32000000;   // of triangles that may meet

using triangle_pairs = std::vector<std::pair<uint32_t, uint32_t>>;

// Of triangles that come as near as the tolerance, and others. Sorted, so that no result depends on
// the order of the search.
inline triangle_pairs near_pairs(const std::vector<struct vec3> &points,
                                 const std::vector<triangle> &triangles, double tolerance)
{
    using near_box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, uint32_t>;
    std::vector<near_box> boxes;
    boxes.reserve(triangles.size());
    for (uint32_t t = 0; t < triangles.size(); t++) {
        struct box b = BOX_EMPTY;
        for (uint32_t c : triangles[t].corner)
            b = box_of_point(b, points[c]);
        boxes.emplace_back(CGAL::Bbox_3(b.min.x - tolerance, b.min.y - tolerance,
                                        b.min.z - tolerance, b.max.x + tolerance,
                                        b.max.y + tolerance, b.max.z + tolerance),
                           t);
    }
    triangle_pairs pairs;
    CGAL::box_self_intersection_d(
        boxes.begin(), boxes.end(), [&](const near_box &a, const near_box &b) {
            if (pairs.size() == MOST_PAIRS)
                throw std::runtime_error("the operands cross in too many places");
            pairs.emplace_back(std::minmax(a.info(), b.info()));
        });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

// Cuts all triangles along each other.
class cutter
{
  public:
    cutter(point_table *table, const std::vector<triangle> &all)
        : points(*table), triangles(all), planes(all.size()), touched(all.size()), empty(all.size())
    {
        // What has no area bounds nothing. Its corners on edges of others are found all the same.
        for (uint32_t t = 0; t < triangles.size(); t++) {
            const auto &c = triangles[t].corner;
            empty[t] = is_given(t)
                           ? CGAL::collinear(points.given_point(c[0]), points.given_point(c[1]),
                                             points.given_point(c[2]))
                           : CGAL::collinear(points[c[0]], points[c[1]], points[c[2]]);
        }
    }

    // `pairs` holds all that may meet.
    std::vector<triangle> cut(const triangle_pairs &pairs)
    {
        size_t contacts = 0;
        for (auto [s, t] : pairs) {
            if (empty[s] || empty[t] || !meets(s, t))
                continue;
            if (++contacts > MOST_CONTACTS)
                throw std::runtime_error("the operands cross in too many places");
            cross(s, t);
        }
        std::vector<triangle> out;
        std::vector<uint32_t> order;
        for (uint32_t t = 0; t < triangles.size(); t++) {
            if (touched[t])
                order.push_back(t);
            else if (!empty[t])
                out.push_back(triangles[t]);
        }
        auto plane_of = [&](uint32_t t) { return planes.find(t); };
        std::sort(order.begin(), order.end(), [&](uint32_t s, uint32_t t) {
            return std::make_pair(plane_of(s), s) < std::make_pair(plane_of(t), t);
        });
        for (cut_line &l : lines)
            l.triangle = plane_of(l.triangle);
        std::sort(lines.begin(), lines.end());
        auto line = lines.begin();
        for (size_t i = 0, end; i < order.size(); i = end) {
            for (end = i + 1; end < order.size() && plane_of(order[end]) == plane_of(order[i]);)
                end++;
            overlay plane(points, triangles[order[i]].corner);
            for (size_t j = i; j < end; j++)
                add_outline(&plane, triangles[order[j]]);
            for (; line != lines.end() && line->triangle == plane_of(order[i]); ++line)
                plane.add(line->from, line->to, {});
            plane.cut(&out);
        }
        return out;
    }

  private:
    struct cut_line {
        uint32_t triangle, from, to;
        bool operator<(const cut_line &l) const
        {
            return std::tie(triangle, from, to) < std::tie(l.triangle, l.from, l.to);
        }
    };

    static void add_outline(overlay *plane, const triangle &t)
    {
        for (unsigned i = 0; i < 3; i++)
            plane->add(t.corner[i], t.corner[(i + 1) % 3], t.weight);
    }

    bool is_given(uint32_t t) const
    {
        const auto &c = triangles[t].corner;
        return points.is_given(c[0]) && points.is_given(c[1]) && points.is_given(c[2]);
    }

    // Whether two triangles meet anywhere but in corners and edges that they share.
    bool meets(uint32_t s, uint32_t t) const
    {
        std::array<uint32_t, 3> a = triangles[s].corner, b = triangles[t].corner;
        unsigned shared = 0;
        for (unsigned i = 0; i < 3; i++)
            for (unsigned j = shared; j < 3; j++)
                if (a[i] == b[j]) {
                    std::swap(a[i], a[shared]);
                    std::swap(b[j], b[shared]);
                    shared++;
                    break;
                }
        if (is_given(s) && is_given(t))
            return meet<inexact>(a, b, shared, [&](uint32_t c) { return points.given_point(c); });
        return meet<exact>(a, b, shared, [&](uint32_t c) { return points[c]; });
    }

    // Shared corners come first.
    template <class kernel, class point_of>
    static bool meet(const std::array<uint32_t, 3> &a, const std::array<uint32_t, 3> &b,
                     unsigned shared, point_of p)
    {
        using triangle_3 = typename kernel::Triangle_3;
        using segment_3 = typename kernel::Segment_3;
        triangle_3 s(p(a[0]), p(a[1]), p(a[2])), t(p(b[0]), p(b[1]), p(b[2]));
        if (shared == 0)
            return CGAL::do_intersect(s, t);
        if (shared == 1) // from the shared corner they go on together to the far edge of one
            return CGAL::do_intersect(s, segment_3(t[1], t[2])) ||
                   CGAL::do_intersect(t, segment_3(s[1], s[2]));
        return CGAL::coplanar(s[0], s[1], s[2], t[2]) &&
               CGAL::coplanar_orientation(s[0], s[1], s[2], t[2]) == CGAL::POSITIVE;
    }

    void touch(uint32_t t)
    {
        if (!touched[t])
            for (uint32_t c : triangles[t].corner)
                points.meet(c);
        touched[t] = 1;
    }

    exact::Triangle_3 in_space(uint32_t t) const
    {
        const auto &c = triangles[t].corner;
        return {points[c[0]], points[c[1]], points[c[2]]};
    }

    void cross(uint32_t s, uint32_t t)
    {
        touch(s);
        touch(t);
        auto common = CGAL::intersection(in_space(s), in_space(t));
        if (!common)
            return;
        std::vector<exact::Point_3> ring;
        if (const auto *p = boost::get<exact::Point_3>(&*common))
            ring = {*p};
        else if (const auto *l = boost::get<exact::Segment_3>(&*common))
            ring = {l->source(), l->target()};
        else if (const auto *f = boost::get<exact::Triangle_3>(&*common))
            ring = {f->vertex(0), f->vertex(1), f->vertex(2)};
        else
            ring = boost::get<std::vector<exact::Point_3>>(*common);
        if (ring.size() > 2) // where both cover the plane they must be cut alike
            planes.join(s, t);
        for (size_t i = 0; i < ring.size(); i++) {
            uint32_t from = points.number_of(ring[i]);
            uint32_t to = points.number_of(ring[(i + 1) % ring.size()]);
            lines.push_back({s, from, to});
            lines.push_back({t, from, to});
        }
    }

    point_table &points;
    const std::vector<triangle> &triangles;
    sets planes; // of triangles that overlap in one plane
    std::vector<uint8_t> touched, empty;
    std::vector<cut_line> lines;
};
} // namespace arrangement
