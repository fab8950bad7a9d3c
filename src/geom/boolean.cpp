// boolean.cpp - union, intersection and difference of meshes as one mesh, on the CGAL library.
//
// All triangles of both operands are cut along each other with exact numbers. What is left meets in
// whole edges and bounds cells that have winding numbers with regard to each operand; the result is
// bounded by the triangles between a cell that belongs to it and one that does not. Unlike the
// corefinement of CGAL this bears faces that coincide, operands that touch or cross themselves (as
// rounded results do), and results that are not manifold.
#include "geom/boolean_cells.hpp"
#include "geom/boolean_cutter.hpp"
#include "geom/boolean_faces.hpp"
#include "geom/boolean_planes.hpp"

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
constexpr double FARTHEST = 1e50;

struct soup {
    std::vector<struct vec3> points; // each once
    double tolerance;
    std::vector<triangle> triangles; // each set of corners once
};

void add_points(const struct mesh *m, const char *which, std::vector<struct vec3> *out)
{
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        const struct vec3 &p = m->vertices[v];
        for (double c : {p.x, p.y, p.z})
            if (!(std::fabs(c) <= FARTHEST)) // also for NaN
                throw std::runtime_error(std::string(which) + " operand has corners out of range");
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
    return std::max(most * 0x1p-38, 1e-100);
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
        for (int i = 0; i < 8; i++)
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
        uint32_t same = find(p);
        if (same == NONE) {
            same = static_cast<uint32_t>(kept.size());
            kept.push_back(p);
            cells_of_kept.emplace(cell(p.x, p.y, p.z), same);
        }
        number.push_back(same);
    }
    *points = std::move(kept);
    return number;
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
    s.tolerance = tolerance_for(s.points);
    std::vector<uint32_t> number = weld(&s.points, s.tolerance);
    const struct mesh *operands[2] = {a, b};
    uint32_t first_point = 0;
    for (unsigned operand = 0; operand < 2; operand++) {
        const struct mesh *m = operands[operand];
        for (uint32_t t = 0; t < m->triangle_count; t++) {
            std::array<uint32_t, 3> c;
            for (unsigned i = 0; i < 3; i++)
                c[i] = number[first_point + m->triangles[t][i]];
            if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0])
                s.triangles.push_back(normalised(c, operand));
        }
        first_point += m->vertex_count;
    }
    merge_equal(&s.triangles);
    return s;
}

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
    triangle_pairs pairs = near_pairs(s.points, s.triangles, s.tolerance);
    point_table points(std::move(s.points));
    common_planes(&points, s.triangles, s.tolerance).align(pairs);
    std::vector<triangle> pieces = cutter(&points, s.triangles).cut(pairs);
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
