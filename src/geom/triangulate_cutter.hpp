// triangulate_cutter.hpp - an outline cut into triangles, with CGAL's constrained Delaunay
// triangulation.
//
// Extrusions close up only if the directed edges of the triangles add up to exactly the outline.
// But an edge on which other points lie is several edges of the triangulation, and rounding may
// make edges cross. So triangles are taken as often as the paths wind around them, crossings are
// moved to points of the outline, and triangles without area fill the seams.
#pragma once
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

extern "C" { // below the headers of the system, which do not bear it
#include "base/hash.h"
#include "base/mem.h"
#include "geom/outline.h"
}

namespace triangulation
{
constexpr uint32_t NONE = UINT32_MAX;
// An outline that is not clean after all costs at most this much.
constexpr int WINDING_MOST = 4;
constexpr size_t PIECES_PER_EDGE = 3, PIECES_MORE = 1000;

struct names {
    uint32_t point = NONE; // of the outline: there, or near by for a crossing
    uint32_t serial = NONE;
};
struct winding {
    int value = 0;
    bool known = false;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<names, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<winding, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
// The plain one is three times as fast, but only for outlines whose edges meet at their ends alone.
using Plain = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, Structure, CGAL::No_constraint_intersection_requiring_constructions_tag>;
// This one knows what becomes of edges that touch or cross.
using Tracking = CGAL::Constrained_triangulation_plus_2<
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>>;
using Point = Kernel::Point_2;
using Triangles = std::vector<std::array<uint32_t, 3>>;

inline uint64_t pair_key(uint32_t low, uint32_t high)
{
    return static_cast<uint64_t>(low) << 32 | high;
}

// Calls what(i, j) for each edge from point i to point j.
template <class F> void for_edges(const outline &o, F what)
{
    for (uint32_t path = 0, begin = 0; path < o.path_count; begin = o.ends[path++])
        for (uint32_t i = begin; i < o.ends[path]; i++)
            what(i, i + 1 < o.ends[path] ? i + 1 : begin);
}

template <class T> class cutter
{
    using Vertex = typename T::Vertex_handle;
    using Face = typename T::Face_handle;

    // All edges of the outline between two places as one.
    struct edge {
        Vertex from, to;
        int weight = 0; // how often the outline runs that way less how often back
        Tracking::Constraint_id constraint = nullptr;
    };

  public:
    cutter(const outline &shape, Triangles &triangles) : o(shape), out(triangles)
    {
    }
    void cut();

  private:
    void add(uint32_t i, uint32_t j, uint32_t k, int times);
    void add_points();
    void add_edges();
    void add_constraints();
    void follow(const edge &e);
    void weigh(const edge &e);
    int step(Vertex from, Vertex to) const;
    void wind();
    void check() const;
    void take();
    void fill_moved();
    void fill_seam(const edge &e);

    const outline &o;
    Triangles &out;
    T t;
    std::vector<Vertex> at; // of each point
    std::vector<edge> edges;
    std::vector<Vertex> line;                  // the vertices on the edge followed last
    std::unordered_map<uint64_t, int> weights; // of edges of t, from the lower to the higher serial
    uint32_t next_serial = 0;
};

// Triangles without area have their use, those with one corner twice have none.
template <class T> void cutter<T>::add(uint32_t i, uint32_t j, uint32_t k, int times)
{
    auto same = [&](uint32_t a, uint32_t b) {
        return o.points[a].x == o.points[b].x && o.points[a].y == o.points[b].y;
    };
    if (same(i, j) || same(j, k) || same(k, i))
        return;
    if (times < 0)
        std::swap(j, k);
    for (int n = std::min(std::abs(times), WINDING_MOST); n > 0; n--)
        out.push_back({i, j, k});
}

// Points go into the unit square, onto a grid at the end of what numbers can say: nothing computed
// from them can then overflow or underflow.
template <class T> void cutter<T>::add_points()
{
    double largest = 0;
    for (uint32_t i = 0; i < o.point_count; i++)
        largest = std::fmax(largest, std::fmax(std::fabs(o.points[i].x), std::fabs(o.points[i].y)));
    int exponent;
    std::frexp(largest, &exponent);
    auto scaled = [&](double x) {
        return std::ldexp(std::nearbyint(std::ldexp(x, 52 - exponent)), -52);
    };
    std::vector<std::pair<Point, uint32_t>> points;
    points.reserve(o.point_count);
    for (uint32_t i = 0; i < o.point_count; i++)
        points.emplace_back(Point(scaled(o.points[i].x), scaled(o.points[i].y)), i);

    using Place = CGAL::First_of_pair_property_map<std::pair<Point, uint32_t>>;
    CGAL::spatial_sort(points.begin(), points.end(),
                       CGAL::Spatial_sort_traits_adapter_2<Kernel, Place>());
    at.resize(o.point_count);
    // A frame around everything: while all points are on one line, searches are slow.
    next_serial = o.point_count;
    for (const Point &corner : {Point(-4, -4), Point(4, -4), Point(0, 4)})
        t.insert(corner)->info().serial = next_serial++;
    Face near;
    for (const auto &[place, i] : points) {
        Vertex v = t.insert(place, near);
        near = v->face();
        if (v->info().point == NONE)
            v->info() = {i, i};
        at[i] = v;
    }
}

template <class T> void cutter<T>::add_edges()
{
    std::unordered_map<uint64_t, size_t> found;
    found.reserve(o.point_count);
    edges.reserve(o.point_count);
    for_edges(o, [&](uint32_t i, uint32_t j) {
        Vertex from = at[i], to = at[j];
        if (from == to)
            return;
        uint32_t a = from->info().serial, b = to->info().serial;
        auto [entry, fresh] =
            found.try_emplace(pair_key(std::min(a, b), std::max(a, b)), edges.size());
        if (fresh)
            edges.push_back({from, to});
        edge &e = edges[entry->second];
        e.weight += e.from == from ? 1 : -1;
    });
}

// In random order, which makes the work for edges across many triangles n log n. Searches begin at
// the end where fewer edges meet, so that those of a common corner do not try all of them.
template <class T> void cutter<T>::add_constraints()
{
    std::vector<uint32_t> meeting(o.point_count);
    for (const edge &e : edges) {
        meeting[e.from->info().serial]++;
        meeting[e.to->info().serial]++;
    }
    uint64_t state = 0;
    for (size_t i = edges.size(); i > 1; i--)
        std::swap(edges[i - 1], edges[random_next(&state) % i]);
    size_t pieces = 0, most = PIECES_PER_EDGE * edges.size() + PIECES_MORE;
    for (edge &e : edges) {
        if (e.weight == 0)
            continue;
        if (meeting[e.from->info().serial] > meeting[e.to->info().serial]) {
            std::swap(e.from, e.to);
            e.weight = -e.weight;
        }
        if constexpr (std::is_same_v<T, Tracking>)
            e.constraint = t.insert_constraint(e.from, e.to);
        else
            t.insert_constraint(e.from, e.to);
        follow(e);
        pieces += line.size();
        if (pieces > most)
            throw std::length_error("not clean");
    }
}

// Crossings, which are no points of the outline, go to the nearer end of the edge.
template <class T> void cutter<T>::follow(const edge &e)
{
    if constexpr (std::is_same_v<T, Tracking>) {
        auto on = t.vertices_in_constraint(e.constraint);
        line.assign(on.begin(), on.end());
    } else {
        if (!t.is_edge(e.from, e.to))
            throw std::domain_error("points on edges");
        line = {e.from, e.to};
    }
    for (Vertex v : line)
        if (v->info().point == NONE) {
            bool start =
                CGAL::has_smaller_distance_to_point(v->point(), e.from->point(), e.to->point());
            v->info() = {(start ? e.from : e.to)->info().point, next_serial++};
        }
}

template <class T> void cutter<T>::weigh(const edge &e)
{
    for (size_t i = 1; i < line.size(); i++) {
        uint32_t a = line[i - 1]->info().serial, b = line[i]->info().serial;
        weights[pair_key(std::min(a, b), std::max(a, b))] += a < b ? e.weight : -e.weight;
    }
}

template <class T> int cutter<T>::step(Vertex from, Vertex to) const
{
    uint32_t a = from->info().serial, b = to->info().serial;
    auto entry = weights.find(pair_key(std::min(a, b), std::max(a, b)));
    int weight = entry == weights.end() ? 0 : entry->second;
    return a < b ? weight : -weight;
}

// From the outside inward: left of an edge the outline winds once more than right of it.
template <class T> void cutter<T>::wind()
{
    std::vector<Face> stack{t.infinite_face()};
    stack.back()->info().known = true;
    while (!stack.empty()) {
        Face f = stack.back();
        stack.pop_back();
        for (int i = 0; i < 3; i++) {
            Face g = f->neighbor(i);
            if (g->info().known)
                continue;
            int less = f->is_constrained(i) ? step(f->vertex(t.ccw(i)), f->vertex(t.cw(i))) : 0;
            g->info() = {f->info().value - less, true};
            stack.push_back(g);
        }
    }
}

// Do the windings differ across each edge by what the outline says, and is no edge of it missing?
// Where many edges cross by rounding it may be otherwise.
template <class T> void cutter<T>::check() const
{
    size_t missing = 0;
    for (const auto &[key, weight] : weights)
        missing += weight != 0;
    for (auto e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
        const auto &[f, i] = *e;
        int less = step(f->vertex(t.ccw(i)), f->vertex(t.cw(i)));
        missing -= less != 0;
        if (f->info().value - f->neighbor(i)->info().value != less)
            throw std::domain_error("windings differ");
    }
    if (missing != 0)
        throw std::domain_error("edges are missing");
}

template <class T> void cutter<T>::take()
{
    for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f) {
        if (f->info().value == 0)
            continue;
        uint32_t corners[3];
        for (int i = 0; i < 3; i++) {
            corners[i] = f->vertex(i)->info().point;
            if (corners[i] == NONE)
                throw std::domain_error("a point of no edge");
        }
        add(corners[0], corners[1], corners[2], f->info().value);
    }
}

// Where the grid has put points together.
template <class T> void cutter<T>::fill_moved()
{
    for_edges(o, [&](uint32_t i, uint32_t j) {
        uint32_t to_i = at[i]->info().point, to_j = at[j]->info().point;
        add(i, j, to_j, 1);
        add(i, to_j, to_i, 1);
    });
}

// Between an edge and what has become of it.
template <class T> void cutter<T>::fill_seam(const edge &e)
{
    for (size_t i = 2; i < line.size(); i++)
        add(line[0]->info().point, line[i]->info().point, line[i - 1]->info().point, e.weight);
}

template <class T> void cutter<T>::cut()
{
    add_points();
    add_edges();
    add_constraints();
    weights.reserve(edges.size());
    for (const edge &e : edges)
        if (e.weight != 0) {
            follow(e); // again: later edges may have crossed it
            weigh(e);
            fill_seam(e);
        }
    wind();
    check();
    take();
    fill_moved();
}
} // namespace triangulation
