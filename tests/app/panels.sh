#!/bin/bash
# panels.sh PROGRAM CASE - what stands around the picture in hcsg-view. Exits 77 without a screen.
set -u
program=$1 case=$2 tools=xclip
. "$(dirname "$0")/screen.sh"

ticks() { awk '{ print $14 + $15 }' /proc/$pid/stat; }
pasted() { timeout 5 xclip -o -selection clipboard; }
# An openscad that exports what the design says, after a while where it says so.
cat > played << 'END'
#!/bin/sh
echo "$@" >> called
for design; do :; done # the last argument
grep -q sleep "$design" && sleep 30
grep "^//" "$design" | cut -c 3- >&2
grep -v "^//" "$design" > "$2"
printf '%s: \\\n\t%s\n' "$2" "$design" > "$4"
END
chmod +x played

case $case in
console)
    box 20 > a.scad
    start --openscad ./played a.scad
    wait_for out "load 1:"; shot first
    { echo '//ECHO: "Länge", 20'; echo '//WARNING: odd in file a.scad, line 7'; box 20; } > a.scad
    wait_for out "load 2:"; wait_for err 'ECHO: "Länge", 20'; wait_for err "a.scad:7: odd"
    shot warned; same first warned # the status line tells
    differ first warned 640x20+0+460
    xdotool key m; shot opened; differ first opened; same first opened $above
    # One row after the other: title, echo, warning.
    xdotool mousemove 60 375 sleep 0.2 click 1 sleep 0.3
    [ "$(pasted)" = '"Länge", 20' ] || fail "a click on the echo copies '$(pasted)'"
    xdotool mousemove 60 394 sleep 0.2 click 1 sleep 0.3
    case $(pasted) in */a.scad:7 | a.scad:7) ;; *) fail "a click on the warning copies '$(pasted)'" ;; esac
    xdotool key m; shot closed; same first closed
    echo "//ERROR: Assertion 'x > 3' failed in file a.scad, line 3" > a.scad # exit code 0
    wait_for err "a.scad:3: Assertion"; shot asserted
    differ first asserted; same first asserted $above # the console, and the last good picture
    [[ $(xdotool search --class hcsg-view getwindowname) = *"a.scad:3: Assertion"* ]] || fail "the title"
    box 20 > a.scad
    wait_for out "load 3:"; shot mended; same first mended # it closes again
    : > a.scad
    wait_for err "the design is empty"; shot empty; differ first empty; same first empty $above
    quit
    ;;
cancel)
    box 20 > a.scad
    start --openscad ./played a.scad
    wait_for out "load 1:"; shot first
    echo sleep > a.scad; sleep 1.2
    import -window root slow1.png; sleep 0.5; import -window root slow2.png
    [ "$(differing slow1 slow2 640x20+0+460)" -gt 5 ] || fail "the time that openscad takes does not go on"
    xdotool key Escape; sleep 0.5
    [ -z "$(pgrep -f "sh ./played" || true)" ] || fail "openscad goes on"
    shot given_up; same first given_up
    begin=$(ticks); sleep 5; used=$(($(ticks) - begin))
    [ $used -le 5 ] || fail "$used of 500 ticks used while nothing happened"
    box 15 > a.scad
    wait_for out "load 2:"; shot second; differ first second
    quit
    ;;
panels)
    box 20 > a.csg
    start a.csg
    wait_for out "load 1:"; shot first
    xdotool key h; shot help; differ first help
    frames=$(grep -c ^frame out)
    xdotool mousemove 320 200 mousedown 1 mousemove 360 220 mouseup 1 click 4 # on the sheet
    shot still
    [ "$frames" = "$(grep -c ^frame out)" ] || fail "what is done to the sheet turns the model"
    begin=$(ticks); sleep 5; used=$(($(ticks) - begin)) # open panels are not painted for nothing
    [ $used -le 5 ] || fail "$used of 500 ticks used while nothing happened"
    xdotool key h mousemove 320 200; shot closed; same first closed
    xdotool key i; shot higher; differ first higher
    xdotool key i; shot back; same first back
    xdotool key Left key Left key Up; shot turned; differ first turned
    quit
    ;;
show)
    box 20 > a.scad
    start --openscad ./played a.scad
    wait_for out "load 1:"; xdotool key i; shot first
    for key in e a x; do # each shows something, and goes again
        xdotool key $key; shot with_$key; differ first with_$key
        xdotool key $key; shot without_$key; same first without_$key
    done
    xdotool key s; shot scales; differ with_a scales # brings the axes
    xdotool key e key x key c; wait_for out "^--camera="; shot all
    camera=$(grep "^--camera=" out | tail -1)
    # As hcsg-render draws it.
    expected() {
        "${program%view}render" --openscad ./played --imgsize=640,480 "$camera" "$@" -o expected.png a.scad 2> /dev/null ||
            fail "no picture to compare with"
    }
    expected --view=axes,scales,edges,crosshairs
    xdotool key i key i; shot all # without a note
    same all expected 640x480+0+0
    xdotool key F6; wait_for out "load 2:"; grep -q -e --render=force called || fail "openscad does not render"
    shot geometry
    expected --render --view=axes,scales,edges,crosshairs; same geometry expected 640x480+0+0
    xdotool key F5; wait_for out "load 3:"; shot preview; same all preview
    xdotool key Left key o; shot turned; differ all turned
    xdotool key ctrl+v; shot pasted; same all pasted
    xdotool key k; shot metallic
    expected --colorscheme=Metallic --view=axes,scales,edges,crosshairs
    same metallic expected 640x480+0+0
    xdotool key f; shot full; xdotool key f; shot window; same metallic window
    quit
    ;;
