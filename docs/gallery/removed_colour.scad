// Title: What was cut away still colours what it touched
// Issues: 1793 4263 4325
// View: --camera=20,15,0,40,0,30,150
// The yellow frame has no floor: its window is cut all the way through. The preview shows yellow on
// the red base, where the part that was taken out of the frame had touched it.
color("crimson") cube([40, 30, 4]);
color("gold") translate([0, 0, 4]) difference() {
    cube([40, 30, 4]);
    translate([5, 5, -1]) cube([30, 20, 6]);
}
