#!/bin/sh
# compare.sh MODEL - compares one model with what OpenSCAD makes of it.
#
# MODEL: a .scad file; what OpenSCAD makes of it is kept beside it. hcsg-render, compare_vertices and
# compare_volumes are in the path. Prints "MODEL pass|fail|none HOW": none is what OpenSCAD
# has no geometry of.
model=$1
stem=${model%.scad}.geometry

say() {
    printf '%s\t%s\t%s\n' "$model" "$1" "$(printf %s "$2" | tr '\t\n' '  ')"
    exit 0
}

solid() { # FROM: the solid that OpenSCAD makes of a .csg
    timeout 120 openscad "$1" -o "$PWD/$stem.new.stl" --export-format=binstl 2>"$stem.log" &&
        mv "$stem.new.stl" "$stem.stl"
}

# Both programs read what OpenSCAD exported: it has six digits only. Marks make no difference to
# geometry, but # takes an object out of the others in a preview. A flat shape is compared as a
# plate, the one form in which OpenSCAD writes more than six digits.
if [ ! -e "$stem.done" ]; then
    timeout 60 openscad "$model" -o "$PWD/$stem.all.csg" 2>"$stem.log"
    [ -s "$stem.all.csg" ] && sed 's/^\(%\{0,1\}\)#/\1/' "$stem.all.csg" >"$stem.csg"
    if ! solid "$stem.csg" && grep -q 'not a 3D object' "$stem.log"; then
        mv "$stem.csg" "$stem.flat.csg"
        {
            echo 'linear_extrude(height = 1, scale = [1, 1]) {'
            cat "$stem.flat.csg"
            echo '}'
        } >"$stem.csg"
        solid "$stem.csg"
    fi
    touch "$stem.done"
fi
[ -s "$stem.stl" ] || say none ''

# Vertices where the model is one object, volumes where it has booleans.
message=$(timeout 60 hcsg-render -o "$stem.ours.stl" "$stem.csg" 2>&1)
code=$?
how=volumes
case $message in
*'is not one object'*)
    message=$(timeout 60 compare_volumes "$stem.csg" "$stem.stl" 2>&1)
    code=$?
    ;;
*)
    if [ $code -eq 0 ]; then
        message=$(timeout 60 compare_vertices "$stem.ours.stl" "$stem.stl" 2>&1)
        code=$?
        how=$message
    fi
    ;;
esac
rm -f "$stem.ours.stl"
[ $code -eq 0 ] || say fail "$message"

# Only flat shapes are on a grid. Only hulls leave corners out, and only sections have more of them
# where they cross the triangles that OpenSCAD has cut faces into.
case $how in
grid) grep -Eq 'square|circle|polygon|text|projection|import' "$stem.csg" || say fail "$how" ;;
surface) grep -Eq 'hull|minkowski|cut = true' "$stem.csg" || say fail "$how" ;;
esac
say pass "$how"
