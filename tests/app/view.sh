#!/bin/bash
# view.sh PROGRAM CASE SHADERS - hcsg-view on a virtual screen, driven like a user does. Exits 77 without
# one.
set -u
program=$1 case=$2 shaders=$3 tools=
. "$(dirname "$0")/screen.sh"

case $case in
reload)
    box 24 > a.csg
    start a.csg
    wait_for out "load 1:"; shot first
    box 16 > a.csg
    wait_for out "load 2:"; shot second; differ first second
    box 16 | head -c 60 > a.csg # broken
    wait_for err "a.csg:1"; shot broken
    same second broken $above; differ second broken 640x140+0+310
    box 24 > new; mv new a.csg
    wait_for out "load 3:"; shot third; same first third
    rm a.csg
    wait_for err "a.csg: No such file"; shot gone; same first gone $above
    box 16 > a.csg
    wait_for out "load 4:"; shot fourth; same second fourth
    errors=$(wc -l < err) # half a file first, the rest soon
    box 12 > whole
    head -c 40 whole > a.csg; sleep 0.06; tail -c +41 whole >> a.csg
    wait_for out "load 5:"; shot fifth; differ second fifth
    [ "$errors" = "$(wc -l < err)" ] || fail "a half-written file was reported"
    : > a.csg # an empty design, after a while
    wait_for out "load 6:"; shot empty; differ fifth empty
    quit
    ;;
camera)
    box 20 > a.csg
    start a.csg
    wait_for out "load 1:"; shot first
    xdotool mousemove 300 200 mousedown 1 mousemove 330 210 mousemove 360 220 mouseup 1
    shot turned; differ first turned
    xdotool key r; shot reset; same first reset
    xdotool mousemove 300 200 mousedown 3 mousemove 330 210 mousemove 360 220 mouseup 3
    shot moved; differ first moved
    xdotool key v; shot all; same first all
    xdotool mousemove 200 200 click 4 click 4; shot near; differ first near
    xdotool click 5 click 5 # the wheel takes back what it did
    shot far; [ "$(differing first far)" -lt 300 ] || fail "zooming does not come back"
    xdotool mousedown 2 mousemove 200 260 mouseup 2; shot along; differ first along
    xdotool key r key o; shot parallel; differ first parallel
    xdotool key o; previous=first
    for key in 4 5 6 7 8 9; do
        xdotool key ctrl+$key; shot view$key; differ $previous view$key; previous=view$key
    done
    xdotool key ctrl+0 key ctrl+shift+v; shot diagonal; same first diagonal
    xdotool key h; shot help; differ first help
    xdotool key h key c; wait_for out "^--camera=.*,55,0,25,"
    shot same_again; same first same_again
    xdotool key i; shot bare # without the status line
    xdotool key p; wait_for out "^a-1.png"
    [ "$(identify -format '%wx%h' a-1.png)" = 640x480 ] || fail "the saved picture has a wrong size"
    xdotool key i key i; shot bare # without the note about the file
    same bare a-1 640x480+0+0
    xdotool key i
    box 15 > a.csg # the camera stays over a reload
    wait_for out "load 2:"
    quit
    ;;
gl) # a driver that gives no context without a window, and shaders of a folder
    mkdir none; touch none/libEGL.so.1
    cp -r "$shaders" own
    box 20 > a.csg
    start a.csg
    wait_for out "load 1:"; shot first; quit
    export LD_LIBRARY_PATH=none HCSG_SHADERS=own
    start --device=auto a.csg
    wait_for out "^device: cpu; not gl: .* draws on the processor"; quit
    start --device=gl a.csg
    wait_for out "^device: gl, "
    wait_for out "load 1:"; shot second
    [ "$(differing first second)" -lt 300 ] || fail "gl draws another picture"
    sed -i '2i no such thing' own/frame.glsl
    xdotool key ctrl+5
    wait_for err "^hcsg-view: shaders/frame.glsl:2: "; shot third; differ second third
    ! grep -q "processor draws" err || fail "the shaders that were there draw no more"
    quit
    ;;
idle)
    box 20 > a.csg
    start a.csg
    wait_for out "load 1:"; shot first
    ticks() { awk '{ print $14 + $15 }' /proc/$pid/stat; }
    begin=$(ticks); sleep 4; used=$(($(ticks) - begin))
    [ $used -le 4 ] || fail "$used of 400 ticks used while nothing happened"
    kill -TERM $pid; wait $pid || fail "exit code $? after SIGTERM"
    pid=
    ;;
scad)
    cat > played << 'EOF'
#!/bin/sh
# "slow": waits before it exports; "wrong": does not export; otherwise the design is the export.
echo begin >> log
if grep -q slow "$5"; then sleep 30; fi
if grep -q wrong "$5" part; then echo "ERROR: no good in file p.scad, line 1" >&2; exit 1; fi
cat "$5" part > "$2"
printf '%s: \\\n\t%s/part \\\n\t%s\n' "$2" "$PWD" "$5" > "$4"
echo end >> log
EOF
    chmod +x played
    box 10 > p.scad; : > part
    start --openscad ./played p.scad
    wait_for out "load 1:"; shot first
    box 20 > part # a file that the design depends on
    wait_for out "load 2:"; shot second; differ first second
    echo wrong > part # the message names another file; the right one is still followed
    wait_for err "p.scad:1: no good"; shot wrong; same second wrong $above
    box 20 > part
    wait_for out "load 3:"; shot right; same second right
    echo wrong > p.scad; shot wrong; same second wrong $above
    echo slow > p.scad; sleep 0.5
    : > part; box 10 > p.scad # kills the slow one
    wait_for out "load 4:"; shot third; same first third
    [ "$(grep -c begin log)" -ge 6 ] || fail "openscad was not started anew"
    echo slow > p.scad; sleep 0.3
    quit # while openscad runs
    [ -z "$(pgrep -f "$work/played" || true)" ] || fail "openscad outlives the window"
    ;;
