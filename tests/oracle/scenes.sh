#!/bin/sh
# scenes.sh EXPORT TEST FOLDER - exports the scenes of the bench and compares each with the oracle.
# Needs openscad; exits 77 (skipped) without it.
command -v openscad >/dev/null || exit 77
"$1" "$3" || exit 1
"$(dirname "$1")/scenes/instanced" "$3/instanced.csg" copies=20 n=48 || exit 1
status=0
for scene in "$3"/*.csg; do
    echo "$scene"
    "$2" "$scene" 64 64 || status=1
done
exit $status
