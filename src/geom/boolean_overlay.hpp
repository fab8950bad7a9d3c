// boolean_overlay.hpp - all that lies in one plane, cut into triangles that share whole edges.
#pragma once
#include "geom/boolean_exact.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <unordered_map>

namespace arrangement
{
// Closed polygons are added edge by edge, with the weight of what lies to the left; more edges may
// be added without weight. The weight of a piece of the plane then follows from crossing edges,
// whatever overlaps there: nothing is located.
class overlay
{
  public:
    // The plane is that of a triangle. It is seen along the axis nearest to its normal, so that the
    // triangle is seen counter-clockwise.
    overlay(point_table &table, const std::array<uint32_t, 3> &corner)
        : points(table), plane(table[corner[0]], table[corner[1]], table[corner[2]])
    {
        double best = -1;
        const exact::FT normal[3] = {plane.a(), plane.b(), plane.c()};
        for (int i = 0; i < 3; i++) {
            double size = std::fabs(CGAL::to_double(normal[i]));
            if (size > best && normal[i] != 0) {
                best = size;
                axis = i;
            }
        }
        right = (axis + 1) % 3;
        up = (axis + 2) % 3;
        if (normal[axis] < 0)
            std::swap(right, up);
    }

    void add(uint32_t from, uint32_t to, winding weight)
    {
        if (from < to)
            edges[{from, to}] += weight;
        else if (to < from)
            edges[{to, from}] += -weight;
        else
            vertex(from);
    }

    // Triangles with a weight that is not zero. Edges that cross make new points.
    void cut(std::vector<triangle> *out)
    {
        insert_edges();
        if (plain.dimension() < 2)
            return;
        spread();
        for (auto f : plain.finite_face_handles())
            if (!(f->info().weight == winding()))
                out->push_back({{f->vertex(0)->info().number, f->vertex(1)->info().number,
                                 f->vertex(2)->info().number},
                                f->info().weight});
    }

    uint32_t points_made() const
    {
        return made;
    }

  private:
    struct corner_info {
        uint32_t number = NONE;
    };
    struct face_info {
        winding weight;
        bool reached = false;
    };
    using vertex_base = CGAL::Triangulation_vertex_base_with_info_2<corner_info, exact>;
    using face_base = CGAL::Triangulation_face_base_with_info_2<
        face_info, exact, CGAL::Constrained_triangulation_face_base_2<exact>>;
    using structure = CGAL::Triangulation_data_structure_2<vertex_base, face_base>;
    using triangulation =
        CGAL::Constrained_triangulation_plus_2<CGAL::Constrained_Delaunay_triangulation_2<
            exact, structure, CGAL::Exact_intersections_tag>>;
    using vertex_handle = triangulation::Vertex_handle;

    exact::Point_2 flattened(const exact::Point_3 &p) const
    {
        return {p[right], p[up]};
    }

    exact::Point_3 lifted(const exact::Point_2 &p) const
    {
        const exact::FT normal[3] = {plane.a(), plane.b(), plane.c()};
        exact::FT at[3];
        at[right] = p.x();
        at[up] = p.y();
        at[axis] = -(normal[right] * p.x() + normal[up] * p.y() + plane.d()) / normal[axis];
        return {at[0], at[1], at[2]};
    }

    vertex_handle vertex(uint32_t number)
    {
        auto [at, added] = vertices.emplace(number, vertex_handle());
        if (added) {
            auto near = newest == vertex_handle() ? nullptr : newest->face();
            newest = at->second = plain.insert(flattened(points[number]), near);
            newest->info().number = number;
        }
        return at->second;
    }

    void insert_edges()
    {
        std::vector<std::pair<triangulation::Constraint_id, winding>> weighted;
        for (const auto &[e, weight] : edges) {
            vertex_handle from = vertex(e.first), to = vertex(e.second);
            auto id = plain.insert_constraint(from, to);
            if (!(weight == winding()))
                weighted.emplace_back(id, weight);
        }
        for (auto v : plain.finite_vertex_handles())
            if (v->info().number == NONE) {
                v->info().number = points.number_of(lifted(v->point()));
                made++;
            }
        for (const auto &[id, weight] : weighted) {
            auto v = plain.vertices_in_constraint_begin(id);
            auto end = plain.vertices_in_constraint_end(id);
            for (auto next = std::next(v); next != end; v = next++)
                add_piece((*v)->info().number, (*next)->info().number, weight);
        }
    }

    void add_piece(uint32_t from, uint32_t to, winding weight)
    {
        if (from < to)
            pieces[{from, to}] += weight;
        else
            pieces[{to, from}] += -weight;
    }

    winding piece(vertex_handle from, vertex_handle to) const
    {
        edge key = std::minmax(from->info().number, to->info().number);
        auto at = pieces.find(key);
        if (at == pieces.end() || plain.is_infinite(from) || plain.is_infinite(to))
            return {};
        return key.first == from->info().number ? at->second : -at->second;
    }

    // From the outside, which has no weight, to all faces.
    void spread()
    {
        std::vector<triangulation::Face_handle> open = {plain.infinite_face()};
        open.back()->info().reached = true;
        while (!open.empty()) {
            auto f = open.back();
            open.pop_back();
            for (int i = 0; i < 3; i++) {
                auto g = f->neighbor(i);
                if (g->info().reached)
                    continue;
                g->info().reached = true;
                g->info().weight = f->info().weight - piece(f->vertex(triangulation::ccw(i)),
                                                            f->vertex(triangulation::cw(i)));
                open.push_back(g);
            }
        }
    }

    point_table &points;
    exact::Plane_3 plane;
    int axis = 0, right, up;
    triangulation plain;
    vertex_handle newest; // the next one is likely to be near
    std::unordered_map<uint32_t, vertex_handle> vertices;
    std::map<edge, winding> edges, pieces; // left of the way from the smaller number
    uint32_t made = 0;
};
} // namespace arrangement
