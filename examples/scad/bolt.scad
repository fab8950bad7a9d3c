// A bolt in a nut: one polyhedron makes both threads, and a quarter is cut away to show the fit.

/* [Thread] */
diameter = 16; // [6:30]
pitch = 3; // [1.5:0.25:5]
length = 40; // [20:80]
// play between bolt and nut
play = 0.25; // [0:0.05:0.6]

/* [View] */
section = true;
// how far the nut is screwed on
nut_at = 14; // [2:30]

/* [Hidden] */
sides = 32;
steps = 6; // layers per turn
depth = pitch * 0.54;
across = diameter * 1.65; // flats of head and nut
head = diameter * 0.65;
function groove(t) = // profile over one turn, 0 at the crest and 1 at the root
  let (u = abs(2 * (t - floor(t)) - 1)) min(1, max(0, 1.25 * u - 0.125));

// a column whose radius follows the profile around and up
module thread(r, h) {
  layers = ceil(h / pitch * steps);
  points = [for (k = [0:layers], i = [0:sides - 1])
    let (z = h * k / layers, a = i * 360 / sides, q = r - depth * groove(z / pitch - i / sides))
      [q * cos(a), q * sin(a), z]];
  walls = [for (k = [0:layers - 1], i = [0:sides - 1])
    let (a = k * sides + i, b = k * sides + (i + 1) % sides)
      for (f = [[a, a + sides, b], [b, a + sides, b + sides]]) f];
  polyhedron(points, concat(walls, [[for (i = [0:sides - 1]) i]],
    [[for (i = [sides - 1:-1:0]) layers * sides + i]]), convexity = 10);
}

// a round block with both rims bevelled by b
module bevelled(r, h, b, n = 96) {
  cylinder(h = b, r1 = r - 1.7 * b, r2 = r, $fn = n);
  translate([0, 0, b]) cylinder(h = h - 2 * b, r = r, $fn = n);
  translate([0, 0, h - b]) cylinder(h = b, r1 = r, r2 = r - 1.7 * b, $fn = n);
}

module hexagon(h)
  intersection() {
    cylinder(h = h, r = across / sqrt(3), $fn = 6);
    bevelled(across / sqrt(3), h, across * 0.05);
  }

color("Silver") {
  hexagon(head);
  translate([0, 0, head]) intersection() {
    translate([0, 0, -depth]) thread(diameter / 2, length + depth);
    translate([0, 0, -depth]) bevelled(diameter / 2, length + depth, depth * 0.8);
  }
}
translate([0, 0, head + nut_at]) difference() {
  color("DarkOrange") hexagon(head * 1.1);
  // the same thread, from where the bolt's begins
  color("Gold") translate([0, 0, -nut_at - depth])
    thread(diameter / 2 + play, nut_at + head * 1.1 + pitch + depth);
  if (section) color("Moccasin") rotate(-90) translate([0, 0, -1])
    cube([across, across, head * 1.1 + 2]);
}
