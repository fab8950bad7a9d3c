#!/bin/bash
# device.sh HCSG-RENDER SHADERS - what --device means: where OpenGL is, where it cannot be loaded, and
# with shaders from a folder.
set -eu
render=$1 shaders=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
fault() {
    echo "device.sh: $*"
    exit 1
}
cat >part.csg <<'END'
difference() {
	cube(size = [10, 10, 10], center = true);
	color([1, 0, 0, 0.5]) sphere($fn = 16, r = 6);
	multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cylinder($fn = 12, h = 30, r1 = 2, r2 = 1, center = true);
}
END
size=--imgsize=120,90
"$render" --device=cpu $size -o cpu.png part.csg

mkdir none
touch none/libEGL.so.1
status=0
LD_LIBRARY_PATH=none "$render" --device=gl $size -o none.png part.csg 2>stderr || status=$?
[ $status = 1 ] && [ "$(wc -l <stderr)" = 1 ] && [ ! -e none.png ] &&
    grep -q -- '--device=gl: no OpenGL: libEGL.so.1 cannot be loaded' stderr ||
    fault "gl without EGL: $status '$(cat stderr)'"
LD_LIBRARY_PATH=none "$render" --device=auto $size -o auto.png part.csg 2>stderr && [ ! -s stderr ] &&
    cmp auto.png cpu.png || fault "auto without EGL: '$(cat stderr)'"
LD_LIBRARY_PATH=none "$render" --info --device=auto >info
grep -q '^Draws with: cpu; not gl: no OpenGL: libEGL' info || fault "--info: '$(cat info)'"
"$render" --info | grep -qx 'Draws with: cpu' || fault '--info without a device'

status=0
"$render" --info --device=gl >info || status=$?
grep -q '^Draws with: gl, .*OpenGL 4' info || exit 77
"$render" --device=gl $size -o gl.png --reference=cpu.png --threshold=0,0.1% part.csg ||
    fault 'gl draws another picture'

cp -r "$shaders" own
HCSG_SHADERS=own "$render" --device=gl $size -o own.png part.csg 2>stderr && [ ! -s stderr ] &&
    cmp own.png gl.png || fault "shaders of a folder: '$(cat stderr)'"
sed -i '2i no such thing' own/frame.glsl
HCSG_SHADERS=own "$render" --device=gl $size -o own.png part.csg 2>stderr && cmp own.png cpu.png &&
    [ "$(wc -l <stderr)" = 1 ] && grep -q '^warning: shaders/frame.glsl:2: .*the processor draws' stderr ||
    fault "a wrong shader: '$(cat stderr)'"
