// Title: Beyond the normalisation limit
// Issues: 1988 3504 6554
// View: --camera=0,0,0,45,0,25,290
// A plate minus holes that are intersections. As a sum of products this is 2 to the power of the
// number of holes; the preview gives up with "Normalized tree is growing past 200000 elements" and
// shows nothing.
difference() {
    cube([90, 60, 6], center = true);
    for (x = [-36 : 12 : 36], y = [-20 : 10 : 20]) translate([x, y, 0]) intersection() {
        cylinder(h = 10, r = 4, center = true, $fn = 20);
        cube([5, 10, 10], center = true);
    }
}
