# render_picture.sh PROGRAM SOURCE - whole pictures against numbers measured on OpenSCAD's.
render=$1
command -v convert >/dev/null || exit 77
. "$(dirname "$0")/scratch.sh"

# colours FILE: "count r,g,b" of the ten most frequent colours
colours() {
    convert "$1" -format %c histogram:info: |
        sed -nE 's/^ *([0-9]+): *\( *([0-9]+), *([0-9]+), *([0-9]+).*/\1 \2,\3,\4/p' |
        sort -rn | head -10
}

# expect NAME COLOUR: the picture NAME.png has pixels of this colour
expect() {
    colours "$1.png" | grep -q " $2\$" || fault "$1: no $2 among" "$(colours "$1.png" | tr '\n' ' ')"
}

echo 'cube(size = [10, 10, 10], center = false);' >cube.csg
cat >cut.csg <<'CSG'
difference() {
    cube(size = [10, 10, 10], center = false);
    multmatrix([[1, 0, 0, 5], [0, 1, 0, 5], [0, 0, 1, 5], [0, 0, 0, 1]]) {
        cube(size = [10, 10, 10], center = false);
    }
}
CSG
echo '#cube(size = [4, 4, 4], center = false);' >highlight.csg
echo '%cube(size = [4, 4, 4], center = false);' >background.csg
printf '' >empty.csg

for name in cube cut highlight background empty; do
    "$render" --eps=0 -o $name.png $name.csg || fault "$name: exit code $?"
done

expect cube 165,143,29
expect cube 250,216,44
expect cube 143,123,25
empty=$(colours cube.png | sed -n 's/ 255,255,229$//p')
[ "$empty" -ge 121458 ] && [ "$empty" -le 121468 ] || fault "cube: $empty background pixels"
box=$(convert cube.png -fill black +opaque '#ffffe5' -fill white -opaque '#ffffe5' -negate \
    -format %@ info:)
[ "$box" = 413x460+40+39 ] || fault "cube: covers $box"

expect cut 104,135,54
expect cut 158,204,81
expect highlight 253,149,63
expect highlight 144,84,35
expect highlight 167,98,41
expect background 161,161,154
expect background 180,180,174
expect background 145,145,139
[ "$(colours empty.png)" = '262144 255,255,229' ] || fault 'empty: is not empty'

# The same bytes whatever the number of threads, the way in and the way out.
for arguments in '--threads=1 cut.csg' '--threads=8 cut.csg' '-'; do
    # shellcheck disable=SC2086 # several words
    "$render" --eps=0 $arguments -o - <cut.csg >again.png
    cmp -s cut.png again.png || fault "$arguments: another picture"
done

"$render" --imgsize=300,200 --projection=o --camera=0,0,0,0,0,0,100 --colorscheme=Starnight \
    -o top.png cube.csg || fault 'top view failed'
[ "$(identify -format '%wx%h %[bit-depth]' top.png)" = '300x200 8' ] || fault 'top: wrong size'
[ "$(colours top.png | wc -l)" -eq 2 ] || fault 'top: not two colours'

# Blue glass hides what is drawn later and lies behind it, unless surfaces are sorted.
cat >glass.csg <<'EOF'
multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,8],[0,0,0,1]]) color([0,0,1,0.6]) cube(size=[8,8,4],center=true);
color([1,0,0,0.4]) cube(size=[10,10,4],center=true);
EOF
for order in --threads=0:41,41,203 --transparency=file:41,41,203 --transparency=sorted:35,15,180; do
    "$render" --imgsize=64,64 --projection=o --camera=0,0,0,0,0,0,100 "${order%:*}" \
        -o glass.png glass.csg || fault "$order failed"
    colours glass.png | grep -q " ${order#*:}$" || fault "$order: lacks its colour"
done

# Axes are black, arms of the tripod red, green and blue; crosshairs are dark red.
"$render" --view=axes,cubes,crosshairs -o view.png empty.csg 2>stderr || fault 'view failed'
[ "$(cat stderr)" = "hcsg-render: --view: 'cubes' is ignored; there are axes, crosshairs, edges, scales, wireframe" ] ||
    fault "view: says '$(cat stderr)'"
for colour in 0,0,0 255,0,0 0,255,0 0,0,255 128,0,0; do
    colours view.png | grep -q " $colour$" || fault "view: lacks $colour"
done

# Thrown together, edges are magenta, of marked objects see-through: the counts are OpenSCAD's.
cat >marked.csg <<'EOF'
cube(size = [20, 20, 20], center = true);
#multmatrix([[1,0,0,14],[0,1,0,0],[0,0,1,8],[0,0,0,1]]) { cube(size = [5, 5, 5], center = true); }
EOF
"$render" --preview=throwntogether --view=edges --imgsize=100,100 --camera=0,0,0,60,0,30,90 \
    -o marked.png marked.csg || fault 'edges thrown together failed'
for count in '497 255,0,255' '71 160,91,40' '54 186,79,53'; do
    colours marked.png | sed 's/^ *//' | grep -qx "$count" || fault "edges thrown together: not $count"
done

"$render" --summary cut.csg >summary || fault 'summary failed'
grep -q '^Leaves: *2$' summary || fault 'summary: leaves'
grep -q 'Max:  10, 10, 10' summary || fault 'summary: box'
exit $failed
