# random.awk - one random .scad model around a node: awk -v kind=hull -v seed=1 -f random.awk
#
# The same in every awk: its own generator, and no number with more digits than OpenSCAD exports.
function random() { # Park and Miller's minimal standard
    state = state * 48271 % 2147483647
    return state / 2147483647
}
function between(least, most) { return sprintf("%.2f", least + (most - least) * random()) + 0 }
function whole(least, most) { return int(least + (most - least + 1) * random()) }
function chance(part) { return random() < part }
function truth() { return chance(0.5) ? "true" : "false" }
function pick(list,    parts) { return parts[whole(1, split(list, parts, "|"))] }
function vector(n, least, most,    i, text) {
    for (i = 0; i < n; i++)
        text = text (i ? ", " : "[") between(least, most)
    return text "]"
}
function fragments() { return pick("$fn=3|$fn=5|$fn=8|$fn=13|$fn=32|$fa=20,$fs=1|$fa=7,$fs=0.3|$fn=0") }

# A star around the origin with corners at all sorts of distances: a simple polygon, mostly concave.
function star(least, most,    n, i, r, text) {
    n = whole(3, 12)
    for (i = 0; i < n; i++) {
        r = between(least, most)
        text = text sprintf("%s[%.3f, %.3f]", i ? ", " : "", r * cos(6.283185307 * i / n),
                            r * sin(6.283185307 * i / n))
    }
    return "polygon([" text "]);"
}
function flat(    k) {
    k = whole(1, 6)
    if (k == 1) return "square(" vector(2, 1, 9) ", center=" truth() ");"
    if (k == 2) return "circle(" between(1, 6) ", " fragments() ");"
    if (k == 3) return "translate(" vector(2, -4, 4) ") rotate(" between(0, 360) ") " star(2, 7)
    if (k == 4) return "difference() { circle(7, $fn=24); " star(1, 5) " }"
    if (k == 5) return "union() { square(" vector(2, 2, 9) "); translate(" vector(2, -3, 3) \
        ") circle(" between(1, 5) ", " fragments() "); }"
    return star(2, 8)
}
function placed() {
    return "translate(" vector(3, -5, 5) ") rotate(" vector(3, 0, 360) ") scale(" vector(3, 0.5, 2) ") "
}
function convex(    k) {
    k = whole(1, 3)
    if (k == 1) return placed() "cube(" vector(3, 1, 6) ", center=" truth() ");"
    if (k == 2) return placed() "sphere(" between(1, 4) ", " pick("$fn=5|$fn=8|$fn=12") ");"
    return placed() "cylinder(h=" between(1, 6) ", r1=" between(0, 3) ", r2=" between(0.5, 3) \
        ", center=" truth() ", " pick("$fn=5|$fn=8|$fn=12") ");"
}
function cut() { # a solid by booleans
    return pick("difference|union|intersection") "() { cube(" vector(3, 4, 9) ", center=true); " convex() " }"
}
function solid() { return chance(0.3) ? cut() : convex() }

function primitive(    k) {
    k = whole(1, 4)
    if (k == 1) return "sphere(" between(0.1, 50) ", " fragments() ");"
    if (k == 2) return "cylinder(h=" between(0.1, 50) ", r1=" pick("0|3|" between(0, 20)) ", r2=" \
        pick("0.5|" between(0.1, 20)) ", center=" truth() ", " fragments() ");"
    return placed() (k == 3 ? "mirror(" vector(3, -1, 1) ") " : "") solid()
}
function linear_extrude(    text) {
    text = "linear_extrude(height=" between(0.5, 20) ", center=" truth()
    if (chance(0.6)) text = text ", twist=" between(-500, 500)
    if (chance(0.5)) text = text ", scale=" pick(between(0, 3) "|" vector(2, 0, 3) "|0|[0, 1]")
    if (chance(0.4)) text = text ", slices=" whole(1, 30)
    return text ", " fragments() ") " flat()
}
function rotate_extrude() {
    return "rotate_extrude(angle=" pick("360|" between(-360, 360) "|" between(1, 180)) ", " fragments() \
        ") translate([" pick("8.5|-8.5|9|20") ", " between(-9, 9) "]) " flat()
}
function offset() {
    return "offset(" pick("r=" between(-2, 4) "|delta=" between(-2, 4) "|delta=" between(-2, 4) \
        ",chamfer=true") ", " fragments() ") " flat()
}
function text() {
    return "text(\"" pick("Hello|W|Ag%8|fi AV To|x y  z|oOo") "\", size=" between(3, 40) ", font=\"" \
        pick("Liberation Sans|Liberation Serif:style=Bold|DejaVu Sans") "\", halign=\"" \
        pick("left|center|right") "\", valign=\"" pick("top|center|baseline|bottom") "\", spacing=" \
        pick("1|1|" between(0.5, 2)) ", " pick("$fn=0|$fn=4|$fn=20") ");"
}
function resize() {
    return "resize([" between(0, 20) ", " pick("0|" between(1, 20)) ", " pick("0|" between(1, 20)) "], auto=" \
        pick("true|false|[true, false, true]|[false, true, true]") ") " pick(solid() "|" convex())
}

BEGIN {
    state = seed * 7919 + 12345
    for (i = 0; i < 5; i++)
        random()
    if (kind == "primitive") print primitive()
    if (kind == "flat") print flat()
    if (kind == "linear_extrude") print linear_extrude()
    if (kind == "rotate_extrude") print rotate_extrude()
    if (kind == "offset") print offset()
    if (kind == "text") print text()
    if (kind == "hull") print "hull() { " solid() " " convex() " " solid() " }"
    if (kind == "hull_flat") print "linear_extrude(1) hull() { " flat() " " flat() " }"
    if (kind == "minkowski") print "minkowski() { " convex() " " convex() " }"
    if (kind == "minkowski_concave") print "minkowski() { " cut() " " convex() " }"
    if (kind == "minkowski_flat") print "minkowski() { " flat() " " flat() " }"
    if (kind == "resize") print resize()
    if (kind == "resize_flat") print "resize([" between(0, 20) ", " pick("0|" between(1, 20)) "], auto=" truth() ") " flat()
    if (kind == "projection") print "projection() { " solid() " " convex() " }"
    if (kind == "projection_cut") print "projection(cut=true) { " solid() " " convex() " }"
    if (kind == "boolean") print "difference() { " cut() " " convex() " " solid() " }"
}
