#!/bin/sh
# export_examples.sh FOLDER - copies OpenSCAD's examples and exports those that are not; 77: none are there.
examples=/usr/share/openscad/examples
[ -d "$examples" ] || exit 77
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cp -r "$examples"/. "$folder"
for file in "$folder"/*/*.scad; do
    out=${file%.scad}.csg
    [ -e "$out" ] || openscad -o "$out" "$file" >/dev/null 2>&1 </dev/null || rm -f "$out"
done
