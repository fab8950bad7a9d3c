// Title: A panel of eleven holes
// Issues: 3628
// View: --camera=55,12,0,45,0,20,330
// Holes with two flat sides, and no more of them than a row of switches has: with each one the
// preview becomes slower, and at eleven it gives up.
difference() {
    cube([110, 24, 3]);
    for (i = [0 : 10]) translate([5 + 10 * i, 12, -1]) intersection() {
        cylinder(h = 5, r = 4, $fn = 100);
        translate([-3, -5, 0]) cube([6, 10, 5]);
    }
}
