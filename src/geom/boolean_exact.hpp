// boolean_exact.hpp - exact points by number, and the triangles of an arrangement over them.
#pragma once
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

extern "C" { // below the headers of the system, which do not bear it
#include "base/vec.h"
}

namespace arrangement
{
using inexact = CGAL::Exact_predicates_inexact_constructions_kernel; // for points of the operands
using exact = CGAL::Exact_predicates_exact_constructions_kernel;     // for points made of them

constexpr uint32_t NONE = UINT32_MAX;

// How often the two operands wind around a place; as the weight of a triangle, by how much more
// they do behind it than in front of it.
struct winding {
    std::array<int32_t, 2> of = {0, 0};

    bool operator==(const winding &w) const
    {
        return of == w.of;
    }
    winding operator+(const winding &w) const
    {
        return {{of[0] + w.of[0], of[1] + w.of[1]}};
    }
    winding operator-() const
    {
        return {{-of[0], -of[1]}};
    }
    winding operator-(const winding &w) const
    {
        return *this + -w;
    }
    winding &operator+=(const winding &w)
    {
        return *this = *this + w;
    }
};

// In front is the side that sees the corners counter-clockwise.
struct triangle {
    std::array<uint32_t, 3> corner;
    winding weight;
};

using edge = std::pair<uint32_t, uint32_t>;

// Points without repetition: first those of the operands, then those made of them.
class point_table
{
  public:
    explicit point_table(std::vector<struct vec3> operands)
        : given(std::move(operands)), moved(given.size())
    {
        points.reserve(given.size());
        for (const struct vec3 &p : given)
            points.emplace_back(p.x, p.y, p.z);
    }
    const exact::Point_3 &operator[](uint32_t number) const
    {
        return points[number];
    }
    bool is_given(uint32_t number) const // in doubles, exactly
    {
        return number < given.size() && !moved[number];
    }
    void move(uint32_t number, const exact::Point_3 &to)
    {
        points[number] = to;
        moved[number] = 1;
    }
    inexact::Point_3 given_point(uint32_t number) const
    {
        return {given[number].x, given[number].y, given[number].z};
    }
    size_t size() const
    {
        return points.size();
    }
    // Numbers given to points made later are compared with the operands' points met so far.
    void meet(uint32_t number)
    {
        numbers.emplace(points[number], number);
    }
    uint32_t number_of(const exact::Point_3 &p)
    {
        auto [at, added] = numbers.emplace(p, static_cast<uint32_t>(points.size()));
        if (added)
            points.push_back(p);
        return at->second;
    }
    struct vec3 rounded(uint32_t number) const
    {
        if (is_given(number))
            return given[number];
        const exact::Point_3 &p = points[number];
        p.exact(); // or else the numbers below were good to five digits only
        return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
    }

  private:
    std::vector<struct vec3> given;
    std::vector<uint8_t> moved; // of the given ones
    std::vector<exact::Point_3> points;
    std::map<exact::Point_3, uint32_t, exact::Less_xyz_3> numbers;
};

// Disjoint sets of numbers.
class sets
{
  public:
    explicit sets(size_t count) : parent(count)
    {
        std::iota(parent.begin(), parent.end(), 0U);
    }
    size_t size() const
    {
        return parent.size();
    }
    uint32_t find(uint32_t i)
    {
        while (parent[i] != i)
            i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(uint32_t i, uint32_t j)
    {
        parent[find(i)] = find(j);
    }

  private:
    std::vector<uint32_t> parent;
};
} // namespace arrangement
