// clip_effort.hpp - how long Clipper will work, and a shorter way where there is one.
//
// Clipper sweeps a line upwards over all corners and visits at each every side that the line cuts:
// the time grows with the square of the corners where many sides lie beside each other, and the
// memory with the crossings, of which n sides may have n^2 / 2.
#pragma once
#include <polyclipping/clipper.hpp>
#include <vector>

namespace clip
{
// Some seconds. Where inside is what an odd number of paths contain, each crossing is a corner of
// the result, to be triangulated and drawn.
constexpr double CROSSINGS_MOST = 1 << 20, CROSSINGS_MOST_ODD = 1 << 18;
// How often sides cross, by a sample; 0 where it cannot be more than `least`.
double crossing_count(const std::vector<const ClipperLib::Paths *> &shapes, double least);
void check_crossings(const ClipperLib::Paths &a, const ClipperLib::Paths &b, double most);
// Is it much quicker to sweep to the right? Refuses what takes too long either way. False whenever
// Clipper is quick anyway, so that roundings are OpenSCAD's.
bool better_sideways(const ClipperLib::Paths &a, const ClipperLib::Paths &b);
// Exchanges x and y and keeps the paths' directions.
void turn_sideways(ClipperLib::Paths *paths);
} // namespace clip
