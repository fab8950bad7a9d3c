#!/bin/sh
# agree.sh TEST SIDE OPTIONS FOLDER [EXPORT] - compares the gl device with the other one on the .csg files
# of a folder, in pictures SIDE pixels wide. EXPORT writes them there with openscad; skipped without it.
if [ $# -gt 4 ]; then
    command -v openscad >/dev/null || exit 77
    "$5" "$4" || exit
fi
status=0
for file in "$4"/*.csg "$4"/*/*.csg; do
    [ -e "$file" ] || continue
    echo "$file"
    "$1" agree "$file" "$2" "$2" $3 --device gl
    result=$?
    [ $result != 77 ] || exit 77
    [ $result = 0 ] || status=1
done
exit $status
