# render_hostile.sh PROGRAM SOURCE - models and files made to hurt: each ends soon, in little memory, with
# lines that say why and the right exit code.
render=$1
. "$(dirname "$0")/scratch.sh"
ulimit -t 60

# draws CODE TEXT: draws the model on standard input. TEXT stands in a message, and no message is
# longer than a line of a terminal or three; with an empty TEXT any number up to the most is right.
draws() {
    cat >model.csg
    timeout 60 "$render" --imgsize=32,32 -o out.png model.csg >stdout 2>stderr
    got=$?
    what=$(head -c 70 model.csg | tr -d '\000')
    [ $got -eq "$1" ] || fault "$what: exit code $got, not $1: $(head -n 3 stderr)"
    [ "$(wc -l <stderr)" -le 101 ] || fault "$what: $(wc -l <stderr) lines of messages"
    [ "$(wc -L <stderr)" -le 240 ] || fault "$what: a line of $(wc -L <stderr) characters"
    [ -z "$2" ] || grep -qF -- "$2" stderr || fault "$what: '$(head -n 3 stderr)' does not say '$2'"
    [ "$1" -ne 0 ] || [ -s out.png ] || fault "$what: no picture"
    rm -f out.png
}

# repeat COUNT TEXT
repeat() {
    awk -v n="$1" -v text="$2" 'BEGIN { while (n--) printf "%s", text }'
}

# Numbers that are none or too large, everywhere at once
for v in nan inf -inf 1e300 -1e300 1e9 -1 undef '"x"' '[[1]]' true; do
    draws 0 '' <<END
cube(size = [$v, 1, 1], center = $v);
sphere(r = $v, \$fn = 8);
sphere(r = 1, \$fa = $v, \$fs = $v);
cylinder(h = $v, r1 = $v, r2 = 1, \$fn = 8);
polygon(points = [[0, 0], [$v, 0], [0, 1]], paths = [[0, 1, $v]]);
polyhedron(points = [[0, 0, 0], [$v, 0, 0], [0, 1, 0], [0, 0, 1]], faces = [[0, 1, $v], [0, 2, 3]]);
linear_extrude(height = $v, twist = $v, scale = [$v, $v]) square(1);
linear_extrude(height = 1, twist = 90, slices = $v, segments = $v) square(1);
rotate_extrude(angle = $v, start = $v) square(1);
offset(r = $v) square(1);
offset(delta = $v, chamfer = true) square(1);
multmatrix([[$v, 0, 0, $v], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, $v]]) sphere();
color([$v, $v, 0, 1]) multmatrix($v) cube();
resize(newsize = [$v, $v, 0], auto = [$v, 0, 0]) cube();
text(text = "ab", size = $v, spacing = $v, halign = $v, font = $v);
text(text = $v, \$fn = 9);
projection(cut = $v, convexity = $v) cube([1, $v, 1]);
hull() { cube(); multmatrix([[1, 0, 0, $v], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) cube(); }
minkowski() { cube(); sphere(r = $v); }
import(file = $v, scale = $v);
surface(file = $v);
END
done

# Counts without end
for model in 'circle(r = 1, $fn = 1e9);' 'sphere(r = 1e9, $fs = 1e-9, $fa = 1e-9);' \
    'linear_extrude(height = 1, slices = 1e9, twist = 360) square(1);' \
    'linear_extrude(height = 1, twist = 1e9, $fa = 0.01) square(1);' \
    'rotate_extrude($fn = 1e9) multmatrix([[1, 0, 0, 5]]) circle(1, $fn = 1e5);' \
    'multmatrix([[1e300, 0, 0, 0]]) multmatrix([[1e300, 0, 0, 0]]) cube();'; do
    echo "$model" | draws 0 'model.csg:1:'
done
for model in 'offset(r = 1e9, $fn = 1e9) square(1);' 'resize([1e300, 1e300, 1e300]) cube();' \
    'resize([1e300, 1]) circle(1);'; do
    echo "$model" | draws 0 ''
done

# Everything upon everything else
{
    echo 'difference() { square(50); polygon(points = ['
    awk 'BEGIN { srand(1); while (n++ < 3000) printf "[%g, %g], ", 100 * rand(), 100 * rand() }'
    echo ']); }'
} | draws 0 'model.csg:1:28: polygon() is too large, or crosses itself too often; left out'
for cut in true false; do
    {
        echo "projection(cut = $cut) {"
        awk 'BEGIN { srand(1); while (n++ < 5000) {
            printf "multmatrix([[1, 0, 0, %g], [0, 1, 0, %g], ", 100 * rand(), 100 * rand()
            printf "[0, 0, 1, 0]]) sphere(%g);\n", 1 + 9 * rand() } }'
        echo '}'
    } | draws 0 ''
