# render_scad.sh PROGRAM SOURCE - .scad files: what reaches openscad, played by a script, and what it
# says.
render=$1
. "$(dirname "$0")/scratch.sh"

# Writes the arguments but its own -o and -d, and a model.
cat >fake <<'END'
#!/bin/sh
out=$2
shift 4
printf '%s\n' "$@" >arguments
cat said >&2
[ -e model ] && text=$(cat model) || text='cube(size = [1, 1, 1]);'
if [ "$1" = --animate ]; then
    for i in $(seq "$2"); do
        echo "$text" >"${out%.csg}$(printf %05d $((i - 1))).csg"
    done
else
    echo "$text" >"$out"
fi
END
chmod +x fake
: >said
echo 'cube();' >a.scad
export OPENSCAD=/none

# passes EXPECTED OPTIONS...: what openscad gets, words parted by "|"
passes() {
    expected=$1
    shift
    "$render" --openscad=./fake -o out.png "$@" a.scad 2>stderr || fault "$*: $(cat stderr)"
    got=$(tr '\n' '|' <arguments)
    [ "$got" = "$expected" ] || fault "$*: openscad gets '$got'"
    rm -f out.png
}

passes 'a.scad|'
passes '-D|x=1|-D|s="a b"|a.scad|' -D x=1 '-Ds="a b"'
echo '{"parameterSets": {"big one": {"x": "1"}, "b": {}}, "fileFormatVersion": "1"}' >sets.json
passes '-p|sets.json|-P|big one|a.scad|' -p sets.json -P 'big one'
passes '--render=force|a.scad|' --render
passes '--render=force|a.scad|' --render=cgal
passes 'a.scad|' --preview=throwntogether
passes 'a.scad|' --render --preview
passes '-m|make -s|a.scad|' -m 'make -s'

# Animations: a picture for each $t, from 0 on.
yes 'Exporting a.scad...' | head -n 4 >said
echo 'cube(size = [1, 1, 1]);' >model
"$render" --openscad ./fake --animate 4 -D a=1 -d x.d --summary camera --summary-file 'x y.json' -o x.png \
    -o a.b/x a.scad 2>stderr
[ $? -eq 2 ] && [ -e x00000.png ] && [ ! -e x00001.png ] && [ ! -e x.d ] ||
    fault 'animation: goes on after a failure'
mkdir a.b
"$render" --openscad ./fake --animate 4 -D a=1 -d x.d --summary camera --summary-file 'x y.json' -o x.png \
    -o a.b/x a.scad 2>stderr || fault "animation: $(cat stderr)"
[ -s stderr ] && fault "animation: '$(cat stderr)'"
[ "$(tr '\n' '|' <arguments)" = '--animate|4|-D|a=1|a.scad|' ] || fault "animation: $(cat arguments)"
for i in 0 1 2 3; do
    [ -s x0000$i.png ] && [ -s a.b/x0000$i ] && [ -s "x y0000$i.json" ] || fault "animation: frame $i"
done
[ -e x.png ] || [ -e x00004.png ] && fault 'animation: too many frames'
head -n 1 x.d | grep -q '^x00000.png a.b/x00000 x00001.png .* a.b/x00003: ' || fault "rule: $(cat x.d)"
: >said
rm -rf x0* a.b x.d 'x y'*

# A frame that is wrong is named, whether openscad says so or the drawing does.
cat >third <<'END'
#!/bin/sh
for i in 0 1 2 3; do
    [ $i -eq 2 ] && text=$(cat model) || text='cube(size = [1, 1, 1]);'
    echo "$text" >"${2%.csg}0000$i.csg"
done
cat said >&2
END
chmod +x third
echo 'ERROR: Assertion failed in file a.scad, line 7' >said
: >model
"$render" --openscad ./third --animate 4 -o x.png a.scad 2>stderr
[ $? -eq 1 ] && [ "$(cat stderr)" = 'a.scad:7: Assertion failed (frame 00002)' ] && [ ! -e x00000.png ] ||
    fault "animation: '$(cat stderr)'"
: >said
echo 'cube(' >model
"$render" --openscad ./third --animate 4 -o x.png a.scad 2>stderr
[ $? -eq 1 ] && grep -q '^a.scad (frame 00002):1:' stderr || fault "animation: '$(cat stderr)'"
[ -s x00001.png ] && [ ! -e x00002.png ] && [ ! -e x00003.png ] || fault 'animation: goes on behind a bad frame'
rm -f x0* model

