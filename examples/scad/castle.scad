// A castle: a few modules, repeated along walls and around towers.

/* [Castle] */
// length of a side
side = 80; // [50:150]
height = 18; // [10:40]
towers = 4; // [3:8]

/* [Towers] */
tower_radius = 9; // [6:15]
// above the walls
tower_rise = 12; // [4:30]
roofs = true;

/* [Hidden] */
stone = [0.80, 0.76, 0.68];
shade = [0.62, 0.58, 0.52];
tile = [0.70, 0.26, 0.20];
wood = [0.45, 0.30, 0.18];
grass = [0.55, 0.68, 0.38];
radius = side / 2 / sin(180 / towers);

module crown(r, teeth) // battlements around a tower
  difference() {
    cylinder(h = 5, r = r + 1.2, $fn = 32);
    translate([0, 0, 1]) cylinder(h = 5, r = r - 0.8, $fn = 32);
    for (i = [0:teeth - 1]) rotate(i * 360 / teeth)
      translate([0, -1.4, 2.6]) cube([r + 3, 2.8, 4]);
  }

module tower(r, h) {
  color(stone) difference() {
    cylinder(h = h, r1 = r * 1.12, r2 = r, $fn = 32);
    for (a = [0:90:270], z = [h * 0.5, h * 0.78])
      rotate(a + z * 3) translate([r * 0.6, -0.7, z - 2.5]) cube([r, 1.4, 5]);
  }
  color(stone) translate([0, 0, h]) crown(r, 10);
  if (roofs) color(tile) translate([0, 0, h + 1]) cylinder(h = r * 2.1, r1 = r * 0.98, r2 = 0, $fn = 32);
}

module wall(length, gate) {
  color(stone) difference() {
    translate([-length / 2, -2.5, 0]) cube([length, 5, height]);
    translate([-length / 2, -1.3, height - 3]) cube([length, 2.6, 4]);
    for (x = [-length / 2 + 3:6:length / 2]) translate([x, -3, height - 2]) cube([3, 6, 3]);
    if (gate) color(shade) {
      translate([-5, -4, -1]) cube([10, 8, 9]);
      translate([0, 4, 8]) rotate([90, 0, 0]) cylinder(h = 8, r = 5, $fn = 32);
    }
  }
  if (gate) color(wood) for (x = [-4:2:4]) translate([x - 0.4, -0.4, 0]) cube([0.8, 0.8, 12]);
}

color(grass) translate([0, 0, -3]) cylinder(h = 3, r = radius + 18, $fn = 64);
for (i = [0:towers - 1]) rotate((i + 0.5) * 360 / towers - 90) translate([radius, 0, 0])
  tower(tower_radius, height + tower_rise);
for (i = [0:towers - 1]) rotate(i * 360 / towers)
  translate([0, -radius * cos(180 / towers), 0]) wall(side - tower_radius, i == 0);
translate([0, radius * 0.18, 0]) {
  tower(tower_radius * 1.25, height + tower_rise * 2.3);
  color(stone) translate([-18, -7, 0]) cube([36, 14, height * 0.9]);
  // a four-sided prism, its lower half inside the hall
  color(tile) translate([-19, 0, height * 0.9]) scale([1, 1, 1.1]) rotate([0, 90, 0])
    cylinder(h = 38, r = 8.5, $fn = 4);
}
