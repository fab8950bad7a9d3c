// Title: Several parts cut by one plane
// Issues: 1662
// View: --camera=0,0,10,60,0,20,130
// Each part is cut on its own, so that it keeps its colour, and all by the same plane. In the preview
// the last one colours the sections of all.
module half() difference() {
    children();
    translate([-50, -100, -50]) cube(100);
}
color("gold") half() difference() {
    cylinder(h = 20, r = 20, $fn = 40);
    translate([0, 0, -1]) cylinder(h = 22, r = 14, $fn = 40);
}
color("seagreen") half() difference() {
    cylinder(h = 20, r = 14, $fn = 40);
    translate([0, 0, -1]) cylinder(h = 22, r = 8, $fn = 40);
}
color("steelblue") half() translate([0, 0, -4]) cylinder(h = 28, r = 8, $fn = 40);
