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
#include <set>
#include <stdexcept>
#include <string>
#include <unordered_map>

extern "C" {
#include "base/hash.h"
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

// By far more than rounding moves points by, by far less than OpenSCAD's grid of 2^-20 for extents
// it is used with.
double tolerance_for(const std::vector<struct vec3> &points)
{
    double most = 0;
    for (const struct vec3 &p : points)
        most = std::max({most, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    return most * 0x1p-38;
}

// Makes points that are as good as equal one; returns the new number of each. Points are kept in
// cells of space: the few within reach of one are in its cell or next to it.
std::vector<uint32_t> weld(std::vector<struct vec3> *points, double tolerance)
{
    constexpr double CELL = 32; // in tolerances: most points reach one cell only
    std::vector<uint32_t> number;
    std::vector<struct vec3> kept;
    std::unordered_multimap<uint64_t, uint32_t> cells_of_kept;
    auto cell = [&](double x, double y, double z) {
        uint64_t hash = 0;
        for (double c : {x, y, z})
            hash = hash_mix(hash ^ static_cast<uint64_t>(
                                       static_cast<int64_t>(std::floor(c / (CELL * tolerance)))));
        return hash;
    };
    auto find = [&](const struct vec3 &p) {
        std::set<uint64_t> reached;
        for (int i = 0; i < 8 && tolerance > 0; i++)
            reached.insert(cell(p.x + (i & 1 ? tolerance : -tolerance),
                                p.y + (i & 2 ? tolerance : -tolerance),
                                p.z + (i & 4 ? tolerance : -tolerance)));
        for (uint64_t c : reached)
            for (auto [k, end] = cells_of_kept.equal_range(c); k != end; ++k)
                if (vec3_length(vec3_sub(kept[k->second], p)) <= tolerance)
                    return k->second;
        return NONE;
    };
    for (const struct vec3 &p : *points) {
        uint32_t same = tolerance > 0 ? find(p) : kept.empty() ? NONE : 0;
        if (same == NONE) {
            same = static_cast<uint32_t>(kept.size());
            kept.push_back(p);
            if (tolerance > 0)
                cells_of_kept.emplace(cell(p.x, p.y, p.z), same);
        }
        number.push_back(same);
    }
    *points = std::move(kept);
    return number;
}

inexact::Point_3 at(const struct vec3 &p)
{
    return {p.x, p.y, p.z};
}

// Turned so that the corners ascend; the weight says which way round they were.
triangle normalised(std::array<uint32_t, 3> corner, unsigned operand)
{
    triangle t = {corner, {}};
    std::sort(t.corner.begin(), t.corner.end());
    int rises = (corner[0] < corner[1]) + (corner[1] < corner[2]) + (corner[2] < corner[0]);
    t.weight.of[operand] = rises == 2 ? 1 : -1;
    return t;
}

// Triangles over the same corners become one, those that cancel out none.
void merge_equal(std::vector<triangle> *all)
{
    std::sort(all->begin(), all->end(),
              [](const triangle &a, const triangle &b) { return a.corner < b.corner; });
    size_t kept = 0;
    for (size_t i = 0; i < all->size(); i++) {
        if (kept > 0 && (*all)[kept - 1].corner == (*all)[i].corner) {
            (*all)[kept - 1].weight += (*all)[i].weight;
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
    std::vector<uint32_t> number = weld(&s.points, tolerance_for(s.points));
    const struct mesh *operands[2] = {a, b};
    uint32_t first_point = 0;
    for (unsigned operand = 0; operand < 2; operand++) {
        const struct mesh *m = operands[operand];
        for (uint32_t t = 0; t < m->triangle_count; t++) {
            std::array<uint32_t, 3> c;
            for (unsigned i = 0; i < 3; i++)
                c[i] = number[first_point + m->triangles[t][i]];
            // What has no area bounds nothing; corners on edges of others are found all the same.
            if (!CGAL::collinear(at(s.points[c[0]]), at(s.points[c[1]]), at(s.points[c[2]])))
                s.triangles.push_back(normalised(c, operand));
        }
        first_point += m->vertex_count;
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
        out.push_back({all[t].corner, {{1, 0}}});
        if (front)
            std::swap(out.back().corner[1], out.back().corner[2]);
    }
    return out;
}

// Gives corners the numbers of rounded points, and drops triangles that are lines then.
std::vector<struct vec3> round_corners(const point_table &points, std::vector<triangle> *all,
                                       double *tolerance)
{
    std::unordered_map<uint32_t, uint32_t> numbers;
    std::vector<struct vec3> rounded;
    for (triangle &t : *all)
        for (uint32_t &c : t.corner) {
            auto [found, added] = numbers.emplace(c, static_cast<uint32_t>(rounded.size()));
            if (added)
                rounded.push_back(points.rounded(c));
            c = found->second;
        }
    *tolerance = tolerance_for(rounded);
    std::vector<uint32_t> welded = weld(&rounded, *tolerance);
    for (triangle &t : *all)
        for (uint32_t &c : t.corner)
            c = welded[c];
    all->erase(std::remove_if(all->begin(), all->end(),
                              [](const triangle &t) {
                                  const auto &c = t.corner;
                                  return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
                              }),
               all->end());
    return rounded;
}

void store(const point_table &points, const std::vector<triangle> &all,
           const std::vector<uint32_t> &faces, uint32_t face_count, struct mesh *out)
{
    struct mesh_builder b = {};
    for (uint32_t c = 0; c < points.size(); c++)
        mesh_add_vertex(&b, points.rounded(c));
    while (b.mesh.face_count < face_count)
        mesh_add_face(&b);
    for (size_t t = 0; t < all.size(); t++)
        mesh_add_triangle(&b, all[t].corner[0], all[t].corner[1], all[t].corner[2], faces[t]);
    mesh_weld(&b.mesh); // drops what is not used
    *out = b.mesh;
}

void evaluate(struct mesh *out, enum boolean_op op, const struct mesh *a, const struct mesh *b)
{
    soup s = load(a, b);
    point_table points(std::move(s.points));
    std::vector<triangle> pieces = cutter(&points, s.triangles).cut();
    std::vector<triangle> shell = select(op, points, pieces);
    double tolerance;
    point_table corners(round_corners(points, &shell, &tolerance));
    flat_faces faces(corners, shell, tolerance);
    std::vector<uint32_t> numbers;
    std::vector<triangle> result = faces.cut(&numbers);
    store(corners, result, numbers, faces.number_count(), out);
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
