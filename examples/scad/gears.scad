// A planetary gear with herringbone teeth: polyhedra whose points are computed, here from the
// involute of a circle. Turn the sun, the rest follows.

/* [Gears] */
sun_teeth = 15; // [9:3:30]
planet_teeth = 12; // [9:3:24]
planets = 3; // [2, 3]
// size of a tooth: pitch diameter / number of teeth
module_size = 2; // [1:0.25:4]
thickness = 12; // [4:40]
// slant of the teeth
helix = 25; // [0:35]

/* [Motion] */
// of the sun, in degrees
turn = 0; // [0:360]

/* [Hidden] */
pressure = 20;
backlash = 0.12;
ring_teeth = sun_teeth + 2 * planet_teeth;
centre = (sun_teeth + planet_teeth) * module_size / 2;

function involute(base, r) = // polar angle of the involute of a circle at radius r
  r <= base ? 0 : let (a = acos(base / r)) tan(a) * 180 / PI - a;

// one tooth as [radius, angle] from its left foot to its right foot
function tooth(z, addendum, dedendum) =
  let (pitch = z * module_size / 2, base = pitch * cos(pressure),
       foot = pitch - dedendum * module_size, tip = pitch + addendum * module_size,
       half = 90 / z - backlash / pitch * 180 / PI / 2 + involute(base, pitch),
       low = max(foot, base),
       side = [[foot, half], for (k = [0:2]) let (r = low + (tip - low) * k / 2)
         [r, half - involute(base, r)]])
  [for (p = side) [p[0], -p[1]], for (k = [3:-1:0]) side[k]];

function outline(z, addendum, dedendum) =
  [for (i = [0:z - 1], p = tooth(z, addendum, dedendum)) [p[0], p[1] + i * 360 / z]];

// a herringbone of `hand` 1 or -1: both ends are turned against the middle
module gear(z, hand, addendum = 1, dedendum = 1.2, h = thickness) {
  ring = outline(z, addendum, dedendum);
  n = len(ring);
  twist = hand * tan(helix) * h / 2 / (z * module_size / 2) * 180 / PI;
  layers = 4;
  points = [for (k = [0:layers], p = ring)
    let (t = k / layers, a = p[1] - twist * abs(2 * t - 1))
      [p[0] * cos(a), p[0] * sin(a), h * t]];
  sides = [for (k = [0:layers - 1], i = [0:n - 1])
    let (a = k * n + i, b = k * n + (i + 1) % n) for (f = [[a, a + n, b], [b, a + n, b + n]]) f];
  polyhedron(points, concat(sides, [[for (i = [0:n - 1]) i]],
    [[for (i = [n - 1:-1:0]) layers * n + i]]), convexity = z);
}

module bore(r, h = thickness) translate([0, 0, -1]) cylinder(h = h + 2, r = r, $fn = 48);

// the turn that meshes a planet at angle `at` with the sun
function planet_turn(at) =
  at + 180 + ((at - turn) * sun_teeth / 360 - 0.5) * 360 / planet_teeth;
carrier = turn * sun_teeth / (sun_teeth + ring_teeth);

color("Gold") difference() {
  rotate(turn) gear(sun_teeth, 1);
  bore(4);
  rotate(turn) translate([3, -1, -1]) cube([2.5, 2, thickness + 2]);
}
color("IndianRed") for (i = [0:planets - 1]) let (at = carrier + i * 360 / planets)
  translate(centre * [cos(at), sin(at), 0]) difference() {
    rotate(planet_turn(at)) gear(planet_teeth, -1);
    bore(3);
    for (z = [-1, thickness - 2]) translate([0, 0, z]) cylinder(h = 3, r = 6, $fn = 48);
  }
color("SteelBlue") difference() {
  translate([0, 0, -1]) cylinder(h = thickness + 2, r = (ring_teeth / 2 + 4) * module_size, $fn = 128);
  translate([0, 0, -2]) rotate(carrier + (planet_turn(carrier) - carrier) * planet_teeth / ring_teeth)
    gear(ring_teeth, -1, 1.2, 1, thickness + 4);
  for (a = [30:60:330]) rotate(a) translate([(ring_teeth / 2 + 2.6) * module_size, 0, -2]) bore(1.6, thickness + 4);
}
