// boolean_faces.hpp - flat faces of a result: joined, without needless points, cut anew.
#pragma once
#include "geom/boolean_overlay.hpp"

#include <algorithm>
#include <tuple>

namespace arrangement
{
constexpr double FLAT = 1e-9; // height over the plane of a face, by distance

// Triangles of one plane, or of one face of an operand, that share an edge form one face. Points
// inside of faces go, and those on straight edges between two faces.
class flat_faces
{
  public:
    flat_faces(point_table &table, const std::vector<triangle> &all)
        : points(table), triangles(all), faces(all.size()), corners(table.size())
    {
        join_neighbours();
        number_faces();
        for (const side &s : outline)
            if (s.first_of_edge) {
                meet(s.from, s.to);
                meet(s.to, s.from);
            }
    }

    uint32_t count() const
    {
        return face_count;
    }

    // The triangles with the numbers of their faces as sources.
    std::vector<triangle> cut()
    {
        std::vector<uint8_t> stale(face_count);
        std::vector<triangle> kept, renewed;
        for (size_t t = 0; t < triangles.size(); t++)
            for (uint32_t c : triangles[t].corner)
                stale[number[t]] |= is_needless(c);
        for (size_t t = 0; t < triangles.size(); t++)
            if (!stale[number[t]])
                kept.push_back({triangles[t].corner, triangles[t].weight, number[t]});
        if (cut_anew(stale, &renewed)) {
            kept.insert(kept.end(), renewed.begin(), renewed.end());
            return kept;
        }
        std::vector<triangle> all = triangles;
        for (size_t t = 0; t < all.size(); t++)
            all[t].source = number[t];
        return all;
    }

  private:
    struct side { // an edge of a triangle, in the direction in which the triangle has it
        uint32_t from, to, triangle;
        bool first_of_edge;
    };
    struct corner_info {
        uint32_t neighbours[2] = {NONE, NONE}; // along edges between faces
        uint32_t edges = 0;                    // how many such
        int8_t needless = -1;                  // not known yet
    };

    void join_neighbours()
    {
        std::vector<side> all;
        for (uint32_t t = 0; t < triangles.size(); t++)
            for (unsigned i = 0; i < 3; i++)
                all.push_back({triangles[t].corner[i], triangles[t].corner[(i + 1) % 3], t, false});
        auto key = [](const side &s) {
            return std::make_pair(std::min(s.from, s.to), std::max(s.from, s.to));
        };
        std::sort(all.begin(), all.end(), [&](const side &a, const side &b) {
            return std::make_tuple(key(a), a.triangle) < std::make_tuple(key(b), b.triangle);
        });
        std::vector<std::pair<size_t, size_t>> edges_kept;
        for (size_t i = 0, end; i < all.size(); i = end) {
            for (end = i + 1; end < all.size() && key(all[end]) == key(all[i]);)
                end++;
            if (end - i == 2 && is_flat(all[i].triangle, all[i + 1].triangle))
                faces.join(all[i].triangle, all[i + 1].triangle);
            else
                edges_kept.emplace_back(i, end);
        }
        for (auto [i, end] : edges_kept) {
            // Within a face that bends back on itself two triangles may meet that are not flat.
            if (end - i == 2 && faces.find(all[i].triangle) == faces.find(all[i + 1].triangle))
                continue;
            all[i].first_of_edge = true;
            outline.insert(outline.end(), all.begin() + static_cast<ptrdiff_t>(i),
                           all.begin() + static_cast<ptrdiff_t>(end));
        }
    }
    bool is_flat(uint32_t s, uint32_t t) const
    {
        bool same = triangles[s].source == triangles[t].source && triangles[s].source != NONE;
        const auto &c = triangles[s].corner;
        for (uint32_t d : triangles[t].corner)
            if (d != c[0] && d != c[1] && d != c[2])
                return (same && is_nearly_flat(c, d)) || points.coplanar(c[0], c[1], c[2], d);
        return true;
    }
    // Rounded corners leave the plane of their face a little.
    bool is_nearly_flat(const std::array<uint32_t, 3> &c, uint32_t d) const
    {
        struct vec3 o = points.rounded(c[0]), to = vec3_sub(points.rounded(d), o);
        struct vec3 normal =
            vec3_cross(vec3_sub(points.rounded(c[1]), o), vec3_sub(points.rounded(c[2]), o));
        return std::fabs(vec3_dot(normal, to)) <= FLAT * vec3_length(normal) * vec3_length(to);
    }

    void number_faces()
    {
        std::vector<uint32_t> of_root(triangles.size(), NONE);
        number.resize(triangles.size());
        for (uint32_t t = 0; t < triangles.size(); t++) {
            uint32_t &n = of_root[faces.find(t)];
            if (n == NONE)
                n = face_count++;
            number[t] = n;
        }
    }

    void meet(uint32_t corner, uint32_t neighbour)
    {
        corner_info &c = corners[corner];
        if (c.edges < 2)
            c.neighbours[c.edges] = neighbour;
        c.edges++;
    }
    bool is_needless(uint32_t corner)
    {
        corner_info &c = corners[corner];
        if (c.needless < 0)
            c.needless = c.edges == 0 || (c.edges == 2 && points.collinear(c.neighbours[0], corner,
                                                                           c.neighbours[1]));
        return c.needless;
    }

    // False when a face is bent so that its outline seen along the axis crosses itself.
    bool cut_anew(std::vector<uint8_t> stale, std::vector<triangle> *out)
    {
        std::sort(outline.begin(), outline.end(), [&](const side &a, const side &b) {
            return std::tie(number[a.triangle], a.triangle) <
                   std::tie(number[b.triangle], b.triangle);
        });
        for (size_t i = 0; i < outline.size();) {
            uint32_t face = number[outline[i].triangle];
            if (!stale[face]) {
                i++;
                continue;
            }
            overlay plane(points, triangles[outline[i].triangle].corner);
            for (; i < outline.size() && number[outline[i].triangle] == face; i++)
                if (!is_needless(outline[i].from))
                    plane.add(outline[i].from, end_of(outline[i]), {{1, 0}});
            size_t begin = out->size();
            plane.cut(face, out);
            if (begin == out->size() || plane.points_made() > 0)
                return false;
            for (; begin < out->size(); begin++)
                if ((*out)[begin].weight.of[0] != 1)
                    return false;
            stale[face] = false;
        }
        return std::find(stale.begin(), stale.end(), true) == stale.end();
    }
    uint32_t end_of(const side &s)
    {
        uint32_t last = s.from, at = s.to;
        while (is_needless(at)) {
            const corner_info &c = corners[at];
            uint32_t next = c.neighbours[c.neighbours[0] == last];
            last = at;
            at = next;
        }
        return at;
    }

    point_table &points;
    const std::vector<triangle> &triangles;
    sets faces;
    std::vector<uint32_t> number; // of the face of each triangle
    uint32_t face_count = 0;
    std::vector<side> outline; // all edges between faces
    std::vector<corner_info> corners;
};
} // namespace arrangement
