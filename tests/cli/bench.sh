# bench.sh HCSG-BENCH SOURCE - the bench from the generator of instances to its tables; no times.
. "$(dirname "$0")/scratch.sh"
bench=$1
source=$2

mkdir scenes none
touch none/libEGL.so.1
"$source/bench/scenes/instanced" scenes/less.csg op=minus copies=20 n=24
"$source/bench/scenes/instanced" scenes/more.csg op=plus copies=20 n=24
"$source/bench/scenes/instanced" scenes/x.csg size=3 2>stderr && fault 'a wrong parameter'
printf 'less instanced 0 0\nmore instanced 0 0\n' >list
measure() {
    "$bench" --list=list --scenes=scenes --size=32 --frames=1 --limit=0.0001 --threads=2 "$@"
}

LD_LIBRARY_PATH=none measure -o out.tsv >tables 2>stderr || fault "$(cat stderr)"
# 21 meshes of 24 * 24 triangles; those that are united share a value
grep -q '^| less | 12096 | 21 | 2 |.* not measured ' tables || fault "less: $(cat tables)"
grep -q '^| more | 12096 | 21 | 1 |.* not measured ' tables || fault "more: $(cat tables)"
grep -q '^gl: not measured: .*libEGL' tables || fault "why: $(cat tables)"
[ "$(grep -c '^less	batch_1*[02][0-9]*_combinations' out.tsv)" = 2 ] || fault "$(cat out.tsv)"
! grep -q 'paper' tables || fault "none of the paper's: $(cat tables)"
mkdir paper
cp scenes/less.csg paper/gears.csg
echo 'gears instanced 0 0' >paper/list
LD_LIBRARY_PATH=none measure --list=paper/list --scenes=paper >tables || fault 'gears'
grep -qx '| gears | 30.5 | 18.4 | 1.84 | not measured | | 21.8 | 16.1 | 1.61 | not measured | |' tables ||
    fault "gears: $(cat tables)"
measure --device=cpu less >tables 2>stderr || fault "$(cat stderr)"
! grep -q 'gl:' tables || fault "cpu: $(cat tables)"
! measure --device=gpu less >tables 2>stderr || fault 'no such device'
grep -qx "hcsg-bench: --device: expected auto, cpu or gl, got 'gpu'" stderr ||
    fault "wrong device: $(cat stderr)"

# Each frame takes longer than the limit: one size.
measure --curves --device=cpu -o curves.tsv less >tables 2>stderr || fault "$(cat stderr)"
[ ! -s tables ] && [ "$(cut -f 1,2,5 curves.tsv | tail -n +2)" = "less	curve_transparent_cpu_256_ms	1
less	curve_opaque_cpu_256_ms	1" ] || fault "curves: $(cat curves.tsv)"
! measure --curves less 2>stderr || fault 'curves to nowhere'
grep -qx 'hcsg-bench: --curves needs --output' stderr || fault "curves: $(cat stderr)"
# 20 of the 21 meshes share a value, or each has its own; the crossings are the same.
measure --values --device=cpu -o values.tsv less >tables 2>stderr || fault "$(cat stderr)"
[ ! -s tables ] && [ "$(grep '_count	' values.tsv | cut -f 2,3)" = "values_shared_count	2
values_unshared_count	21" ] && [ "$(grep '_crossings	' values.tsv | cut -f 3 | uniq | wc -l)" = 1 ] &&
    [ "$(grep -c 'shared_cpu\(array\)*_ms	' values.tsv)" = 4 ] || fault "values: $(cat values.tsv)"
command -v python3 >/dev/null || exit $failed
printf 'less\tcurve_%s_ms\t40\t40\t1\n' transparent_cpu_512 transparent_gl3_256 >>curves.tsv
cat values.tsv >>curves.tsv
"$source/bench/plot" curves.tsv . >tables || fault 'plot'
[ "$(grep -c 'fill="none"' curve-less.svg)" = 3 ] && [ "$(grep -c '<circle' curve-less.svg)" = 4 ] &&
    grep -q '>512</text>' curve-less.svg || fault "plot: $(cat curve-less.svg)"
[ "$(grep -c 'fill="none"' values.svg)" = 4 ] && [ "$(grep -c '<circle' values.svg)" = 4 ] ||
    fault "plot: $(cat values.svg)"
grep -qx '| transparent gl3 | 40.0 | – |' tables && grep -q '^| 21 | unshared | 0.00 |' tables ||
    fault "plot: $(cat tables)"
exit $failed