settings)
    box 20 > a.csg
    start a.csg
    wait_for out "load 1:"; shot first
    xdotool key o key a key k key i; shot chosen
    quit
    grep -q '"scheme":.*"Metallic"' config/hcsg/view.json || fail "no scheme in the settings"
    start a.csg
    wait_for out "load 1:"; shot again; same chosen again 640x480+0+0
    xdotool key o; shot perspective; differ again perspective
    quit
    "$program" --stats --projection=o a.csg > out 2> err & # in the size of before
    pid=$!
    wait_for out "load 1:"; wait_for out "^frame 1024x768 1/1"
    quit
    start --colorscheme=Cornfield --projection=p a.csg # not remembered
    wait_for out "load 1:"; quit
    grep -q '"scheme":.*"Metallic"' config/hcsg/view.json || fail "the command line is remembered"
    for broken in '{"axes":' '[]' '' '{"axes": 3, "width": -1, "scheme": [], "height": 1e300}'; do
        echo "$broken" > config/hcsg/view.json
        start a.csg
        wait_for out "load 1:"; shot broken; same first broken
        quit
        case $broken in *3*) ;; *) grep -q "view.json: the settings are" err || fail "nothing said of '$broken'" ;; esac
    done
    chmod 0 config/hcsg; start a.csg; wait_for out "load 1:"; xdotool key a; quit; chmod 700 config/hcsg
    rm -r config; : > config; start a.csg; wait_for out "load 1:"; xdotool key a; quit
    grep -q "config/hcsg" err || fail "nothing said about settings that cannot be written"
    ;;
customizer)
    command -v openscad > /dev/null || { echo "SKIP: no openscad"; exit 77; }
    design() { # LENGTH
        echo "length = $1; // [10:5:50]"
        echo 'post = true;'
        echo 'echo(length = length, post = post); cube([length, 10, 10]); if (post) cube([3, 4, 15]);'
    }
    click() { xdotool mousemove $1 $2 sleep 0.3 click 1 sleep 0.3; }
    design 20 > a.scad
    start a.scad
    wait_for err "length = 20, post = true"; shot first
    xdotool key u; shot opened; differ first opened; differ first opened 300x450+0+0 # moves aside
    click 338 248; wait_for err "length = 20, post = false" # the check box
    shot bare; differ opened bare 300x450+0+0
    xdotool mousemove 430 195 sleep 0.3 mousedown 1 # the slider
    for x in $(seq 440 10 560); do xdotool mousemove $x 195 sleep 0.05; done
    xdotool mouseup 1; shot long; differ bare long 300x450+0+0
    length=$(grep -o "length = [0-9.]*" err | tail -1); length=${length#* = }
    [ "$length" -gt 30 ] && [ $((length % 5)) = 0 ] || fail "the slider stops at $length"
    click 420 39; [ "$(pasted)" = "-D 'length=$length' -D 'post=false'" ] || fail "copied: $(pasted)"
    click 420 89; xdotool type wide; click 525 89 # a parameter set
    grep -q '"post": *"false"' a.json || fail "no set was saved"
    openscad -p a.json -P wide -o x.csg a.scad 2>&1 | grep -q "length = $length, post = false" ||
        fail "openscad reads another set"
    click 340 39; shot initial; same opened initial 300x450+0+0
    click 420 64; shot chooses; click 420 90; shot chosen; same long chosen 300x450+0+0
    click 578 89; ! grep -q wide a.json || fail "the set is still there"
    click 420 114; xdotool type posq; shot found; differ long found # letters are no commands
    xdotool key Escape; click 420 114; xdotool key ctrl+a key BackSpace key Escape; shot all
    { design 20; echo 'cube(1);'; } > a.scad # what was changed stays
    wait_for out "load [0-9]*:"; shot saved
    [ "$(tail -1 err)" = "ECHO: length = $length, post = false" ] || fail "after a save: $(tail -1 err)"
    { echo 'x = ;'; design 20; } > a.scad; wait_for err "Parser error"; shot broken
    design 20 > a.scad; sleep 1; shot mended; same long mended 300x450+0+0
    design 25 > a.scad; sleep 1; shot edited # the newer value counts
    [ "$(tail -1 err)" = "ECHO: length = 25, post = false" ] || fail "after another value: $(tail -1 err)"
    click 340 39; shot reset
    [ "$(tail -1 err)" = "ECHO: length = 25, post = true" ] || fail "after the reset: $(tail -1 err)"
    xdotool key u; quit
    ;;
*)
    echo "no case $case"
    exit 1
    ;;
esac
finish
