# render_flags.sh PROGRAM SOURCE - options as scripts for openscad write them: shortened, joined, empty,
# of other versions; and colour schemes by name.
render=$1
. "$(dirname "$0")/scratch.sh"
export OPENSCAD=/none HOME="$work" XDG_CONFIG_HOME=

echo 'cube(size = [1, 2, 3]);' >a.csg
echo 'cube([1, 2, 3]);' >a.scad

# same OPTIONS...: they are taken without a word, and the picture is that of a.csg alone.
"$render" --imgsize=60,60 -o expected.png a.csg || fault 'no picture'
same() {
    "$render" "$@" >stdout 2>stderr || fault "$*: exit code $?: $(cat stderr)"
    [ -s stderr ] && fault "$*: '$(cat stderr)'"
    cmp -s expected.png out.png || fault "$*: another picture"
    rm -f out.png
}
# refused TEXT OPTIONS...: one line with TEXT, exit code 1, no picture.
refused() {
    text=$1
    shift
    "$render" -o out.png "$@" >stdout 2>stderr
    got=$?
    [ $got -eq 1 ] && [ ! -e out.png ] || fault "$*: exit code $got"
    [ "$(wc -l <stderr)" -eq 1 ] && grep -qF -- "$text" stderr || fault "$*: '$(cat stderr)'"
    rm -f out.png
}

# The forms that boost::program_options takes
same --img=60,60 -o out.png a.csg
same --img 60,60 --o=out.png a.csg
same --imgs=60,60 -qo out.png a.csg
same --imgsize=60,60 -qoout.png -- a.csg
same a.csg --o out.png --imgsize 60,60
refused '--vie is short for --viewall and --view' --vie=axes a.csg
refused 'unknown option --sample; did you mean --samples?' --sample=2 a.csg
refused 'unknown option -imgsize=60,60; did you mean --imgsize=60,60?' -imgsize=60,60 a.csg
refused 'unknown option -viewall; did you mean --viewall?' -viewall a.csg
refused '--viewall takes no value' --viewal=1 a.csg
refused 'expected WIDTH,HEIGHT' --img= a.csg
refused 'expected WIDTH,HEIGHT' --imgsize '' a.csg
refused 'unknown option --a b' "--a
b" a.csg

# What concerns openscad alone
same --imgsize=60,60 -o out.png --enable=roof --enable import-function --debug=all --debug x \
    --check-parameters=true --check-parameter-ranges off --backend=Manifold a.csg
same --imgsize=60,60 -o out.png --colorscheme '' --animate=0 --csglimit=5 a.csg
for value in foo '' yes; do
    refused "--check-parameters: expected true or false, got '$value'" --check-parameters "$value" a.csg
    refused "--check-parameter-ranges: expected true or false, got '$value'" \
        --check-parameter-ranges="$value" a.csg
done
refused '--check-parameter is short for --check-parameters and --check-parameter-ranges' \
    --check-parameter=1 a.csg
for option in --enable --debug --backend --check-parameters -s -x; do
    refused "$option: expected" a.csg $option
done

# An openscad that knows all but --enable
cat >fake <<'END_FAKE'
#!/bin/sh
for word; do
    [ "$word" != --enable ] || { printf "unrecognised option '--enable'\n\nUsage: openscad\n  -x arg\n" >&2; exit 1; }
done
out=$2
shift 4
printf '%s|' "$@" >arguments
echo 'cube(size = [1, 2, 3]);' >"$out"
END_FAKE
chmod +x fake
same --openscad=./fake --imgsize=60,60 -o out.png --check-parameters True --debug=a.cc a.scad
[ "$(cat arguments)" = '--check-parameters|True|--debug|a.cc|a.scad|' ] || fault "$(cat arguments)"
"$render" --openscad=./fake --imgsize=60,60 -o out.png --enable=roof --debug=a.cc a.scad 2>stderr ||
    fault '--enable: failed'
[ "$(cat stderr)" = 'warning: a.scad: openscad does not know --enable and goes without' ] ||
    fault "--enable: '$(cat stderr)'"
[ "$(cat arguments)" = '--debug|a.cc|a.scad|' ] || fault "--enable: $(cat arguments)"
rm -f out.png
"$render" --openscad=./fake --hardwarnings -o out.png --enable=roof a.scad 2>/dev/null
[ $? -eq 1 ] && [ ! -e out.png ] || fault '--enable: no warning'
printf '#!/bin/sh\nprintf "the argument is missing\\n\\nUsage: openscad\\n -x\\n" >&2; exit 1\n' >strict
chmod +x strict
refused 'a.scad: openscad: the argument is missing' --openscad=./strict a.scad

