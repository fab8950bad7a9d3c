# render_errors.sh PROGRAM SOURCE - wrong use and bad input: one clear line and the right exit code.
render=$1
. "$(dirname "$0")/scratch.sh"

# expect CODE TEXT ARGUMENTS...: the exit code, one line on stderr that holds TEXT, no out.png.
expect() {
    code=$1 text=$2
    shift 2
    timeout 60 "$render" "$@" >stdout 2>stderr
    got=$?
    [ $got -eq "$code" ] || fault "$*: exit code $got, not $code"
    [ "$(wc -l <stderr)" -eq 1 ] || fault "$*: $(wc -l <stderr) lines of errors"
    grep -qF -- "$text" stderr || fault "$*: '$(cat stderr)' does not say '$text'"
    [ -e out.png ] && fault "$*: left out.png"
    rm -f out.png
}

echo 'cube(size = [10, 10, 10], center = false);' >a.csg
mkdir folder

# Use
expect 1 'no input file' -o out.png
expect 1 'name of an input file' -o out.png ''
expect 1 '--output: expected the name of a file' -o '' a.csg
expect 1 'expected one input file, got 2: a.csg, b.csg; outputs are named with -o' -o out.png a.csg b.csg
expect 1 'got 3: a.csg, out.png, ...; outputs are named with -o' a.csg out.png b.png
expect 1 'no output; give -o' a.csg
expect 1 'expected FILE after it' a.csg -o
expect 1 'unknown option --imagesize; did you mean --imgsize?' --imagesize=3,3 -o out.png a.csg
expect 1 'unknown option -z' -z -o out.png a.csg
expect 1 'out.jpg: cannot write .jpg files, only png, depthmap, pfm, normals, ids, stl, off, dxf or param' -o out.jpg a.csg
for size in 0,5 5,0 -1,5 5 5,5,5 a,b '' 1e3,5 40000,1 32768,32768 99999999999999999999,5; do
    expect 1 '--imgsize: expected' "--imgsize=$size" -o out.png a.csg
done
for camera in '' 1 1,2,3,4,5 1,2,3,4,5,6,7,8 a,b,c,d,e,f 1,2,3,4,5,nan 0,0,0,0,0,0,-1; do
    expect 1 '--camera: ' "--camera=$camera" -o out.png a.csg
done
expect 1 'distance must be above 0' --camera=1,1,1,1,1,1 -o out.png a.csg
expect 1 "--projection: expected" --projection=x -o out.png a.csg
expect 1 "no colour scheme 'corn'; there are: Cornfield, Metallic" --colorscheme=corn -o out.png a.csg
expect 1 '--transparency: expected file or sorted' --transparency=depth -o out.png a.csg
expect 1 '--device: expected auto, cpu or gl' --device=gpu -o out.png a.csg
expect 1 '--threads: expected' --threads=-1 -o out.png a.csg
expect 1 '--eps: expected' --eps=-1 -o out.png a.csg
expect 1 '--memory: expected' --memory=0 -o out.png a.csg

# Input
expect 1 'missing.csg: No such file' -o out.png missing.csg
expect 1 'folder: ' -o out.png folder
expect 1 'missing.scad' -o out.png missing.scad
if [ "$(id -u)" -ne 0 ]; then
    echo 'cube();' >closed.csg
    chmod 000 closed.csg
    expect 1 'closed.csg: Permission denied' -o out.png closed.csg
fi

mkfifo slow
(exec >slow && sleep 0.3 && cat a.csg) &
"$render" --summary slow | grep -q '^Leaves: *1$' || fault 'slow: not read'
wait

# Output
expect 2 'none/out.png: No such file' -o none/out.png a.csg
expect 2 'folder: ' -o folder a.csg
expect 2 'none/b.png: No such file' -o b.png -o none/b.png -o c.png a.csg
cmp -s b.png c.png || fault 'several outputs: not the same picture twice'
rm -f b.png c.png
[ -w /dev/full ] && expect 2 '/dev/full: No space left' -o /dev/full a.csg
"$render" -o - a.csg >&- 2>stderr
[ $? -eq 2 ] || fault 'closed standard output: wrong exit code'
grep -q 'standard output: ' stderr || fault "closed standard output: '$(cat stderr)'"
if [ -w /dev/full ]; then
    for arguments in '-o - a.csg' '--help' '--version' '--summary a.csg'; do
        # shellcheck disable=SC2086 # several words
        "$render" $arguments >/dev/full 2>stderr
        [ $? -eq 2 ] || fault "$arguments to a full disk: another exit code than 2"
        [ "$(wc -l <stderr)" -eq 1 ] || fault "$arguments to a full disk: '$(cat stderr)'"
    done
fi

(ulimit -f 1 && expect 2 'large.png: File too large' --imgsize=4000,4000 -o large.png a.csg
    exit $failed) || failed=1

# A link stays one, and the mode of the file stays.
echo old >private.png
chmod 600 private.png
ln -s private.png link.png
"$render" -o link.png a.csg || fault 'link.png: not written'
[ -L link.png ] && [ "$(stat -c %a private.png)" = 600 ] && [ "$(wc -c <private.png)" -gt 100 ] ||
    fault 'link.png: not written through'
rm -f link.png private.png
mkdir elsewhere
ln -s elsewhere/new.png first.png
ln -s first.png link.png
"$render" -o link.png a.csg || fault 'link.png: not written where nothing is yet'
[ -L link.png ] && [ -L first.png ] && [ -s elsewhere/new.png ] || fault 'link.png: not followed'
rm -r link.png first.png elsewhere
ln -s loop.png loop.png
expect 2 'loop.png: ' -o loop.png a.csg
rm -f loop.png
if [ "$(id -u)" -ne 0 ]; then
    echo old >out.png
    chmod 444 out.png
    "$render" -o out.png a.csg 2>/dev/null
    [ $? -eq 2 ] && [ "$(cat out.png)" = old ] || fault 'a file that is read-only was written'
    rm -f out.png
    mkdir closed
    chmod 555 closed
    expect 2 'closed/x.png: Permission denied' -o closed/x.png a.csg
    rmdir closed
fi

# A failure keeps the picture that was there, and no temporary file stays.
echo old >out.png
"$render" -o out.png missing.csg 2>/dev/null
[ "$(cat out.png)" = old ] || fault 'a failure changed out.png'
rm -f out.png
[ -z "$(find . -name '*.png*')" ] || fault "left behind: $(find . -name '*.png*')"
exit $failed
