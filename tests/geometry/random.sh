#!/bin/sh
# random.sh PATH SOURCE WORK KIND COUNT - compares random models around one node with what OpenSCAD
# makes of them. PATH: folders of the programs to compare with. Needs openscad; exits 77 (skipped)
# without it.
PATH=$1:$PATH source=$2 work=$3 kind=$4 count=$5
command -v openscad >/dev/null || exit 77

# A model made anew would be compared with what OpenSCAD made of another one.
work=$work/$(openscad --version 2>&1 | tr -dc 'A-Za-z0-9.')-$(cksum <"$source/random.awk" | tr ' ' -)
mkdir -p "$work/$kind" && cd "$work/$kind" || exit 1
for seed in $(seq "$count"); do
    model=$kind-$seed.scad
    [ -e "$model" ] || awk -v kind="$kind" -v seed="$seed" -f "$source/random.awk" >"$model"
    echo "$model"
done | sh "$source/check.sh" "$source"
