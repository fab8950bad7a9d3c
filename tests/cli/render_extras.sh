# render_extras.sh PROGRAM SOURCE - samples, alpha, fitting, views, numbers per pixel, comparison.
render=$1 source=$2
command -v convert >/dev/null || exit 77
. "$(dirname "$0")/scratch.sh"

# pixel FILE X,Y: "r,g,b,a"
pixel() {
    convert "$1" -depth 8 -crop "1x1+${2%,*}+${2#*,}" rgba:- | od -An -tu1 | tr -s ' ' ',' | sed 's/^,//'
}

# wrong TEXT ARGUMENTS...: usage that is told in one line with this text
wrong() {
    text=$1
    shift
    message=$("$render" "$@" -o wrong.png plate.csg 2>&1)
    [ $? -eq 1 ] || fault "$*: exit code"
    [ "$(printf '%s\n' "$message" | wc -l)" -eq 1 ] || fault "$*: several lines"
    printf '%s' "$message" | grep -qF -- "$text" || fault "$*: said $message"
    [ ! -e wrong.png ] || fault "$*: wrote a file"
}

# From above one pixel is 1 mm and the eye stands at z = 100.
above='--projection=o --camera=0,0,0,0,0,0,100 --imgsize=40,40'
above="$above --eps=0"
cat >plate.csg <<'CSG'
multmatrix([[1, 0, 0, -10], [0, 1, 0, -10], [0, 0, 1, 0], [0, 0, 0, 1]]) cube(size = [20, 20, 2]);
CSG
echo 'color([1, 0, 0, 0.25]) cube(size = [9, 9, 9]);' >glass.csg

# The borders of the plate are averaged, its inside is as without samples, with alpha nothing else.
# shellcheck disable=SC2086 # several words
{
    "$render" $above -o one.png plate.csg || fault 'one'
    "$render" $above --samples=1 -o same.png plate.csg || fault 'samples=1'
    cmp -s one.png same.png || fault 'one sample is another picture'
    "$render" $above --samples=16 --no-background -o alpha.png plate.csg || fault 'alpha'
    "$render" $above --samples=16 --no-background --threads=1 -o again.png plate.csg
}
cmp -s alpha.png again.png || fault 'alpha depends on the number of threads'
[ "$(identify -format '%[channels]' alpha.png)" = srgba ] || fault 'alpha: no alpha'
[ "$(pixel alpha.png 20,20)" = 194,167,34,255 ] || fault "alpha: inside $(pixel alpha.png 20,20)"
[ "$(pixel alpha.png 0,0)" = 0,0,0,0 ] || fault "alpha: outside $(pixel alpha.png 0,0)"
half=$(convert alpha.png -alpha extract -depth 8 gray:- | od -An -v -tu1 -w1 | sort -nu | sed -n 2p)
[ "$half" -gt 0 ] && [ "$half" -lt 255 ] || fault "alpha: no borders, $half"
"$render" --no-background -o glass.png glass.csg || fault 'glass'
convert glass.png -alpha extract -depth 8 gray:- | od -An -v -tu1 -w1 | sort -nu | tr '\n' ' ' |
    grep -q '^ *0  *112 *$' || fault 'glass: no alpha of 1 - 0.75 * 0.75' # both sides

# Ten free pixels; the other way round is looser.
for view in '' --projection=o; do
    # shellcheck disable=SC2086 # several words
    "$render" $view --fit=10 --imgsize=300,200 -o fit.png plate.csg || fault 'fit'
    box=$(convert fit.png -fill black +opaque '#ffffe5' -fill white -opaque '#ffffe5' -negate \
        -format %@ info:)
    case $box in
    *x180+*+10 | 280x*+10+*) ;;
    *) fault "fit: covers $box" ;;
    esac
done
"$render" --fit --imgsize=200,200 -o fit.png plate.csg || fault 'fit'
box=$(convert fit.png -fill black +opaque '#ffffe5' -fill white -opaque '#ffffe5' -negate \
    -format %@ info:)