errors)
    expect() { # CODE TEXT ARGUMENTS
        local code=$1 text=$2; shift 2
        timeout 20 "$program" "$@" > out 2> err; local got=$?
        [ $got = "$code" ] || fail "$*: exit code $got, expected $code"
        grep -q -e "$text" err || fail "$*: no '$text'"
        [ "$(wc -l < err)" -le 3 ] || fail "$*: more than one message"
    }
    box 10 > a.csg; echo "cube(" > broken.csg
    expect 1 "expected one file"
    expect 1 "none.csg: No such file" --no-watch none.csg
    expect 1 "a.csg/b.csg: Not a directory" a.csg/b.csg
    expect 1 "device" --device=none a.csg
    expect 1 "memory" --memory 0 a.csg
    expect 1 "is a folder" .
    expect 1 "standard input" -
    expect 1 "size: expected" --size=3 a.csg
    expect 1 "projection: expected" --projection=x a.csg
    expect 1 "camera" --camera=1,2 a.csg
    expect 1 "Cornfield" --colorscheme=none a.csg
    expect 1 "broken.csg:1" --no-watch broken.csg
    box 10 > a.scad; expect 1 "no such file" --no-watch --openscad /no/openscad a.scad
    unset DISPLAY WAYLAND_DISPLAY
    expect 2 "cannot open a window" a.csg
    ;;
files)
    start later/a.csg # neither folder nor file
    wait_for err "later/a.csg: No such file"
    mkdir later; box 10 > later/a.csg
    wait_for out "load 1:"; shot first
    echo 'import(file = "part.off"); cube(1);' > later/a.csg
    wait_for err "part.off: No such file"; wait_for out "load 2:"; shot without
    differ first without
    off() { printf 'OFF 4 4 0\n0 0 0\n%s 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' $1; }
    off 9 > later/part.off
    wait_for out "load 3:"; shot part; differ without part
    off 20 > later/part.off
    wait_for out "load 4:"; shot longer; differ part longer
    box 10 > later/a.csg
    wait_for out "load 5:"; shot again; same first again
    off 9 > later/part.off # no longer of interest
    mkdir aside; mv later/a.csg aside/; rmdir later 2> /dev/null; sleep 2
    mv aside/a.csg later/a.csg
    wait_for out "load 6:"; shot back; same first back
    [ "$(grep -c "^load" out)" = 6 ] || fail "loaded more often than saved"
    quit
    ;;
storm)
    box 10 > a.csg
    start a.csg
    wait_for out "load 1:"
    for i in $(seq 50); do box $((i % 20 + 5)) > a.csg; sleep 0.04; done
    box 20 > a.csg
    shot before; xdotool key r; shot saved
    for i in $(seq 20); do # while turning
        xdotool mousemove 300 200 mousedown 1 mousemove $((300 + i)) 210 mouseup 1
        box $((i % 20 + 5)) > a.csg
    done
    box 20 > a.csg
    shot before; xdotool key r; shot turned; same saved turned
    window=$(xdotool search --class hcsg-view | tail -1)
    for i in $(seq 40); do xdotool windowsize $window $((300 + i * 7)) $((200 + i * 6)); done
    xdotool windowsize --sync $window 640 480 key v; shot resized; same saved resized
    xdotool windowunmap --sync $window; sleep 0.3
    frames=$(grep -c ^frame out)
    box 10 > a.csg; sleep 0.7; box 12 > a.csg; sleep 0.7
    [ "$frames" = "$(grep -c ^frame out)" ] || fail "drawn though nobody sees it"
    xdotool windowmap --sync $window; shot mapped; differ saved mapped
    box 20 > a.csg; sleep 0.5; shot last; same saved last
    quit
    ;;
openscad)
    command -v openscad > /dev/null || { echo "SKIP: no openscad"; exit 77; }
    mkdir sub
    echo 'include <between.scad>' > a.scad
    echo 'include <sub/part.scad>' > between.scad
    echo 'cube(' > sub/part.scad
    start a.scad
    wait_for err "Parser error"
    # Files that openscad tells of late may be loaded once more, before the first load shows.
    loads() { grep -c ^load out; }
    newer() { # than $before loads
        for _ in $(seq 1000); do
            [ "$(loads)" -gt "$before" ] && return
            sleep 0.02
        done
        fail "nothing newer was loaded"
    }
    before=0
    echo 'cube(10);' > between.scad # openscad has not told that this file is included
    newer; shot first
    echo 'include <sub/part.scad>' > between.scad
    shot broken; same first broken $above
    before=$(loads); echo 'cube(20);' > sub/part.scad
    newer; shot second
    before=$(loads)
    rm sub/part.scad; echo 'include <sub/part.scad> cube(5);' > a.scad
    wait_for err "Can't open include file"
    newer; shot without
    before=$(loads); echo 'cube([5, 5, 30]);' > sub/part.scad # was missing
    newer; shot tall; differ first tall
    quit
    OPENSCAD= PATH=/nowhere "$program" --size=640,480 --stats a.scad > out 2> err &
    pid=$!
    wait_for err "openscad: no such file.*install it"
    [ "$(wc -l < err)" = 1 ] || fail "more than one message"
    kill -HUP $pid; wait $pid; pid=
    ;;
*)
    echo "no case $case"
    exit 1
    ;;
esac
finish
