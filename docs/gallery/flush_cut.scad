// Title: A cut that ends in the face it starts from
// Issues: 379 485 2029 3322
// View: --camera=0,0,6,50,0,25,150
// The pocket's floor aside, every face of the cutter lies in a face of the block. The preview shows
// specks of both, other ones in each view; the usual advice is to make the cutter a little longer.
difference() {
    union() {
        cylinder(h = 6, r = 24, $fn = 48);
        translate([0, 0, 6]) cylinder(h = 6, r1 = 24, r2 = 20, $fn = 48);
    }
    cylinder(h = 12, r = 12, $fn = 48);
    translate([-24, -5, 8]) cube([48, 10, 4]);
}
