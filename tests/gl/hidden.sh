#!/bin/bash
# hidden.sh PROGRAM RENDER - where a library of OpenGL is missing or no driver is, a context is refused
# with one line (PROGRAM, which needs one, says so and exits with 77), and hcsg-render draws as ever.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

refused() { # refused TEXT NAME=VALUE...
    local text=$1 status=0
    shift
    env "$@" "$program" >"$scratch/out" 2>"$scratch/err" || status=$?
    if [ $status != 77 ] || ! grep -q "^skipped: no OpenGL: $text" "$scratch/out"; then
        echo "hidden.sh: $*: status $status, expected 77 and '$text'"
        cat "$scratch/out" "$scratch/err"
        exit 1
    fi
    env "$@" "$render" -o "$scratch/cube.png" --imgsize 64,48 "$scratch/cube.csg"
    rm "$scratch/cube.png"
}

program=$1 render=$2
echo 'cube(size = [1, 2, 3], center = false);' >"$scratch/cube.csg"
mkdir "$scratch/egl" "$scratch/gl"
touch "$scratch/egl/libEGL.so.1" "$scratch/gl/libOpenGL.so.0" "$scratch/gl/libGL.so.1"
refused "libEGL.so.1 cannot be loaded" LD_LIBRARY_PATH="$scratch/egl"
"$program" >/dev/null || exit 77 # nothing here to hide
refused "libOpenGL.so.0 cannot be loaded" LD_LIBRARY_PATH="$scratch/gl"
refused ".*default display: no driver" __EGL_VENDOR_LIBRARY_FILENAMES=/dev/null
refused "device 0: no OpenGL 4.5 core" MESA_GL_VERSION_OVERRIDE=4.3
