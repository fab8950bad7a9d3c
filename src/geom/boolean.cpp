// boolean.cpp - union, intersection and difference of meshes as one mesh, on the CGAL library.
//
// All triangles of both operands are cut along each other with exact numbers. What is left meets in
// whole edges and bounds cells that have winding numbers with regard to each operand; the result is
// bounded by the triangles between a cell that belongs to it and one that does not. Unlike the
// corefinement of CGAL this bears faces that coincide, operands that touch or cross themselves (as
// rounded results do), and results that are not manifold.
#include "geom/boolean_cells.hpp"
#include "geom/boolean_faces.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <cmath>
#include <stdexcept>

extern "C" {
#include "geom/boolean.h"
#include "geom/mesh.h"
}

using namespace arrangement;

namespace
{
// More pairs of triangles that cross would take minutes; solids have far fewer.
constexpr size_t MOST_CONTACTS = 2000000;

struct soup {
    std::vector<struct vec3> points; // each once
    std::vector<triangle> triangles; // each set of corners once
};

void add_points(const struct mesh *m, const char *which, std::vector<struct vec3> *out)
{
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        const struct vec3 &p = m->vertices[v];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            throw std::runtime_error(std::string(which) + " operand has a corner that is no point");
        out->push_back(p);
    }
}

// Makes equal points one; returns the new number of each.
std::vector<uint32_t> weld(std::vector<struct vec3> *points)
{
    auto key = [&](uint32_t i) { return std::tie((*points)[i].x, (*points)[i].y, (*points)[i].z); };
    std::vector<uint32_t> order(points->size()), number(points->size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    std::vector<struct vec3> kept;
    for (size_t i = 0; i < order.size(); i++) {
        if (i == 0 || key(order[i - 1]) != key(order[i]))
            kept.push_back((*points)[order[i]]);
        number[order[i]] = static_cast<uint32_t>(kept.size() - 1);
    }
    *points = std::move(kept);
    return number;
}

inexact::Point_3 at(const struct vec3 &p)
{
    return {p.x, p.y, p.z};
}

// Turned so that the corners ascend; the weight says which way round they were.
triangle normalised(std::array<uint32_t, 3> corner, unsigned operand, uint32_t source)
{
    triangle t = {corner, {}, source};
    std::sort(t.corner.begin(), t.corner.end());
    int rises = (corner[0] < corner[1]) + (corner[1] < corner[2]) + (corner[2] < corner[0]);
    t.weight.of[operand] = rises == 2 ? 1 : -1;
    return t;
}

// Triangles over the same corners become one, those that cancel out none.
void merge_equal(std::vector<triangle> *all)
{
    std::sort(all->begin(), all->end(), [](const triangle &a, const triangle &b) {
        return std::tie(a.corner, a.source) < std::tie(b.corner, b.source);
    });
    size_t kept = 0;
    for (size_t i = 0; i < all->size(); i++) {
        if (kept > 0 && (*all)[kept - 1].corner == (*all)[i].corner) {
            (*all)[kept - 1].weight += (*all)[i].weight;
            (*all)[kept - 1].source = NONE;
        } else {
            (*all)[kept++] = (*all)[i];
        }
    }
    all->resize(kept);
    all->erase(std::remove_if(all->begin(), all->end(),
                              [](const triangle &t) { return t.weight == winding(); }),
               all->end());
}

soup load(const struct mesh *a, const struct mesh *b)
{
    soup s;
    add_points(a, "the first", &s.points);
    add_points(b, "the second", &s.points);
    std::vector<uint32_t> number = weld(&s.points);
    const struct mesh *operands[2] = {a, b};
    uint32_t first_point = 0, first_face = 0;
    for (unsigned operand = 0; operand < 2; operand++) {
        const struct mesh *m = operands[operand];
        for (uint32_t t = 0; t < m->triangle_count; t++) {
            std::array<uint32_t, 3> c;
            for (unsigned i = 0; i < 3; i++)
                c[i] = number[first_point + m->triangles[t][i]];
            // What has no area bounds nothing; corners on edges of others are found all the same.
            if (!CGAL::collinear(at(s.points[c[0]]), at(s.points[c[1]]), at(s.points[c[2]])))
                s.triangles.push_back(normalised(c, operand, first_face + m->faces[t]));
        }
        first_point += m->vertex_count;
        first_face += m->face_count;
    }
    merge_equal(&s.triangles);
    return s;
}

// Cuts all triangles along each other.
class cutter
{
  public:
    cutter(point_table *table, const std::vector<triangle> &all)
        : points(*table), triangles(all), planes(all.size()), touched(all.size())
    {
    }

    std::vector<triangle> cut()
    {
        find_contacts();
        for (auto [s, t] : contacts)
            cross(s, t);
        std::vector<triangle> out;
        std::vector<uint32_t> order;
        for (uint32_t t = 0; t < triangles.size(); t++) {
            if (touched[t])
                order.push_back(t);
            else
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
            plane.cut(end - i == 1 ? triangles[order[i]].source : NONE, &out);
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

    void find_contacts()
    {
        using box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, uint32_t>;
        std::vector<box> boxes;
        boxes.reserve(triangles.size());
        for (uint32_t t = 0; t < triangles.size(); t++)
            boxes.emplace_back(input(t).bbox(), t);
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const box &s, const box &t) {
            if (!meets(s.info(), t.info()))
                return;
            if (contacts.size() == MOST_CONTACTS)
                throw std::runtime_error("the operands cross in too many places");
            contacts.emplace_back(std::minmax(s.info(), t.info()));
        });
        std::sort(contacts.begin(), contacts.end()); // for results that do not depend on the boxes
    }

    inexact::Triangle_3 input(uint32_t t) const
    {
        const auto &c = triangles[t].corner;
        return {points.given_point(c[0]), points.given_point(c[1]), points.given_point(c[2])};
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
        auto p = [&](uint32_t c) { return points.given_point(c); };
        if (shared == 0)
            return CGAL::do_intersect(input(s), input(t));
        if (shared == 1) // from the shared corner they go on together to the far edge of one
            return CGAL::do_intersect(input(s), inexact::Segment_3(p(b[1]), p(b[2]))) ||
                   CGAL::do_intersect(input(t), inexact::Segment_3(p(a[1]), p(a[2])));
        return CGAL::coplanar(p(a[0]), p(a[1]), p(a[2]), p(b[2])) &&
               CGAL::coplanar_orientation(p(a[0]), p(a[1]), p(a[2]), p(b[2])) == CGAL::POSITIVE;
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
    std::vector<uint8_t> touched;
    std::vector<std::pair<uint32_t, uint32_t>> contacts;
    std::vector<cut_line> lines;
};

bool belongs(enum boolean_op op, const winding &w)
{
    bool in_a = w.of[0] != 0, in_b = w.of[1] != 0;
    switch (op) {
    case BOOLEAN_UNION:
        return in_a || in_b;
    case BOOLEAN_INTERSECTION:
        return in_a && in_b;
    default:
        return in_a && !in_b;
    }
}

// The triangles between inside and outside of the result, seen counter-clockwise from outside.
std::vector<triangle> select(enum boolean_op op, const point_table &points,
                             const std::vector<triangle> &all)
{
    cells c(points, all);
    if (!c.is_closed(0))
        throw std::runtime_error("the first operand is not closed");
    if (!c.is_closed(1))
        throw std::runtime_error("the second operand is not closed");
    if (!c.wind())
        throw std::runtime_error("the operands bound no volume");
    std::vector<triangle> out;
    for (uint32_t t = 0; t < all.size(); t++) {
        bool behind = belongs(op, c.behind(t)), front = belongs(op, c.in_front(t));
        if (behind == front)
            continue;
        out.push_back({all[t].corner, {{1, 0}}, all[t].source});
        if (front)
            std::swap(out.back().corner[1], out.back().corner[2]);
    }
    return out;
}

void store(const point_table &points, const std::vector<triangle> &all, uint32_t face_count,
           struct mesh *out)
{
    struct mesh_builder b = {};
    std::unordered_map<uint32_t, uint32_t> numbers;
    while (b.mesh.face_count < face_count)
        mesh_add_face(&b);
    for (const triangle &t : all) {
        uint32_t corner[3];
        for (unsigned i = 0; i < 3; i++) {
            auto [found, added] = numbers.emplace(t.corner[i], b.mesh.vertex_count);
            if (added)
                mesh_add_vertex(&b, points.rounded(t.corner[i]));
            corner[i] = found->second;
        }
        mesh_add_triangle(&b, corner[0], corner[1], corner[2], t.source);
    }
    mesh_weld(&b.mesh); // points closer to each other than numbers can tell
    *out = b.mesh;
}

void evaluate(struct mesh *out, enum boolean_op op, const struct mesh *a, const struct mesh *b)
{
    soup s = load(a, b);
    point_table points(std::move(s.points));
    std::vector<triangle> pieces = cutter(&points, s.triangles).cut();
    std::vector<triangle> shell = select(op, points, pieces);
    flat_faces faces(points, shell);
    store(points, faces.cut(), faces.count(), out);
}
} // namespace

bool boolean_mesh(struct mesh *out, enum boolean_op op, const struct mesh *a, const struct mesh *b,
                  struct error *err)
{
    *out = {};
    try {
        evaluate(out, op, a, b);
        return true;
    } catch (const std::exception &e) { // CGAL's assertions too
        error_set(err, "%s", e.what());
        return false;
    }
}
