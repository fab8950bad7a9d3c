// Title: Separate pieces of one extrusion
// Issues: 4669
// View: --camera=22,5,5,60,0,30,130
// One extrusion makes four blocks; one of them is cut. The preview takes more away.
difference() {
    linear_extrude(12) for (i = [0 : 3]) translate([12 * i, 0]) square([8, 14]);
    translate([-4, 3, 4]) cube([8, 8, 12]);
}
