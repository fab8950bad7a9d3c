// Title: The price of render()
// Issues: 3322 4325
// View: --camera=0,0,0,60,0,25,190
// The advice against all of the above is to wrap the difference in render(), which has the mesh
// computed whenever the file has changed.
render() difference() {
    sphere(r = 26, $fn = 32);
    for (a = [0 : 45 : 135], b = [0 : 60 : 120]) rotate([a, 0, b])
        cylinder(h = 60, r = 4, center = true, $fn = 12);
}
