// Title: Walls vanish where convexity was not guessed
// Issues: 2372 2592 3301 5060
// View: --camera=0,0,10,60,0,30,150
// A ring extruded from an outline, with bores through it. Without a convexity the preview expects
// rays to pass one wall only, and draws the others by chance.
difference() {
    linear_extrude(20) difference() {
        circle(r = 24, $fn = 8);
        circle(r = 18, $fn = 8);
    }
    for (a = [0, 90]) translate([0, 0, 10]) rotate([90, 0, a])
        cylinder(h = 60, r = 6, center = true, $fn = 24);
}
