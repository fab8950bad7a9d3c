# screen.sh - what the tests of hcsg-view share: a virtual screen, the window on it, and pictures of both.
# Read by scripts that have set $program, $case and $tools, programs that they need besides.
for tool in xvfb-run xdotool import compare $tools; do
    command -v $tool > /dev/null || { echo "SKIP: no $tool"; exit 77; }
done
if [ -z "${HCSG_VIEW_SCREEN:-}" ]; then
    export HCSG_VIEW_SCREEN=1 LIBGL_ALWAYS_SOFTWARE=1
    exec xvfb-run -a -s "-screen 0 640x480x24" "$0" "$@"
fi

work=$(mktemp -d)
cd "$work" || exit 1
export XDG_CONFIG_HOME=$work/config # no settings but those of the test
pid=
trap '[ -n "$pid" ] && kill -9 $pid 2> /dev/null; rm -rf "$work"' EXIT

# GL drivers and fontconfig leak when the program ends; of a sanitizer's findings only ours count.
export ASAN_OPTIONS=log_path=$work/sanitizer LSAN_OPTIONS=exitcode=0
findings() { cat sanitizer.* err 2> /dev/null | grep -e "ERROR: AddressSan" -e "runtime error:" -e "src/base/mem.c"; }

fail() {
    echo "FAIL: $*"
    echo "--- standard output"; tail -30 out
    echo "--- standard error"; tail -30 err
    exit 1
}
start() {
    "$program" --size=640,480 --stats "$@" > out 2> err &
    pid=$!
}
# wait_for FILE TEXT: until a line of FILE has TEXT in it.
wait_for() {
    for _ in $(seq 1000); do
        grep -q -e "$2" "$1" && return
        kill -0 $pid 2> /dev/null || fail "the program ended before '$2' came"
        sleep 0.02
    done
    fail "'$2' did not come"
}
# shot NAME: the screen, as soon as nothing was drawn for a while after a picture in full resolution.
shot() {
    local before=
    while [ "$before" != "$(wc -l < out)" ] || grep ^frame out | tail -1 | grep -qv " 1/1:"; do
        before=$(wc -l < out)
        sleep 0.4
    done
    import -window root "$1.png"
}
# differing A B [REGION]: number of pixels that are not the same.
differing() {
    convert "$1.png" -crop "${3:-$picture}" +repage 1.ppm
    convert "$2.png" -crop "${3:-$picture}" +repage 2.ppm
    compare -metric AE 1.ppm 2.ppm null: 2>&1 | sed 's/[^0-9].*//'
}
same() { [ "$(differing "$@")" -eq 0 ] || fail "pictures $1 and $2 differ ${3:-}"; }
differ() { [ "$(differing "$@")" -gt 300 ] || fail "pictures $1 and $2 are the same ${3:-}"; }
quit() {
    xdotool key q
    wait $pid || fail "exit code $? after the key q"
    pid=
}
# A block of this length with a post on it.
box() {
    echo "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(size = [$1, 10, 10]); }"
    echo "cube(size = [3, 4, 15]);"
}
picture=640x450+0+0 # where no status line stands, with times that differ
above=640x300+0+0   # and no message
finish() {
    findings > found && fail "$(cat found sanitizer.* 2> /dev/null)"
    echo "$case: fine"
}
