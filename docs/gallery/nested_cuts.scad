// Title: Differences inside differences
// Issues: 3535
// View: --camera=0,0,0,30,0,10,170
// Each gap between the teeth of the ratchet is a block minus an arc minus the hub. The preview gives
// up; a reporter's snail wheel kept it busy without an end.
difference() {
    cylinder(h = 6, r = 28, center = true, $fn = 72);
    for (i = [0 : 11]) rotate(30 * i) difference() {
        translate([14, 0, -5]) cube([20, 9, 10]);
        translate([10, -7, 0]) cylinder(h = 12, r = 17, center = true, $fn = 40);
        cylinder(h = 14, r = 19, center = true, $fn = 40);
    }
    cylinder(h = 20, r = 6, center = true, $fn = 30);
}