# Ended in the middle of it, nothing stays but whole pictures.
mkdir tmp many
for signal in INT TERM HUP KILL; do
    TMPDIR=$work/tmp timeout -s $signal 0.3 "$render" --openscad ./fake --imgsize=700,700 --samples=16 --animate 50 \
        -o many/x.png a.scad 2>/dev/null
    [ -e many/x00049.png ] && fault "$signal: was not ended"
    [ $signal = KILL ] || [ -z "$(ls tmp)" ] || fault "$signal: left $(ls tmp | head -n 3)"
    [ -z "$(find many -name '*.png?*')" ] || fault "$signal: left $(find many -name '*.png?*')"
    rm -rf tmp/* many/*
done
rm -r tmp many

# openscad itself turns the camera of an animation.
if OPENSCAD= command -v openscad >/dev/null; then
    echo '$vpr = [60, 0, 90 * $t]; $vpd = 20; cube([1, 2, 3]);' >turn.scad
    OPENSCAD= "$render" --animate 2 --summary camera -o turn.png turn.scad 2>/dev/null >cameras
    [ "$(sed -n 's/^Camera:.*=//p' cameras | tr '\n' ' ')" = '0,0,0,60,0,0,20 0,0,0,60,0,45,20 ' ] ||
        fault "animation: $(cat cameras)"
    cmp -s turn00000.png turn00001.png && fault 'animation: does not turn'
    echo 'x = 1; echo(x, $preview);' >echo.scad
    echo '{"parameterSets": {"set": {"x": "3"}}}' >real.json
    for pair in '1,.true:-q --summary' '1,.true:' '2,.true:-D x=2' '1,.false:--render' \
        '3,.false:-p real.json -P set --render=cgal' '2,.true:--preview -D x=2 --render'; do
        # shellcheck disable=SC2086 # several words
        OPENSCAD= "$render" ${pair#*:} -o out.png echo.scad >/dev/null 2>stderr || fault "$pair: failed"
        case $pair in
        *-q*) [ ! -s stderr ] ;;
        *) grep -q "^ECHO: .*${pair%%:*}\$" stderr ;;
        esac || fault "$pair: $(cat stderr)"
    done
    rm -f out.png
fi

# The camera of the file: any of four variables moves it from where pictures without one have it.
camera() {
    expected=$1 view=$2
    shift 2
    printf '%s\n' "ECHO: \"hcsg_view\", $view" 'ECHO: 1' \
        'WARNING: Viewall and autocenter disabled in favor of $vp*' >said
    got=$("$render" --openscad ./fake --summary camera "$@" v.scad 2>stderr | sed -n 's/.*--camera=//p')
    [ "$got" = "$expected" ] || fault "camera: $got"
}
echo '$vpr=[0,0,90];' >v.scad
camera 0,0,0,0,0,90,140 '[0, 0, 0], [0, 0, 90], 500, 22.5'
[ "$(cat stderr)" = 'ECHO: 1' ] || fault "camera: $(cat stderr)"
tr '\n' '|' <arguments | grep -qF -- '-D|hcsg_view=echo("hcsg_view",$vpt,$vpr,$vpd,$vpf)|v.scad|' ||
    fault "camera: $(cat arguments)"
camera 0,0,0,0,0,90,140 '[0, 0, 0], [0, 0, 90], 500, 22.5' --viewall --hardwarnings
grep -q '^WARNING: Viewall' stderr || fault 'camera: no warning'
camera 1,2,3,0,0,0,4 '[0, 0, 0], [0, 0, 90], 500, 22.5' --camera=1,2,3,0,0,0,4
echo 'module a(b = $vpr == 1) { } $vpr = [0, 0, 0]; $vpd=500;' >v.scad
camera 0,0,0,0,0,0,500 '[0, 0, 0], [0, 0, 0], 500, 22.5'
echo '$vpt = [1, 2, -3.5];' >v.scad
camera 1,2,-3.5,55,0,25,140 '[1, 2, -3.5], [0, 0, 0], 500, 22.5'
# Two numbers are enough; what is of another kind is as if it were not set.
echo '$vpt = 1; $vpr = 1; $vpd = 1;' >v.scad
camera 0,0,0,10,20,0,7 'undef, [10, 20], 7, 22.5'
camera 5,6,0,55,0,25,7 '[5, 6], [10, 20, 0, 30], 7, "wide"'
camera 5,6,7,1,2,3,140 '[5, 6, 7], [1, 2, 3], [200], nan'
: >said
echo 'cube($vpd == 1 ? 2 : 1);' >v.scad
"$render" --openscad ./fake -o out.png v.scad 2>/dev/null
[ "$(cat arguments)" = v.scad ] || fault "camera: asked for without need"
rm -f out.png
: >said

# Messages: all of them, none but errors, or the first warning as the reason to stop.
printf 'ECHO: 5\nWARNING: odd thing in file a.scad, line 7\n' >said
"$render" --openscad ./fake -o out.png a.scad 2>stderr || fault 'messages: failed'
cmp -s said stderr || fault "messages: '$(cat stderr)'"
"$render" --openscad ./fake -q -o out.png a.scad 2>stderr || fault '-q: failed'
[ -s stderr ] && fault "-q: '$(cat stderr)'"
rm -f out.png
"$render" --openscad ./fake --hardwarnings -o out.png a.scad 2>stderr
[ $? -eq 1 ] && [ ! -e out.png ] || fault '--hardwarnings: not stopped'
grep -q '^a.scad:7: odd thing$' stderr || fault "--hardwarnings: '$(cat stderr)'"

# Wrong use
expect() {
    text=$1
    shift
    "$render" -o out.png "$@" 2>stderr
    [ $? -eq 1 ] && [ ! -e out.png ] || fault "$*: not refused"
    [ "$(wc -l <stderr)" -eq 1 ] && grep -qF -- "$text" stderr || fault "$*: '$(cat stderr)'"
}
: >said
for definition in x =1 x= ''; do
    expect "-D: expected VARIABLE=VALUE, got '$definition'" -D "$definition" a.scad
done
expect 'none.json: No such file' -p none.json -P set a.scad
expect "sets.json: no parameter set 'big'; there are: big one, b" -p sets.json -P big a.scad
for text in '' '[]' '{"parameterSets": 3}' '{"parameterSets": {"a": }'; do
    echo "$text" >broken.json
    expect 'broken.json: is no JSON file of parameter sets' -p broken.json -P a a.scad
done
expect '-P set: expected the file' -P set a.scad
expect '-p sets.json: expected the name' -p sets.json a.scad
expect "--render: expected nothing, cgal or force, got 'x'" --render=x a.scad
expect "--preview: expected nothing or throwntogether, got 'x'" --preview=x a.scad
expect '--animate: standard output' --animate=2 -o - a.scad
expect '--animate: expected 0 to 99999' --animate=-1 a.scad
mkdir folder.scad
expect 'folder.scad: is a folder' folder.scad
expect 'gone.scad: No such file' gone.scad
expect '/none: no such file' a.scad
expect './gone: no such file' --openscad=./gone a.scad

echo 'cube(size = [1, 1, 1]);' >a.csg
expect '--animate: only a .scad file has $t, not a.csg' --animate=2 a.csg

# Parameters are listed without openscad.
printf '/* [Size] */\n// in mm\nwidth = 5; // [1:10]\nmodule m() { }\n' >list.scad
"$render" --openscad=/none -o list.param list.scad || fault 'param: failed'
expected='{"parameters":[{"caption":"in mm","group":"Size","initial":5,"max":10,"min":1,"name":"width",'
expected=$expected'"step":1,"type":"number"}],"title":"list"}'
[ "$(tr -d '\t\n' <list.param | sed 's/, "/,"/g')" = "$expected" ] || fault "param: $(cat list.param)"
"$render" --openscad=/none --export-format=param -o - ./list.scad | cmp -s - list.param || fault 'param: -'
"$render" --openscad=./fake -o both.param -o both.png list.scad && [ -s both.png ] &&
    cmp -s both.param list.param || fault 'param: beside a picture'
expect 'out.param: only a .scad file has parameters, not a.csg' -o out.param a.csg
expect 'gone.scad: No such file' -o out.param gone.scad
[ -e out.param ] && fault 'param: written'

# What only a .scad has is told for a .csg, which is drawn all the same.
echo 'cube(size = [1, 1, 1]);' >a.csg
"$render" -D x=1 -o out.png a.csg 2>stderr && [ -s out.png ] || fault '-D: a .csg is not drawn'
[ "$(cat stderr)" = 'warning: a.csg: -D does nothing: only a .scad file has variables' ] ||
    fault "-D: '$(cat stderr)'"

# -m for a .csg
cat >maker <<'END'
#!/bin/sh
echo "making $1"
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' >"$1"
END
chmod +x maker
echo "import(file = \"it's.off\"); import(file = \"again.off\");" >b.csg
"$render" -m ./maker -o - b.csg >out.png 2>stderr || fault '-m: failed'
[ "$(sort stderr | tr '\n' '|')" = "making again.off|making it's.off|" ] || fault "-m: '$(cat stderr)'"
[ -e "it's.off" ] && [ "$(head -c 4 out.png | tail -c 3)" = PNG ] || fault '-m: nothing made'
exit $failed
