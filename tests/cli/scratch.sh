# scratch.sh - sourced by the tests here: a folder of their own to work in, and a count of faults.
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failed=0

fault() {
    echo "FAILED: $*"
    failed=1
}
