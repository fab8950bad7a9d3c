// boolean_planes.hpp - faces that were meant to lie in one plane are put into it.
//
// The corners of a turned cube are rounded, so that the face of another that should coincide with
// one of its faces crosses it somewhere, at an angle near zero. Cut along each other, such faces
// leave slivers, and these more slivers in the next boolean. So triangles that touch and lie in one
// plane within a tolerance get one: their corners move into it, exactly, by less than the
// tolerance.
#pragma once
#include "geom/boolean_exact.hpp"

#include <algorithm>
#include <cmath>

namespace arrangement
{
class common_planes
{
  public:
    common_planes(point_table *table, const std::vector<triangle> &all, double distance)
        : points(*table), triangles(all), tolerance(distance), planes(all.size()),
          leader(all.size(), NONE), matters(all.size())
    {
    }

    // `pairs` are of triangles that may touch.
    void align(const std::vector<std::pair<uint32_t, uint32_t>> &pairs)
    {
        for (auto [s, t] : pairs)
            if (are_flat(s, t))
                planes.join(s, t);
        for (auto [s, t] : pairs)
            if (planes.find(s) == planes.find(t) && !fit(s, t))
                matters[planes.find(s)] = true;
        choose_leaders();
        std::vector<std::vector<uint32_t>> met(points.size()); // leaders at each corner
        for (uint32_t t = 0; t < triangles.size(); t++)
            if (leader[planes.find(t)] != NONE)
                for (uint32_t c : triangles[t].corner)
                    met[c].push_back(leader[planes.find(t)]);
        std::vector<std::pair<uint32_t, exact::Point_3>> moves; // after all planes are known
        for (uint32_t c = 0; c < met.size(); c++)
            if (!met[c].empty())
                place(c, &met[c], &moves);
        for (const auto &[c, p] : moves)
            points.move(c, p);
    }

  private:
    struct vec3 between(uint32_t from, uint32_t to) const
    {
        return vec3_sub(points.rounded(to), points.rounded(from));
    }
    struct vec3 normal(uint32_t t) const // twice the area long
    {
        const auto &c = triangles[t].corner;
        return vec3_cross(between(c[0], c[1]), between(c[0], c[2]));
    }
    double height(uint32_t t) const // over the longest edge
    {
        const auto &c = triangles[t].corner;
        double longest =
            std::max({vec3_length(between(c[0], c[1])), vec3_length(between(c[1], c[2])),
                      vec3_length(between(c[2], c[0]))});
        return vec3_length(normal(t)) / longest;
    }
    // The smaller the triangle, the less is its plane to be relied upon far away from it.
    bool is_in_plane(uint32_t corner, uint32_t t) const
    {
        struct vec3 to = between(triangles[t].corner[0], corner);
        double off = std::fabs(vec3_dot(vec3_normalized(normal(t)), to));
        return off <= tolerance / 4 * (1 + vec3_length(to) / height(t));
    }
    bool are_flat(uint32_t s, uint32_t t) const
    {
        if (height(s) < height(t))
            std::swap(s, t);
        const auto &c = triangles[t].corner;
        return height(t) > SLIM * tolerance &&
               std::all_of(c.begin(), c.end(), [&](uint32_t i) { return is_in_plane(i, s); });
    }

    // Whether two triangles of a plane lie side by side, however bent their common edge may be.
    bool fit(uint32_t s, uint32_t t) const
    {
        const auto &a = triangles[s].corner, &b = triangles[t].corner;
        std::vector<uint32_t> common;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
        if (common.size() < 2)
            return of_one_operand(s, t) && (lies_beyond(s, t, common) || lies_beyond(t, s, common));
        struct vec3 n = normal(s), along = between(common[0], common[1]);
        double side[2];
        for (int i = 0; i < 2; i++)
            for (uint32_t c : i ? b : a)
                if (c != common[0] && c != common[1])
                    side[i] = vec3_dot(n, vec3_cross(along, between(common[0], c)));
        return (side[0] < 0) != (side[1] < 0);
    }