case $box in
180x*+10+*) ;;
*) fault "fit of 5%: covers $box" ;;
esac

# A file per view, and all in one.
"$render" --views=top,front --projection=o --imgsize=100,50 -o 'part-%s.png' -o sheet.png plate.csg ||
    fault 'views'
[ "$(ls part-*)" = "$(printf 'part-front.png\npart-top.png')" ] || fault "views: $(echo part-*)"
[ "$(identify -format '%wx%h' part-top.png sheet.png)" = 100x50100x50 ] || fault 'views: sizes'
[ "$(pixel sheet.png 25,25)" = 194,167,34,255 ] || fault "sheet: top $(pixel sheet.png 25,25)"
[ "$(pixel sheet.png 75,25)" = "$(pixel part-front.png 50,25)" ] || fault 'sheet: front'
# In one scale with --fit too: a rod from its side and, as wide as it is thick, from its end. Names
# are written in the colour of the axes.
echo 'cube(size = [10, 40, 10], center = true);' >rod.csg
"$render" --views=left,front --fit=20 --projection=o --imgsize=400,200 -o sheet.png rod.csg ||
    fault 'views: fit'
for cell in '160x40 200x160+0+30' '40x40 200x160+200+30'; do
    box=$(convert sheet.png -crop "${cell#* }" +repage -fill black +opaque '#ffffe5' \
        -fill white -opaque '#ffffe5' -negate -format %@ info:)
    case $box in
    "${cell% *}"+*) ;;
    *) fault "views: fit: covers $box" ;;
    esac
done
[ "$(pixel sheet.png 5,4)" = "$(pixel sheet.png 6,4)" ] && [ "$(pixel sheet.png 5,4)" != \
    "$(pixel sheet.png 4,4)" ] || fault "views: no name: $(pixel sheet.png 5,4)"
"$render" --imgsize=20,20 -o 'x%s.png' plate.csg && [ -e 'x%s.png' ] || fault '%s without views'

# Depths from 98 mm on; 1 mm is 1 pixel.
cat >steps.csg <<'CSG'
multmatrix([[1, 0, 0, -10], [0, 1, 0, -10], [0, 0, 1, 0], [0, 0, 0, 1]]) cube(size = [20, 20, 2]);
multmatrix([[1, 0, 0, -10], [0, 1, 0, -10], [0, 0, 1, 0], [0, 0, 0, 1]]) cube(size = [10, 20, 4]);
CSG
for format in depthmap pfm normals ids; do
    # shellcheck disable=SC2086 # several words
    "$render" $above --export-format=$format -o $format steps.csg || fault "$format"
done
[ "$(identify -format '%[bit-depth] %[Depth nearest] %[Depth farthest]' depthmap)" = '16 96 98' ] ||
    fault "depthmap: $(identify -format '%[bit-depth] %[Depth nearest] %[Depth farthest]' depthmap)"
# shellcheck disable=SC2086
"$render" $above --summary --export-format=depthmap -o depthmap steps.csg |
    grep -q '^Depth: *96 to 98$' || fault 'summary: no depths'
greys=$(convert depthmap -depth 16 -endian MSB gray:- | od -An -v -tu2 --endian=big -w2 | sort -nu |
    tr -s '\n ' ' ')
[ "$greys" = ' 0 1 65535 ' ] || fault "depthmap: values$greys"
[ "$(head -c 16 pfm)" = "$(printf 'Pf\n40 40\n-1.0\n')" ] || fault 'pfm: head'
floats=$(tail -c 6400 pfm | od -An -v -tf4 -w4 | sort -u | tr -s '\n ' ' ')
[ "$floats" = ' 96 98 inf ' ] || fault "pfm: values$floats"
[ "$(pixel normals 20,20)" = 128,128,255,255 ] || fault "normals: $(pixel normals 20,20)"
colour=$(pixel ids 25,20 | awk -F, '{ printf "#%02x%02x%02x", $1, $2, $3 }')
identify -format '%[Legend]' ids | grep -q "^$colour steps.csg:1:" || fault 'ids: legend'
"$render" --imgsize=9,9 -o depths.pfm steps.csg || fault 'pfm by its extension'
echo '%cube(size = [10, 10, 9]);' | cat steps.csg - >marked.csg
# shellcheck disable=SC2086
"$render" $above --export-format=pfm -o marked.pfm marked.csg
cmp -s pfm marked.pfm || fault 'pfm: what is marked % counts'