done
{ printf 'text("' && repeat 12000 a && echo '", spacing = 0);'; } | draws 0 ''

echo 'hull() { cylinder(r1 = 1, r2 = 1, h = 1, $fn = 20000); cube(0.1); }' | draws 0 ''

{
    echo 'linear_extrude(height = 1) text("'
    repeat 400 abcdefghijklmnopqrstuvwxyz
    echo '");'
} | tr -d '\n' | draws 0 ''
{
    echo 'polyhedron(points = ['
    awk 'BEGIN { srand(1); for (n = 50000; i < n; i++) { a = 6.2831853 * i / n; r = 5 + rand()
        printf "[%.9g, %.9g, 0], ", r * cos(a), r * sin(a) }
        print "], faces = [["; for (i = 0; i < n; i++) printf "%d, ", i }'
    echo ']]);'
} | draws 0 ''

# Nesting and length
for node in 'group(){' 'hull(){' 'projection(){' 'resize([1, 0, 0]){'; do
    { repeat 20000 "$node" && echo 'cube();' && repeat 20000 '}'; } | draws 0 ''
done
repeat 1000000 '[' | draws 1 'model.csg:'
{ echo 'cube(' && repeat 100000 '[' && echo ');'; } | draws 1 'model.csg:'
{ echo 'cube(' && repeat 1000000 9 && echo ');'; } | draws 0 'warning: '
repeat 200000 'bogus();' | draws 0 'bogus'
{ repeat 100000 bogus && echo '();'; } | draws 0 'bogusbogus'
{ echo 'text("' && repeat 300000 ab && echo '");'; } | draws 0 'warning: '
{ echo 'cube(' && head -c 100000 /dev/zero; } | draws 1 'model.csg:'
echo 'cube(size = [1, 1' | draws 1 'model.csg:'

# Imports
import() {
    file=$1 text=$2
    cat >"$file"
    case $file in
    *.dat | *.png) echo "surface(file = \"$file\");" ;;
    *) echo "import(file = \"$file\");" ;;
    esac | draws 0 "$text"
    rm -f "$file"
}
for file in a.stl a.off a.amf a.obj a.3mf a.nef3 a.dxf a.svg a.png a.dat; do
    head -c 1000 /dev/zero | import $file ''
    repeat 100 'solid 1e999 <x> ' | import $file ''
    : | import $file ''
done
{ repeat 80 x && printf '\377\377\377\177' && repeat 50 x; } | import a.stl 'a.stl'
echo 'OFF 1000000000 1000000000 0' | import a.off 'a.off'
{ printf 'OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99999999999\n'; } | import a.off ''
echo 'Selective Nef Complex standard vertices 4000000000 halfedges 4000000000 facets 4000000000
    volumes 1 shalfedges 4000000000 shalfloops 0 sfaces 0' | import a.nef3 'a.nef3:2:'
printf '\211PNG\r\n\032\n\0\0\0\rIHDR\177\377\377\377\177\377\377\377\10\0\0\0\0' | import a.png 'a.png'
{
    echo '<?xml version="1.0"?><!DOCTYPE amf [<!ENTITY a0 "x">'
    awk 'BEGIN { for (i = 1; i < 40; i++)
        printf "<!ENTITY a%d \"&a%d;&a%d;&a%d;&a%d;\">\n", i, i - 1, i - 1, i - 1, i - 1 }'
    echo ']><amf><object>&a39;</object></amf>'
} >bomb.xml
import a.amf 'a.amf' <bomb.xml
sed 's/amf/svg/g' bomb.xml | import a.svg 'a.svg'
{ echo '<svg>' && repeat 100000 '<g>' && echo '<rect width="9" height="9"/>'; } | import a.svg 'a.svg'
if command -v zip >/dev/null; then
    mkdir 3D
    { echo '<model>' && head -c 300000000 /dev/zero; } >3D/3dmodel.model
    zip -q1 bomb.3mf 3D/3dmodel.model
    rm -r 3D
    echo 'import(file = "bomb.3mf");' | draws 0 'bomb.3mf'
fi
exit $failed
