// boolean_faces.hpp - flat faces of a result: joined, without needless points, cut anew.
#pragma once
#include "geom/boolean_overlay.hpp"

#include <algorithm>
#include <tuple>

namespace arrangement
{
// Rounding moves corners, so that planes that should be one are two that cross somewhere, with
// faces and gaps thinner than numbers can tell between them. If these stayed, each further boolean
// would cut all of them along each other. Therefore triangles that share an edge and lie in one
// plane within a tolerance form one face, on whichever side of them the solid is, and the face is
// cut anew within its outline: what lies on top of each other with opposite sides is gone then.
// Outlines stay as they are but for points on straight lines, so that the result stays closed.
class flat_faces
{
  public:
    flat_faces(point_table &table, const std::vector<triangle> &all, double distance)
        : points(table), triangles(all), tolerance(distance), corners(table.size())
    {
        sets same(triangles.size());
        join_neighbours(&same);
        std::vector<uint32_t> of_root(triangles.size(), NONE);
        for (uint32_t t = 0; t < triangles.size(); t++) {
            uint32_t &n = of_root[same.find(t)];
            if (n == NONE) {
                n = static_cast<uint32_t>(faces.size());
                faces.emplace_back();
            }
            faces[n].members.push_back(t);
        }
        for (face &f : faces)
            f.outline = outline_of(f);
    }

    // *numbers: of the flat face of each triangle returned.
    std::vector<triangle> cut(std::vector<uint32_t> *numbers)
    {
        std::vector<triangle> out;
        for (int round = ROUNDS; round-- > 0;) {
            out.clear();
            numbers->clear();
            if (round == 0)
                for (face &f : faces)
                    keep(&f);
            find_needless();
            bool done = true;
            for (uint32_t f = 0; f < faces.size(); f++) {
                done &= add(&faces[f], &out);
                number(f, out, numbers);
            }
            if (done)
                break;
        }
        return out;
    }
    uint32_t number_count() const
    {
        return 2 * static_cast<uint32_t>(faces.size());
    }

  private:
    // A face that cannot be cut anew is kept with all its corners, which its neighbours must keep
    // too, so that all is done again. After a few rounds everything is kept.
    static constexpr int ROUNDS = 4;

    struct side { // an edge of a triangle
        edge ends;
        uint32_t triangle;
        bool operator<(const side &s) const
        {
            return std::tie(ends, triangle) < std::tie(s.ends, s.triangle);
        }
    };
    struct corner_info {
        uint32_t neighbours[2] = {NONE, NONE}; // along outlines
        uint32_t edges = 0;                    // of outlines that end here
        bool kept = false, needless = false;
    };
    struct face {
        std::vector<uint32_t> members;
        // How often more each edge is run through upwards in numbers than downwards.
        std::vector<std::pair<edge, int>> outline;
        bool kept = false;
    };

    struct vec3 at(uint32_t corner) const
    {
        return points.rounded(corner);
    }
    struct vec3 between(uint32_t from, uint32_t to) const
    {
        return vec3_sub(at(to), at(from));
    }
    struct vec3 normal(const std::array<uint32_t, 3> &c) const // twice the area long
    {
        return vec3_cross(between(c[0], c[1]), between(c[0], c[2]));
    }
    edge longest(uint32_t t) const
    {
        const auto &c = triangles[t].corner;
        edge best;
        double most = -1;
        for (unsigned i = 0; i < 3; i++) {
            edge e = std::minmax(c[i], c[(i + 1) % 3]);
            double length = vec3_length(between(e.first, e.second));
            if (length > most) {
                most = length;
                best = e;
            }
        }
        return best;
    }
    double height(uint32_t t) const // over the longest edge
    {
        edge e = longest(t);
        return vec3_length(normal(triangles[t].corner)) / vec3_length(between(e.first, e.second));
    }
    // The smaller the triangle, the less is its plane to be relied upon far away from it.
    bool is_in_plane(uint32_t corner, uint32_t t, double within) const
    {
        struct vec3 to = between(triangles[t].corner[0], corner);
        double off = std::fabs(vec3_dot(vec3_normalized(normal(triangles[t].corner)), to));
        return off <= within * (1 + vec3_length(to) / height(t));
    }

    void join_neighbours(sets *same) const
    {
        std::vector<side> all;
        for (uint32_t t = 0; t < triangles.size(); t++)
            for (unsigned i = 0; i < 3; i++) {
                const auto &c = triangles[t].corner;
                all.push_back({std::minmax(c[i], c[(i + 1) % 3]), t});
            }
        std::sort(all.begin(), all.end());
        for (size_t i = 0, end; i < all.size(); i = end) {
            for (end = i + 1; end < all.size() && all[end].ends == all[i].ends;)
                end++;
            for (size_t a = i; a < end; a++)
                for (size_t b = a + 1; b < end; b++)
                    if (are_flat(all[a].triangle, all[b].triangle, all[i].ends))
                        same->join(all[a].triangle, all[b].triangle);
        }
    }
    // A triangle that is all edge has no plane: it joins what its longest edge belongs to.
    bool are_flat(uint32_t s, uint32_t t, const edge &common) const
    {
        if (height(s) < height(t))
            std::swap(s, t);
        if (height(t) <= tolerance)
            return longest(t) == common;
        const auto &c = triangles[t].corner;
        return std::all_of(c.begin(), c.end(),
                           [&](uint32_t corner) { return is_in_plane(corner, s, tolerance); });
    }

