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
grep -q sleep "$5" && sleep 30
grep "^//" "$5" | cut -c 3- >&2
grep -v "^//" "$5" > "$2"
printf '%s: \\\n\t%s\n' "$2" "$5" > "$4"
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
*)
    echo "no case $case"
    exit 1
    ;;
esac
finish
