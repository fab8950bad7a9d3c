#!/bin/sh
# models.sh PATH SOURCE WORK - compares the models that come with OpenSCAD with what it makes of
# them, but for the slow ones of SOURCE/slow.txt. PATH: folders of the programs to compare with.
# Needs openscad and its test models; exits 77 (skipped) without them.
PATH=$1:$PATH source=$2 work=$3
data=/usr/share/openscad/testdata examples=/usr/share/openscad/examples
command -v openscad >/dev/null && [ -d $data/scad ] && [ -d $examples ] || exit 77

# OpenSCAD's results are kept until another OpenSCAD is installed.
work=$work/$(openscad --version 2>&1 | tr -dc 'A-Za-z0-9.')
if [ ! -e "$work/examples" ]; then
    mkdir -p "$work" || exit 1
    cp -r $data "$work/testdata" && cp -r $examples "$work/examples" || exit 1
fi
cd "$work" || exit 1
sed '/^#/d; s/[[:space:]].*//; /^$/d' "$source/slow.txt" | sort >slow
find testdata/scad examples -name '*.scad' | sort | comm -23 - slow | sh "$source/check.sh" "$source"
