// A Menger sponge, cut across its diagonal: the holes of a cube of cubes make six-pointed stars.

/* [Sponge] */
size = 81; // [27:27:162]
level = 3; // [1, 2, 3]

/* [Cut] */
cut = true;
// distance of the cut from the centre
offset = 0; // [-60:60]

/* [Hidden] */
body = [0.27, 0.48, 0.56];
inside = [0.95, 0.72, 0.36];

// square tunnels of one size along z; those inside a wider tunnel are left out
module tunnels(l) {
  n = pow(3, l - 1);
  step = size / n;
  for (x = [0:n - 1], y = [0:n - 1])
    if (l == 1 || !in_wider(x, y, l - 1))
      translate([(x + 0.5) * step - size / 2, (y + 0.5) * step - size / 2, 0])
        cube([step / 3, step / 3, size + 2], center = true);
}
function in_wider(x, y, l) = l > 0 &&
  ((x % 3 == 1 && y % 3 == 1) || in_wider(floor(x / 3), floor(y / 3), l - 1));

difference() {
  color(body) cube(size, center = true);
  color(body * 0.75) for (l = [1:level]) {
    tunnels(l);
    rotate([90, 0, 0]) tunnels(l);
    rotate([0, 90, 0]) tunnels(l);
  }
  if (cut) color(inside)
    rotate([0, acos(1 / sqrt(3)), -45]) translate([0, 0, size + offset])
      cube(2 * size, center = true);
}
