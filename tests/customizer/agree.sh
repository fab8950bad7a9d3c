# agree.sh AGREE SOURCE - parameters and parameter sets as OpenSCAD 2021.01 reads them, with its own
# tests of the customizer and the files of agree/. Skipped (77) without them.
agree=$1 source=$2
data=/usr/share/openscad/testdata/scad/customizer
command -v openscad >/dev/null && [ -d $data ] || exit 77
openscad --version 2>&1 | grep -q 2021.01 || exit 77
. "$source/tests/cli/scratch.sh"

# The syntax tree shows groups, descriptions and annotations.
set --
for file in "$source"/tests/customizer/agree/*.scad $data/*.scad; do
    tree=$work/$(basename "$file" .scad).ast
    openscad -o "$tree" "$file" >/dev/null 2>&1 || fault "openscad: $file"
    set -- "$@" "$file" "$tree"
done
"$agree" trees "$@" >trees || { cat trees; fault 'annotations differ'; }
tail -n 1 trees

# shows NAME FLAGS...: the values of all parameters in the .csg that openscad makes of x.scad
shows() {
    name=$1
    shift
    openscad "$@" -o "$work/$name.csg" x.scad >/dev/null 2>&1 || fault "openscad $*"
    [ -s "$name.csg" ] || fault "openscad $*: nothing"
}
# design FILE: x.scad, a copy that shows its values
design() {
    { cat "$1"; echo; "$agree" names "$1" | sed 's/.*/text(str("&", &));/'; } >x.scad
}

# Sets written by others: -p and -P give what we make of them.
both_read() {
    design "$1"
    "$agree" flags "$1" "$2" "$3" >flags || fault "$2: $3"
    shows theirs -p "$2" -P "$3"
    eval "shows ours $(cat flags)"
    cmp -s ours.csg theirs.csg || fault "$2: $3: $(diff ours.csg theirs.csg)"
}
both_read "$source/tests/customizer/agree/sets.scad" "$source/tests/customizer/agree/sets.json" odd
[ "$(grep -o -- -D flags | wc -l)" -eq 22 ] || fault "flags: $(cat flags)"
for set in firstSet wrongSetValues thirdSet Name.dot; do
    both_read $data/setofparameter.scad $data/setofparameter.json $set
done

# Sets written by us, beside one of theirs that stays what it was.
design "$source/tests/customizer/agree/sets.scad"
cp "$source/tests/customizer/agree/sets.json" mine.json
"$agree" save x.scad mine.json 'our "set"' b1=false n1=-0.000123456789 n2=1e30 \
    "s1=it's \"quoted\" \\ \$HOME é" s2= 's3=[1, 2]' 'v1=[0.1, -2]' 'v2=[1, 2, 3]' 'r1=[5 : 9]' \
    'l1=[1, "b c", 4]' m2=4 >flags || fault 'save'
shows theirs -p mine.json -P 'our "set"'
eval "shows ours $(cat flags)"
cmp -s ours.csg theirs.csg || fault "our set: $(diff ours.csg theirs.csg)"
shows before -p "$source/tests/customizer/agree/sets.json" -P odd
shows after -p mine.json -P odd
cmp -s before.csg after.csg || fault 'the other set has changed'
cmp -s ours.csg before.csg && fault 'the values do not show'
exit $failed
