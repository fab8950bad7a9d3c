// Title: Glass that hides its own back
// Issues: 1496 4259
// View: --camera=0,0,12,60,0,20,150
// Ours: --transparency=sorted
// The faces of one object are drawn in the order of its mesh: where a near one comes first, those
// behind it are missing, and a seam shows between the two.
color("mediumseagreen", 0.5) rotate_extrude($fn = 48, convexity = 4)
    polygon([[0, 0], [16, 0], [20, 26], [17, 26], [13, 3], [0, 3]]);
color("crimson", 0.5) translate([0, 0, 13]) sphere(r = 8, $fn = 30);