    bool of_one_operand(uint32_t s, uint32_t t) const
    {
        const winding &a = triangles[s].weight, &b = triangles[t].weight;
        return (a.of[0] == 0 && b.of[0] == 0) || (a.of[1] == 0 && b.of[1] == 0);
    }
    // Whether the line of an edge of s has all of t clearly on its other side, but for a corner
    // that both share.
    bool lies_beyond(uint32_t s, uint32_t t, const std::vector<uint32_t> &common) const
    {
        const auto &a = triangles[s].corner, &b = triangles[t].corner;
        struct vec3 n = normal(s);
        for (unsigned i = 0; i < 3; i++) {
            uint32_t from = a[i], to = a[(i + 1) % 3];
            if (!common.empty() && common[0] == a[(i + 2) % 3])
                continue;
            struct vec3 inward = vec3_normalized(vec3_cross(n, between(from, to)));
            if (std::all_of(b.begin(), b.end(), [&](uint32_t c) {
                    return (!common.empty() && c == common[0]) ||
                           vec3_dot(inward, between(from, c)) < -SLIM * tolerance;
                }))
                return true;
        }
        return false;
    }

    // The largest triangle says where the plane is.
    void choose_leaders()
    {
        for (uint32_t t = 0; t < triangles.size(); t++) {
            uint32_t root = planes.find(t);
            if (matters[root] && (leader[root] == NONE || height(t) > height(leader[root])))
                leader[root] = t;
        }
    }

    // With short numbers, so that exact numbers made of it stay short.
    exact::Plane_3 plane(uint32_t t) const
    {
        struct vec3 n = vec3_normalized(normal(t)), p = points.rounded(triangles[t].corner[0]);
        n = {shortened(n.x), shortened(n.y), shortened(n.z)};
        return {n.x, n.y, n.z, -vec3_dot(n, p)};
    }
    static double shortened(double x)
    {
        return std::ldexp(std::round(std::ldexp(x, BITS)), -BITS);
    }

    // To the nearest point on up to three planes, the best known ones first. Planes that would move
    // it far are all but parallel to what the others have in common.
    void place(uint32_t corner, std::vector<uint32_t> *leaders,
               std::vector<std::pair<uint32_t, exact::Point_3>> *moves) const
    {
        std::sort(leaders->begin(), leaders->end());
        leaders->erase(std::unique(leaders->begin(), leaders->end()), leaders->end());
        std::vector<exact::Plane_3> through;
        for (uint32_t t : *leaders)
            through.push_back(plane(t));
        const exact::Point_3 &p = points[corner];
        if (std::all_of(through.begin(), through.end(),
                        [&](const exact::Plane_3 &h) { return h.has_on(p); }))
            return;
        std::vector<exact::Plane_3> chosen;
        exact::Point_3 best = p;
        for (const exact::Plane_3 &h : through) {
            if (chosen.size() == 3)
                break;
            chosen.push_back(h);
            exact::Point_3 moved;
            if (project(p, chosen, &moved) &&
                CGAL::squared_distance(p, moved) <= tolerance * tolerance / 4)
                best = moved;
            else
                chosen.pop_back();
        }
        if (!chosen.empty())
            moves->emplace_back(corner, best);
    }

    // The nearest point is p plus a sum of the normals, whose factors solve a symmetric system.
    static bool project(const exact::Point_3 &p, const std::vector<exact::Plane_3> &through,
                        exact::Point_3 *out)
    {
        size_t n = through.size();
        std::array<std::array<exact::FT, 4>, 3> m; // the last column is the right side
        for (size_t i = 0; i < n; i++) {
            exact::Vector_3 a = through[i].orthogonal_vector();
            for (size_t j = 0; j < n; j++)
                m[i][j] = a * through[j].orthogonal_vector();
            m[i][n] = -(a * (p - CGAL::ORIGIN) + through[i].d());
        }
        for (size_t k = 0; k < n; k++) { // positive definite unless the planes are dependent
            if (m[k][k] == 0)
                return false;
            for (size_t i = 0; i < n; i++) {
                if (i == k)
                    continue;
                exact::FT factor = m[i][k] / m[k][k];
                for (size_t j = k; j <= n; j++)
                    m[i][j] -= factor * m[k][j];
            }
        }
        *out = p;
        for (size_t i = 0; i < n; i++)
            *out = *out + m[i][n] / m[i][i] * through[i].orthogonal_vector();
        return true;
    }

    static constexpr int BITS = 44;   // moves points by much less than the tolerance
    static constexpr double SLIM = 8; // in tolerances: thinner triangles have no plane

    point_table &points;
    const std::vector<triangle> &triangles;
    double tolerance;
    sets planes;
    std::vector<uint32_t> leader; // of the set that a triangle stands for
    std::vector<uint8_t> matters; // whether two triangles of it may overlap
};
} // namespace arrangement
