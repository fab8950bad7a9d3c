// A paper lantern: windows are cut through a thin shell with prisms that point outwards, so that
// each opening narrows towards the flame inside.

/* [Lantern] */
sides = 8; // [5:12]
height = 80; // [50:120]
radius = 30; // [20:50]
wall = 2; // [1:0.5:4]

/* [Stars] */
tips = 5; // [4:8]
size = 8; // [3:0.5:14]
rows = 3; // [1:5]

/* [Hidden] */
paper = [0.88, 0.24, 0.22];
trim = [0.42, 0.26, 0.18];
glow = [1.0, 0.86, 0.45];

// a star in the plane x = 1, drawn out to a cone with its point on the z axis
module star(at, r) {
  n = 2 * tips;
  rim = [for (i = [0:n - 1]) let (q = i % 2 == 0 ? r : r * 0.45, a = i * 360 / n + 90)
    [at, q * cos(a), q * sin(a)]];
  polyhedron(concat([[0, 0, 0]], rim),
    concat([for (i = [0:n - 1]) [0, i + 1, (i + 1) % n + 1]], [[for (i = [n:-1:1]) i]]), convexity = 4);
}

module body(r, cut = 0) { // two cones and a belt
  waist = height * 0.28;
  translate([0, 0, -cut]) cylinder(h = waist + cut, r1 = r * 0.62, r2 = r, $fn = sides);
  translate([0, 0, waist]) cylinder(h = height - 2 * waist, r = r, $fn = sides);
  translate([0, 0, height - waist]) cylinder(h = waist + cut, r1 = r, r2 = r * 0.62, $fn = sides);
}

difference() {
  color(paper) body(radius);
  color(glow) body(radius - wall, 0.01);
  color(glow) for (i = [0:sides - 1], k = [0:rows - 1])
    rotate((i + 0.5) * 360 / sides)
      translate([0, 0, height / 2 + (k - (rows - 1) / 2) * height * 0.3])
        star(radius * 1.3, 1.3 * size * (k == (rows - 1) / 2 ? 1 : 0.7));
}
color(trim) {
  translate([0, 0, -4]) cylinder(h = 5, r = radius * 0.7, $fn = sides);
  translate([0, 0, height - 1]) cylinder(h = 5, r = radius * 0.7, $fn = sides);
  translate([0, 0, height + 4]) cylinder(h = 10, r1 = radius * 0.5, r2 = 3, $fn = sides);
  difference() { // the ring it hangs from
    translate([0, 0, height + 19]) rotate([90, 0, 0]) cylinder(h = 3, r = 7, center = true, $fn = 48);
    translate([0, 0, height + 19]) rotate([90, 0, 0]) cylinder(h = 9, r = 4.6, center = true, $fn = 48);
  }
}
color("Ivory") cylinder(h = height * 0.4, r = 6, $fn = 48);
color("Orange") translate([0, 0, height * 0.4 + 7]) {
  sphere(4.5, $fn = 32);
  translate([0, 0, 2]) cylinder(h = 9, r1 = 4, r2 = 0, $fn = 32);
}
