// A hinge printed in one go: cones turn in sockets with a gap between them. Its front is cut open
// along the axis; % shows where the moving leaf lies when flat, # what the screws take away.

/* [Hinge] */
length = 60; // [30:120]
leaf = 32; // [15:60]
knuckle = 7; // [4:0.5:10]
knuckles = 5; // [3:2:9]
gap = 0.5; // [0.3:0.1:1]

/* [View] */
// of the moving leaf: 0 closed, 180 flat
angle = 105; // [0:180]
section = true;
show_screws = true;

/* [Hidden] */
thickness = knuckle * 0.7;
part = length / knuckles;
fixed = [0.36, 0.55, 0.72];
moving = [0.93, 0.68, 0.28];

module along_x(h, r1, r2) rotate([0, 90, 0]) cylinder(h = h, r1 = r1, r2 = r2, $fn = 48);

module screws()
  for (x = [0.18, 0.82], y = [0.3, 0.75])
    translate([x * length, knuckle + gap + y * leaf, -knuckle]) {
      translate([0, 0, -1]) cylinder(h = thickness + 2, r = 2.2, $fn = 32);
      translate([0, 0, thickness - 2.4]) cylinder(h = 2.5, r1 = 2.2, r2 = 4.6, $fn = 32);
    }

module pin(extra) along_x(part * 0.55, knuckle * 0.72 + extra, 0.8 + extra);

// the knuckles first, first + 2, ... with their plate; each but the last reaches into its neighbour
module half(first) {
  difference() {
    union() {
      translate([0, knuckle + gap, -knuckle]) cube([length, leaf, thickness]);
      for (i = [first:2:knuckles - 1]) translate([i * part + gap / 2, 0, 0]) {
        along_x(part - gap, knuckle, knuckle);
        translate([0, 0, -knuckle]) cube([part - gap, knuckle + gap + 1, thickness]);
      }
    }
    for (i = [first:2:knuckles - 1])
      if (i > 0) translate([i * part - gap / 2, 0, 0]) pin(gap);
    if (show_screws) #screws(); else screws();
  }
  for (i = [first:2:knuckles - 2]) translate([(i + 1) * part - gap / 2, 0, 0]) pin(0);
}

// what the section removes; the two cuts are not in one plane, which OpenSCAD would draw mixed
module front(back)
  if (section) translate([-1, -back, -back]) cube([length + 2, 2 * knuckle, 2 * knuckle]);

mirror([0, 1, 0]) {
  difference() {
    color(fixed) half(0);
    color(fixed * 0.7) front(0);
  }
  difference() {
    color(moving) rotate([angle - 180, 0, 0]) mirror([0, 1, 0]) half(1);
    color(moving * 0.7) front(0.02);
  }
  %translate([0, -knuckle - gap - leaf, -knuckle]) cube([length, leaf, thickness]);
}
