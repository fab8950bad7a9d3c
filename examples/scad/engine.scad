// A one-cylinder engine, cut open: the housing loses a quarter, the moving parts stay whole.

/* [Motion] */
// of the crank, in degrees
crank = 50; // [0:360]

/* [Engine] */
bore = 40; // [30:60]
stroke = 36; // [20:50]
fins = 9; // [4:14]

/* [View] */
section = true;

/* [Hidden] */
throw = stroke / 2;
rod = stroke * 1.75;
wall = 5;
top = throw + rod + 16;
pin = [throw * sin(crank), throw * cos(crank)];
piston = pin.y + sqrt(rod * rod - pin.x * pin.x);
lean = asin(pin.x / rod);
iron = [0.50, 0.54, 0.60];
cut = [0.85, 0.30, 0.22];
steel = [0.86, 0.88, 0.90];
brass = [0.85, 0.68, 0.35];

module along_y(h, r, n = 64) rotate([90, 0, 0]) cylinder(h = h, r = r, center = true, $fn = n);

module housing() {
  case_radius = throw + 16;
  difference() {
    union() {
      along_y(56, case_radius, 96);
      translate([0, 0, case_radius - 8]) cylinder(h = top - case_radius + 14, r = bore / 2 + wall, $fn = 96);
      for (i = [0:fins - 1]) translate([0, 0, case_radius + 4 + i * (top - case_radius) / fins])
        cylinder(h = 2, r = bore / 2 + wall + 9, $fn = 96);
      translate([-case_radius, -28, -case_radius]) cube([2 * case_radius, 56, 8]);
      translate([0, 0, top + 6]) cylinder(h = 12, r = 5, $fn = 32); // spark plug seat
    }
    along_y(46, case_radius - wall, 96);
    cylinder(h = top, r = bore / 2 + 0.3, $fn = 96);
    along_y(80, 8);
    translate([0, 0, top - 1]) cylinder(h = 30, r = 3, $fn = 32);
    for (x = [-1, 1], y = [-22, 22]) translate([x * (case_radius - 6), y, -case_radius - 1])
      cylinder(h = 10, r = 2.6, $fn = 24);
  }
}

module crankshaft() rotate([0, crank, 0]) {
  for (s = [-1, 1]) translate([0, s * 24, 0]) along_y(32, 7.6);
  for (s = [-1, 1]) translate([0, s * 13, 0]) intersection() {
    along_y(8, throw + 9);
    union() {
      translate([-9, -5, 0]) cube([18, 10, throw + 9]);
      translate([-throw - 9, -5, -throw - 9]) cube([2 * throw + 18, 10, throw + 9]);
    }
  }
  translate([0, 0, throw]) along_y(20, 5);
}

module connecting_rod() // from the crank pin at the origin upwards
  difference() {
    union() {
      along_y(10, 9);
      translate([0, 0, rod]) along_y(10, 7);
      translate([-4, -3, 0]) cube([8, 6, rod]);
    }
    along_y(30, 5.2);
    translate([0, 0, rod]) along_y(30, 4.2);
    for (y = [-3, 3]) translate([-2, y - 1, 14]) cube([4, 2, rod - 28]);
  }

module piston() // its pin at the origin
  difference() {
    translate([0, 0, -14]) cylinder(h = 28, r = bore / 2, $fn = 96);
    translate([0, 0, -15]) cylinder(h = 24, r = bore / 2 - 4, $fn = 96);
    for (z = [4.5, 8.5]) difference() {
      translate([0, 0, z]) cylinder(h = 1.8, r = bore / 2 + 1, $fn = 64);
      translate([0, 0, z - 1]) cylinder(h = 4, r = bore / 2 - 1.6, $fn = 96);
    }
  }

difference() {
  color(iron) housing();
  if (section) color(cut) translate([0, -200, -100]) cube([200, 200, 300]);
}
color(steel) crankshaft();
color(brass) translate([pin.x, 0, pin.y]) rotate([0, -lean, 0]) connecting_rod();
translate([0, 0, piston]) {
  color(steel * 0.9) difference() {
    piston();
    if (section) translate([0.5, -50, -50]) cube([50, 50, 100]);
  }
  color(brass) along_y(bore - 6, 4, 32);
}
