// A spiral staircase: each step is the one before it, turned and lifted, in the next colour.

/* [Stairs] */
steps = 26; // [8:60]
rise = 5; // [3:0.5:8]
turn = 22; // [10:40]
radius = 34; // [20:60]

/* [Rail] */
rail = true;
rail_height = 20; // [10:30]

/* [Hidden] */
pole = 4;
function rainbow(t) = [for (k = [0, 120, 240]) 0.62 + 0.34 * cos(360 * t - k)];

module step() // a wedge of a round plate
  intersection() {
    translate([0, 0, rise - 2]) cylinder(h = 2, r = radius, $fn = 96);
    rotate(-2) translate([0, 0, 1]) cube([radius * 1.5, radius * 1.5, rise]);
    rotate(turn - 88) translate([0, 0, 1]) cube([radius * 1.5, radius * 1.5, rise]);
  }

module baluster() {
  cylinder(h = rail_height, r = 0.7, $fn = 16);
  translate([0, 0, rail_height]) sphere(1.8, $fn = 24);
}

color([0.35, 0.37, 0.42]) {
  cylinder(h = steps * rise + 14, r = pole, $fn = 48);
  translate([0, 0, steps * rise + 14]) sphere(pole * 1.5, $fn = 48);
  translate([0, 0, -3]) cylinder(h = 3, r = radius + 3, $fn = 96);
}
for (i = [0:steps - 1]) translate([0, 0, i * rise]) rotate(i * turn) {
  color(rainbow(i / steps)) step();
  if (rail) color([0.92, 0.92, 0.94])
    rotate(turn / 2) translate([radius - 2, 0, rise]) baluster();
}
