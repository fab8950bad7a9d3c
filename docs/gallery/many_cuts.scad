// Title: A thousand differences
// Issues: 1656 1899
// View: --camera=0,0,0,45,0,25,480
// A grille of 1,000 holes. The preview draws them one after the other, in every frame; the mesh takes
// longer still.
difference() {
    cube([164, 104, 4], center = true);
    for (x = [-78 : 4 : 78], y = [-48 : 4 : 48]) translate([x, y, 0])
        cylinder(h = 6, r = 1.4, center = true, $fn = 12);
}