# -s and -x
for option in '-s old.stl' '--s=old.stl' '-xold.stl'; do
    # shellcheck disable=SC2086 # two words
    "$render" $option a.csg 2>stderr || fault "$option: failed"
    grep -q '^DEPRECATED: -s and -x; -o FILE.stl' stderr && [ "$(wc -l <stderr)" -eq 1 ] ||
        fault "$option: '$(cat stderr)'"
    head -n 1 old.stl | grep -q '^solid' || fault "$option: no STL"
    rm -f old.stl
done
"$render" -q -s old.stl -o out.png a.csg 2>stderr && [ -s old.stl ] && [ -s out.png ] && [ ! -s stderr ] ||
    fault "-s and -o: '$(cat stderr)'"
rm -f out.png

# --info
"$render" --info >info || fault '--info: failed'
for line in '^hcsg [0-9]' '^Libraries: .*libpng [0-9]' '^Device cpu: [0-9]' '^Device gl: .' '^Draws with: '; do
    grep -q "$line" info || fault "--info: no line $line"
done
if [ -w /dev/full ]; then
    "$render" --info >/dev/full 2>stderr
    [ $? -eq 2 ] && [ "$(wc -l <stderr)" -eq 1 ] || fault '--info to a full disk'
fi

# Colour schemes by name, from three folders. scheme NAME COLOUR, in OpenSCAD's form
scheme() {
    printf '{"name": "%s", "index": 1, "show-in-gui": true, "colors": {' "$1"
    for key in axes-color opencsg-face-front opencsg-face-back cgal-face-front cgal-face-back \
        cgal-face-2d cgal-edge-front cgal-edge-back cgal-edge-2d crosshair; do
        printf '"%s": "#102030", ' $key
    done
    printf '"background": "%s"}}' "$2"
}
own=.config/hcsg/color-schemes user=.config/OpenSCAD/color-schemes/render
mkdir -p $own $user elsewhere/hcsg/color-schemes
scheme Mine '#010203' >$own/a.json
scheme Sunset '#010203' >$own/sunset.json
scheme 'Two Words' '#040506' >$user/b.JSON
scheme Mine '#070809' >$user/c.json
scheme Else '#0a0b0c' >elsewhere/hcsg/color-schemes/d.json
scheme Text '#0d0e0f' >$user/d.txt
# background EXPECTED OPTIONS...: the colour of the first pixel
background() {
    expected=$1
    shift
    "$render" --imgsize=1,1 --camera=0,0,0,0,0,0,1 -o out.png "$@" empty.csg 2>stderr ||
        fault "$*: $(cat stderr)"
    "$render" --imgsize=1,1 --camera=0,0,0,0,0,0,1 --reference=out.png --colorscheme="$expected" \
        empty.csg 2>/dev/null || fault "$*: not the colours of $expected"
    rm -f out.png
}
: >empty.csg
background ./$own/a.json --colorscheme=Mine
background ./$user/b.JSON --colorscheme 'Two Words'
background Sunset --colorscheme=Sunset
refused "no colour scheme 'Else'; there are: Cornfield" --colorscheme=Else a.csg
grep -qF 'Monotone, Mine, Two Words, Mine' stderr || fault "names: '$(cat stderr)'"
refused "no colour scheme 'Text'" --colorscheme=Text a.csg
export XDG_CONFIG_HOME="$work/elsewhere"
background ./elsewhere/hcsg/color-schemes/d.json --colorscheme=Else
background ./$user/c.json --colorscheme=Mine
echo '{' >$user/a.json
mkdir $user/0.json
background ./$user/c.json --colorscheme=Mine
refused '0.json: is a folder' --colorscheme=None a.csg
rmdir $user/0.json
refused 'a.json:2:1: not JSON' --colorscheme=None a.csg
scheme Odd yellow >$user/a.json
refused "a.json: 'background' is not a colour" --colorscheme=Odd a.csg
echo '[1]' >$user/a.json
refused 'a.json: not a colour scheme: there is no "name"' --colorscheme=None a.csg
HOME='' background Sunset --colorscheme=Sunset
exit $failed
