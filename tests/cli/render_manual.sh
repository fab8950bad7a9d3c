# render_manual.sh PROGRAM SOURCE - the manual and --help name the same options and schemes.
render=$1 manual=$2/docs/hcsg-render.1
failed=0

"$render" --help | grep -oE -- '--[a-z-]+' | sort -u >help.$$
sed -n 's/^\.It Fl \(.* Fl \)\{0,1\}-\([a-z-]*\).*/--\2/p' "$manual" | sort -u >manual.$$
if ! cmp -s help.$$ manual.$$; then
    echo 'FAILED: options differ between --help and the manual'
    diff help.$$ manual.$$
    failed=1
fi
rm -f help.$$ manual.$$

HOME=/none XDG_CONFIG_HOME=/none "$render" --colorscheme=none -o x.png x.csg 2>&1 | sed 's/.*there are: //; s/, /\n/g' |
    while read -r scheme; do
        grep -q "^\.Cm $scheme\b" "$manual" || echo "FAILED: the manual lacks the scheme $scheme"
    done | grep . && failed=1

"$render" --version | grep -q '^hcsg-render [0-9]' || failed=1
exit $failed
