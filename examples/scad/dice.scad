// Two dice. The corners come from intersecting a cube with a sphere, the pips are subtracted:
// what cuts gives its colour to the cut.

/* [Die] */
// edge length
size = 16; // [8:40]
// 0: sharp corners, 1: the sphere touches the edges
roundness = 0.75; // [0:0.05:1]

/* [Pips] */
// radius
pip = 1.7; // [0.5:0.1:3]
// distance between pips
spread = 4.2; // [2:0.1:8]
// facets of a pip
smooth = 24; // [8:4:48]

/* [Hidden] */
ivory = [0.97, 0.95, 0.88];
ink = [0.15, 0.17, 0.22];
red = [0.78, 0.12, 0.16];

function places(n) = concat(
  n % 2 == 1 ? [[0, 0]] : [],
  n > 1 ? [[-1, -1], [1, 1]] : [],
  n > 3 ? [[-1, 1], [1, -1]] : [],
  n > 5 ? [[-1, 0], [1, 0]] : []);

module face(n)
  for (p = places(n)) translate([p.x * spread, p.y * spread, size / 2 + pip * 0.35])
    sphere(pip, $fn = smooth);

module die(body, pips) {
  turns = [[0, 0, 0], [0, 90, 0], [-90, 0, 0], [90, 0, 0], [0, -90, 0], [180, 0, 0]];
  difference() {
    color(body) intersection() {
      cube(size, center = true);
      sphere(size * (0.87 - 0.155 * roundness), $fn = 96);
    }
    color(pips) for (n = [1:6]) rotate(turns[n - 1]) face(n);
  }
}

rotate(12) die(ivory, ink);
translate([size * 1.35, size * 0.35, 0]) rotate(-35) rotate([90, 0, 90]) die(red, ivory);
