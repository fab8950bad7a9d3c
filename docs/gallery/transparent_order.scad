// Title: What stands behind glass
// Issues: 1390 4065 4259
// View: --camera=0,0,8,68,0,20,150
// Ours: --transparency=sorted
// The ball stands before the pane in the file at the left, after it at the right. OpenSCAD draws in
// the order of the file, so that the right one is hidden by glass.
module ball() translate([0, 10, 8]) sphere(r = 6, $fn = 40);
module pane() color("deepskyblue", 0.4) translate([-9, -2, 0]) cube([18, 2, 18]);
translate([-14, 0, 0]) { ball(); pane(); }
translate([14, 0, 0]) { pane(); ball(); }
