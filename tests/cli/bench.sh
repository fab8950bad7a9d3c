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
measure --device=cpu less >tables 2>stderr || fault "$(cat stderr)"
! grep -q 'gl:' tables || fault "cpu: $(cat tables)"
! measure --device=gpu less >tables 2>stderr || fault 'no such device'
grep -qx "hcsg-bench: --device: expected auto, cpu or gl, got 'gpu'" stderr ||
    fault "wrong device: $(cat stderr)"

# Each frame takes longer than the limit: one size.
measure --curves --device=cpu -o curves.tsv less >tables 2>stderr || fault "$(cat stderr)"
[ ! -s tables ] && [ "$(cut -f 1,2,5 curves.tsv | tail -n +2)" = 'less	curve_cpu_256_ms	1' ] ||
    fault "curves: $(cat curves.tsv)"
! measure --curves less 2>stderr || fault 'curves to nowhere'
grep -qx 'hcsg-bench: --curves needs --output' stderr || fault "curves: $(cat stderr)"
command -v python3 >/dev/null || exit $failed
printf 'less\tcurve_cpu_512_ms\t40\t40\t1\nless\tcurve_gl3_256_ms\t2\t2\t1\n' >>curves.tsv
"$source/bench/plot" curves.tsv . >/dev/null || fault 'plot'
[ "$(grep -c '<polyline' curve-less.svg)" = 2 ] && [ "$(grep -c '<circle' curve-less.svg)" = 3 ] &&
    grep -q '>512</text>' curve-less.svg || fault "plot: $(cat curve-less.svg)"
exit $failed
