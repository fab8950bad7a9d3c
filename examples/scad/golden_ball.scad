// A ball with round windows, spread evenly by turning each one by the golden angle.

/* [Ball] */
radius = 30; // [10:60]
wall = 2.5; // [1:0.5:8]
windows = 110; // [10:300]
// share of the surface that is open
open = 0.62; // [0.2:0.02:0.8]

/* [Core] */
core = 17; // [0:50]

/* [Hidden] */
golden_angle = 180 * (3 - sqrt(5));
// n windows of radius w cover n w^2 / (4 r^2) of the sphere
window = radius * sqrt(4 * open / windows);

difference() {
  color("SteelBlue") sphere(radius, $fn = 96);
  color("LightSteelBlue") sphere(radius - wall, $fn = 96);
  color("White") for (i = [0:windows - 1])
    let (z = 1 - (2 * i + 1) / windows)
      rotate([0, acos(z), i * golden_angle])
        cylinder(h = radius * 1.1, r1 = window * 0.5, r2 = window * 1.02, $fn = 24);
}
color("Gold") sphere(core, $fn = 64);
