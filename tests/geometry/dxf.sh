#!/bin/sh
# dxf.sh PATH WORK - compares DXF files of flat shapes with OpenSCAD's: as many lines, each with the
# ends of one of its own within its six digits. PATH: the folder of hcsg-render. Needs openscad; exits
# 77 (skipped) without it.
PATH=$1:$PATH work=$2
command -v openscad >/dev/null || exit 77
mkdir -p "$work" && cd "$work" || exit 1
failed=0

# The ends of each LINE in a row. A file is pairs of lines: a code and what it says.
lines() {
    awk 'NR % 2 { code = $1 + 0; next }
        code == 0 { if (line) print x1, y1, x2, y2; line = $1 == "LINE" }
        code == 10 { x1 = $1 } code == 20 { y1 = $1 } code == 11 { x2 = $1 } code == 21 { y2 = $1 }' "$1"
}

while read -r name model; do
    echo "$model" >"$name.csg"
    openscad "$name.csg" -o "$PWD/$name.theirs.dxf" 2>"$name.log" &&
        hcsg-render -o "$name.ours.dxf" "$name.csg" 2>>"$name.log" ||
        { echo "FAILED: $name: $(tail -n 1 "$name.log")" && failed=1 && continue; }
    lines "$name.ours.dxf" >"$name.ours" && lines "$name.theirs.dxf" >"$name.theirs"
    awk -v name="$name" '
        function size(x) { return x < 0 ? -x : x }
        function apart(a, b, p, q, sum, i) { # in units of the sixth digit
            split(a, p); split(b, q)
            for (i = 1; i <= 4; i++) sum += size(p[i] - q[i]) / (1e-5 * size(q[i]) + 2e-5)
            return sum
        }
        NR == FNR { ours[++n] = $0; next }
        {
            theirs++
            best = 0
            for (i = 1; i <= n; i++)
                if (!(i in taken) && (!best || apart(ours[i], $0) < apart(ours[best], $0))) best = i
            if (!best || apart(ours[best], $0) > 4) {
                printf "FAILED: %s: no line of ours is %s\n", name, $0
                exit code = 1
            }
            taken[best]
        }
        END {
            if (!code && (n != theirs || n < 3)) {
                printf "FAILED: %s: %d lines, not %d\n", name, n, theirs
                code = 1
            }
            exit code
        }' "$name.ours" "$name.theirs" || failed=1
done <<'END'
square square(size = [2, 3.5], center = true);
circle circle(r = 7.3, $fn = 23);
holes render() difference() { square(10); multmatrix([[1, 0, 0, 3], [0, 1, 0, 4]]) circle(2); }
apart render() union() { square(1); multmatrix([[1, 0, 0, 20], [0, 1, 0, -4]]) circle(2, $fn = 5); }
polygon polygon(points = [[0, 0], [10, 0], [10, 5], [4, 1], [0, 7]], paths = undef);
crossing polygon(points = [[0, 0], [10, 10], [10, 0], [0, 7]], paths = undef);
offset offset(r = 1, $fn = 12) polygon(points = [[0, 0], [10, 0], [4, 3]], paths = undef);
large multmatrix([[1000, 0, 0, 0], [0, 1000, 0, 0]]) circle(3, $fn = 7);
hull hull() { square(3); multmatrix([[1, 0, 0, 9], [0, 1, 0, 2]]) circle(1, $fn = 9); }
projection projection(cut = true) multmatrix([[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0]]) sphere(5, $fn = 12);
END
exit $failed
