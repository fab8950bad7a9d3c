// Title: Twisted and hollow
// Issues: 3663 4080
// View: --camera=0,0,20,65,0,30,190
// The same with a twist: a bore through a hollow column.
difference() {
    linear_extrude(height = 40, twist = 60, slices = 30) difference() {
        square(28, center = true);
        square(22, center = true);
    }
    translate([0, 0, 20]) rotate([90, 0, 20]) cylinder(h = 60, r = 7, center = true, $fn = 32);
}
