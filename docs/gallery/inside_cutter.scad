// Title: The eye inside what is subtracted
// Issues: 2408 3510 4748
// View: --camera=10,-10,8,70,0,35,90
// A large cube takes a quarter away. From within that cube the preview cuts with what lies in front
// of the eye only: nothing.
difference() {
    union() {
        sphere(r = 18, $fn = 40);
        cylinder(h = 44, r = 5, center = true, $fn = 24);
    }
    sphere(r = 14, $fn = 40);
    translate([0, -400, -200]) cube([400, 400, 400]);
}
