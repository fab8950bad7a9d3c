# render_summary.sh PROGRAM SOURCE - numbers as text and as JSON, the rule for make, and who gets
# standard output.
render=$1
. "$(dirname "$0")/scratch.sh"

refuse() {
    text=$1
    shift
    "$render" "$@" >stdout 2>stderr
    [ $? -eq 1 ] && [ ! -s stdout ] || fault "$*: not refused"
    [ "$(wc -l <stderr)" -eq 1 ] && grep -qF -- "$text" stderr || fault "$*: '$(cat stderr)'"
}

cat >cut.csg <<'END'
difference() {
    cube(size = [10, 10, 10], center = false);
    multmatrix([[1, 0, 0, 5], [0, 1, 0, 5], [0, 0, 1, -1], [0, 0, 0, 1]]) {
        cube(size = [20, 10, 20], center = false);
    }
}
END

# says PART...: the lines that a summary of these parts has, by their first words
says() {
    expected=$1
    shift
    "$render" "$@" cut.csg >stdout 2>stderr || fault "$*: $(cat stderr)"
    got=$(sed -n 's/^\([A-Z][a-z ]*\):.*/\1/p' stdout | tr '\n' ',')
    [ "$got" = "$expected" ] || fault "$*: says $got"
}
geometry='Nodes,Leaves,Solids,Triangles,Not drawn,Warnings,'
cache='Combinations,Open rays,'
says "$geometry${cache}Bounding box,Camera,Picture,Time," --summary
says "$geometry${cache}Bounding box,Area,Volume,Centre,Camera,Picture,Time," --summary all
says "${cache}Time," --summary=cache --summary time
says 'Bounding box,Camera,Picture,' --summary camera,bounding-box
says 'Mass,' --density=2
refuse "got 'boxes'" --summary=boxes cut.csg
refuse "got 'x'" --summary=time,x cut.csg
refuse '--density: expected' --density=0 cut.csg

# 1000 - 5 * 5 * 10 = 750
within() {
    awk -v got="$1" -v bound="$2" -v true="$3" 'BEGIN {
        exit !(got - true <= bound && true - got <= bound && bound > 0 && bound < true / 100) }'
}
"$render" --summary-file x.json --density 2 cut.csg >stdout || fault 'x.json: failed'
[ -s stdout ] && fault 'x.json: text as well'
tr -d '\n\t ' <x.json >flat.json
number() {
    sed -n "s/.*\"$1\":{\"value\":\([^,]*\),\"error\":\([^}]*\)}.*/\1 \2/p" flat.json
}
# shellcheck disable=SC2046 # two words
within $(number volume) 750 || fault "volume: $(number volume)"
# shellcheck disable=SC2046
within $(number area) 550 || fault "area: $(number area)"
# shellcheck disable=SC2046
within $(number mass) 1.5 || fault "mass: $(number mass)"
for text in '"bounding_box":{"min":[0,0,0],"max":[10,10,10],"size":[10,10,10]}' '"dimensions":3' \
    '"rotation":[55,0,25]' '"fov":22.5' '"time":"0:00:0' '"geometry_cache":{"entries":' \
    '"closed":true'; do
    grep -qF "$text" flat.json || fault "x.json: no $text"
done
"$render" --summary-file - --summary camera cut.csg | tr -d '\n\t ' >flat.json
grep -q '^{"camera":{"translation":\[5,5,5\],"rotation":\[55,0,25\],"distance":[0-9.]*,"fov":22.5}}$' \
    flat.json || fault "camera alone: $(cat flat.json)"
echo 'square(size = [4, 2], center = false);' |
    "$render" --summary-file - --summary geometry,bounding-box - | tr -d '\n\t ' >flat.json
grep -q '"dimensions":2.*{"min":\[0,0\],"max":\[4,2\],"size":\[4,2\]}' flat.json ||
    fault "flat: $(cat flat.json)"
"$render" --summary-file none/x.json cut.csg 2>stderr
[ $? -eq 2 ] && grep -q '^hcsg-render: none/x.json: No such' stderr || fault 'none/x.json: wrong end'
refuse 'expected the name of a file' --summary-file= cut.csg

# Standard output
"$render" --summary -o - cut.csg >out.png 2>stderr
[ "$(head -c 4 out.png | tail -c 3)" = PNG ] && grep -q '^Leaves:' stderr || fault 'both to stdout'
echo before >out.png
"$render" -o /dev/stdout cut.csg >>out.png
[ "$(head -n 1 out.png)" = before ] || fault '/dev/stdout: file replaced'
"$render" -o /dev/null cut.csg && [ -c /dev/null ] || fault '/dev/null: replaced'
refuse 'takes only one of the outputs' -o - -o /dev/stdout cut.csg
refuse 'takes only one of the outputs' -o - --summary-file - cut.csg
refuse 'takes only one of the outputs' -o - -o x.png -d - cut.csg

# The rule
rm -f out.png
mkdir 'a b'
echo 'OFF 0 0 0' >'a b/in.off'
printf 'import(file = "in.off");\nimport(file = "no.stl");\n' >'a b/c.csg'
"$render" -d out.d -o 'out 1.png' -o '$2.png' 'a b/c.csg' 2>/dev/null
printf 'out\\ 1.png $$2.png: \\\n\ta\\ b/c.csg \\\n\t%s/a\\ b/in.off \\\n\t%s/a\\ b/no.stl\n' \
    "$PWD" "$PWD" >expected
cmp -s expected out.d || fault "rule: $(cat out.d)"
[ "$("$render" -d - -o x.png - <cut.csg)" = 'x.png:' ] || fault 'rule of standard input'
"$render" -d none/out.d -o out.png cut.csg 2>stderr
[ $? -eq 2 ] && grep -q '^hcsg-render: none/out.d: No such' stderr || fault 'none/out.d: wrong end'
rm -f out.d
"$render" -d out.d -o none/out.png cut.csg 2>stderr
[ $? -eq 2 ] && [ ! -e out.d ] || fault 'rule of what could not be written'
refuse '-d: expected a file that is made' -d out.d -o - cut.csg
refuse '-d: expected the name' -d '' -o out.png cut.csg
exit $failed