# Readable shapes are bit-identical too.
"$render" --shading=ao,outline --samples=2 --threads=1 --imgsize=99,99 -o a.png steps.csg
"$render" --shading=ao,outline --samples=2 --threads=5 --imgsize=99,99 -o b.png steps.csg
cmp -s a.png b.png || fault 'shading depends on the number of threads'
"$render" --samples=2 --imgsize=99,99 --reference=a.png steps.csg 2>/dev/null && fault 'no shading'

# Comparison: 20 of 1600 pixels by 128, hence 1.25 %.
# shellcheck disable=SC2086 # several words
{
    "$render" $above --reference=one.png plate.csg || fault 'reference: differs from itself'
    convert one.png -fill '#fffe65' -draw 'rectangle 0,0 3,4' other.png
    message=$("$render" $above --reference=other.png -o written.png plate.csg 2>&1)
    [ $? -eq 3 ] || fault 'reference: exit code'
    [ -e written.png ] || fault 'reference: nothing written'
    [ "$message" = "hcsg-render: other.png: 20 of 1600 pixels differ (1.25 %), \
the largest difference is 128 at 0,0" ] || fault "reference: $message"
    for threshold in 128 0,1.25% 1,2% 255,100%; do
        "$render" $above --reference=other.png --threshold=$threshold plate.csg ||
            fault "threshold $threshold: differs"
    done
    for threshold in 127 0,1.24%; do
        "$render" $above --reference=other.png --threshold=$threshold plate.csg 2>/dev/null
        [ $? -eq 3 ] || fault "threshold $threshold: does not differ"
    done
    "$render" $above --imgsize=30,30 --reference=one.png plate.csg 2>/dev/null
    [ $? -eq 3 ] || fault 'reference of another size'
    "$render" $above --reference=none.png plate.csg 2>/dev/null
    [ $? -eq 1 ] || fault 'reference that is not there'
    "$render" $above --reference=plate.csg plate.csg 2>/dev/null
    [ $? -eq 1 ] || fault 'reference that is no picture'
}

wrong '--samples: expected 1 to 64' --samples=0
wrong '--samples: expected 1 to 64' --samples=65
wrong '--fit: expected pixels or percent' --fit=-1
wrong '--fit: expected pixels or percent' --fit=50%
wrong '--fit: expected pixels or percent' --fit=10,10
wrong '--fit: expected pixels or percent' --fit=10 --imgsize=20,20
wrong '--views: expected iso' --views=top,up
wrong '--views and --camera' --views=top --camera=0,0,0,0,0,0,9
wrong 'need a file each' --views=top --export-format=ids
wrong '--views: 2 views need more' --views=top,left --imgsize=1,1
wrong '--shading: expected ao' --shading=ao,
wrong '--threshold: nothing to compare' --threshold=1
for threshold in x 256 1.5 1,5 1,101% 1,5%%; do
    wrong '--threshold: expected' --reference=one.png --threshold=$threshold
done

# What file managers call, with a name that needs care.
line=$(sed -n 's/^Exec=hcsg-render //p' "$source/desktop/hcsg.thumbnailer")
cp plate.csg 'a b.csg'
# shellcheck disable=SC2086 # several words
set -- $line
for word; do
    shift
    word=$(printf '%s' "$word" | sed 's/%s/64/g; s/%i/a b.csg/; s/%o/thumb/')
    set -- "$@" "$word"
done
"$render" "$@" || fault 'thumbnail'
[ "$(identify -format '%m %wx%h' thumb)" = 'PNG 64x64' ] || fault 'thumbnail: is none'
exit $failed