    std::vector<std::pair<edge, int>> outline_of(const face &f) const
    {
        std::vector<std::pair<edge, int>> sides, outline;
        for (uint32_t t : f.members)
            for (unsigned i = 0; i < 3; i++) {
                uint32_t from = triangles[t].corner[i], to = triangles[t].corner[(i + 1) % 3];
                sides.emplace_back(std::minmax(from, to), from < to ? 1 : -1);
            }
        std::sort(sides.begin(), sides.end());
        for (const auto &[ends, turn] : sides) {
            if (outline.empty() || outline.back().first != ends)
                outline.emplace_back(ends, 0);
            outline.back().second += turn;
        }
        outline.erase(std::remove_if(outline.begin(), outline.end(),
                                     [](const auto &s) { return s.second == 0; }),
                      outline.end());
        return outline;
    }

    void find_needless()
    {
        std::vector<edge> all;
        for (const face &f : faces)
            for (const auto &s : f.outline)
                all.push_back(s.first);
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        for (corner_info &c : corners)
            c.edges = 0;
        for (const edge &e : all) {
            meet(e.first, e.second);
            meet(e.second, e.first);
        }
        for (uint32_t c = 0; c < corners.size(); c++)
            corners[c].needless = corners[c].edges == 2 && !corners[c].kept && is_straight(c);
    }
    void meet(uint32_t corner, uint32_t neighbour)
    {
        corner_info &c = corners[corner];
        if (c.edges < 2)
            c.neighbours[c.edges] = neighbour;
        c.edges++;
    }
    bool is_straight(uint32_t corner) const
    {
        struct vec3 a = between(corner, corners[corner].neighbours[0]);
        struct vec3 b = between(corner, corners[corner].neighbours[1]);
        return vec3_dot(a, b) < 0 &&
               vec3_length(vec3_cross(a, b)) <= tolerance * vec3_length(vec3_sub(a, b));
    }

    void keep(face *f)
    {
        f->kept = true;
        for (uint32_t t : f->members)
            for (uint32_t c : triangles[t].corner)
                corners[c].kept = true;
    }

    // A disc without needless corners and without points inside can stay as it is.
    bool is_good(const face &f) const
    {
        if (f.members.size() + 2 != f.outline.size())
            return false;
        return std::none_of(f.outline.begin(), f.outline.end(), [&](const auto &s) {
            return corners[s.first.first].needless || corners[s.first.second].needless;
        });
    }

    // False when the face had to be kept.
    bool add(face *f, std::vector<triangle> *out)
    {
        size_t begin = out->size();
        bool fails = false;
        if (!f->kept && !is_good(*f)) {
            if (cut_anew(*f, out))
                return true;
            out->resize(begin);
            keep(f);
            fails = true;
        }
        for (uint32_t t : f->members)
            out->push_back(triangles[t]);
        return !fails;
    }

    bool cut_anew(const face &f, std::vector<triangle> *out)
    {
        if (f.outline.empty())
            return true;
        uint32_t main = main_member(f);
        overlay plane(points, triangles[main].corner);
        for (const auto &[ends, turn] : f.outline) {
            add_line(&plane, ends.first, ends.second, turn);
            add_line(&plane, ends.second, ends.first, -turn);
            if (!is_in_plane(ends.first, main, SPREAD * tolerance))
                return false;
        }
        size_t begin = out->size();
        plane.cut(out);
        if (plane.points_made() > 0 || begin == out->size())
            return false;
        for (; begin < out->size(); begin++) {
            triangle &t = (*out)[begin];
            if (std::abs(t.weight.of[0]) != 1)
                return false;
            if (t.weight.of[0] < 0)
                std::swap(t.corner[1], t.corner[2]);
        }
        return true;
    }
    uint32_t main_member(const face &f) const
    {
        return *std::max_element(f.members.begin(), f.members.end(),
                                 [&](uint32_t s, uint32_t t) { return height(s) < height(t); });
    }
    // Once for each way along needless corners, from its end with the smaller number.
    void add_line(overlay *plane, uint32_t from, uint32_t to, int turn) const
    {
        if (corners[from].needless)
            return;
        for (uint32_t last = from; corners[to].needless;) {
            const corner_info &c = corners[to];
            uint32_t next = c.neighbours[c.neighbours[0] == last];
            last = to;
            to = next;
        }
        if (from < to)
            plane->add(from, to, {{turn, 0}});
    }

    // What looks the other way is another face.
    void number(uint32_t f, const std::vector<triangle> &out, std::vector<uint32_t> *numbers) const
    {
        struct vec3 n = normal(triangles[main_member(faces[f])].corner);
        while (numbers->size() < out.size()) {
            const auto &c = out[numbers->size()].corner;
            numbers->push_back(2 * f + (vec3_dot(n, normal(c)) < 0));
        }
    }

    static constexpr double SPREAD = 16; // more than that, and neighbours have added up to a bend

    point_table &points;
    const std::vector<triangle> &triangles;
    double tolerance;
    std::vector<face> faces;
    std::vector<corner_info> corners;
};
} // namespace arrangement
