// Title: Rounding what is not convex
// Issues: 953 6297
// View: --camera=0,0,8,55,0,25,170
// A Minkowski sum of a bracket and a ball. OpenSCAD cuts the bracket into convex pieces and unites
// the sums, for the preview too.
minkowski() {
    difference() {
        cube([50, 30, 16], center = true);
        translate([0, 0, 4]) cube([42, 22, 16], center = true);
        cylinder(h = 40, r = 6, center = true, $fn = 24);
    }
    sphere(r = 2, $fn = 16);
}
