#!/bin/sh
# check.sh SOURCE - compares the models that standard input lists, files below the current folder,
# and says which differ, but for those of SOURCE/exceptions.txt. The programs are in the path.
source=$1

sed '/^#/d; s/[[:space:]].*//; /^$/d' "$source/exceptions.txt" | sort >exceptions
tr '\n' '\0' | xargs -0 -n 1 -P "$(nproc)" sh "$source/compare.sh" | sort >results

result() { # KIND: the models with that result
    awk -F '\t' -v kind="$1" '$2 == kind { print $1 }' results | sort
}
result fail >failed
result pass | comm -12 - exceptions >passed
comm -23 failed exceptions | while read -r model; do
    awk -F '\t' -v model="$model" '$1 == model { print "FAILED:", $1, $3 }' results
done
sed 's/^/FAILED: passes, but is in exceptions.txt: /' passed
printf '%s pass, compared by' "$(result pass | wc -l)"
awk -F '\t' '$2 == "pass" { n[$3]++ } END { for (how in n) printf " %s %d", how, n[how] }' results
printf '; %s are exceptions; OpenSCAD makes nothing of %s\n' \
    "$(comm -12 failed exceptions | wc -l)" "$(result none | wc -l)"
[ -s results ] && [ ! -s passed ] && [ -z "$(comm -23 failed exceptions)" ]
