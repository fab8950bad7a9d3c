// A pencil cup with honeycomb walls: six flat walls, each cut by a grid of six-sided cylinders.

/* [Cup] */
// between opposite walls
width = 70; // [40:120]
height = 90; // [40:150]
wall = 3; // [1.5:0.5:6]

/* [Comb] */
cell = 7.5; // [4:0.5:20]
gap = 1.8; // [1:0.2:5]

/* [Pencils] */
pencils = true;

/* [Hidden] */
corner = width / sqrt(3); // outer radius of the hexagon
row = (cell + gap) * sqrt(3) / 2;
rows = floor((height - 14 - cell) / row);
columns = ceil(corner / 2 / (cell + gap));

module comb() // cuts one wall, which stands at x = width / 2
  for (j = [0:rows], i = [-columns:columns])
    let (y = (i + (j % 2) / 2) * (cell + gap), z = 8 + cell / 2 + j * row)
      if (abs(y) + cell / 2 < corner / 2 - 2.5)
        translate([width / 2 - wall - 1, y, z]) rotate([0, 90, 0])
          cylinder(h = wall + 2, r = cell / sqrt(3), $fn = 6);

module pencil(length, paint) {
  color(paint) cylinder(h = length - 12, r = 4, $fn = 6);
  translate([0, 0, length - 12]) {
    color("BurlyWood") cylinder(h = 9, r1 = 3.8, r2 = 1.2, $fn = 32);
    color(paint) translate([0, 0, 9]) cylinder(h = 3, r1 = 1.2, r2 = 0.2, $fn = 16);
  }
}

color([0.96, 0.62, 0.16]) difference() {
  cylinder(h = height, r = corner, $fn = 6);
  translate([0, 0, wall]) cylinder(h = height, r = corner - wall * 2 / sqrt(3), $fn = 6);
  for (a = [30:60:330]) rotate(a) comb();
}
if (pencils) {
  translate([6, 14, wall]) rotate([9, 10, 0]) pencil(140, "Crimson");
  translate([-12, -4, wall]) rotate([3, -9, 0]) pencil(150, "RoyalBlue");
  translate([8, -12, wall]) rotate([-8, 5, 0]) pencil(128, "SeaGreen");
}
