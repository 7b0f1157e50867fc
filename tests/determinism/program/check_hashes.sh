#!/bin/sh
# Whether a build's hash_scenes prints the hashes of the golden file.
#
#   check_hashes.sh golden_hashes.txt COMMAND...
#
# Prints the widths that were compared, and each line that differs: < the file's, > the build's. The file's
# lines of built-in scenes are golden.cpp's alone: those scenes need more than the library.
set -eu
golden=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$@" >"$work/printed"
grep '^#' "$work/printed"
grep -v '^#' "$work/printed" >"$work/found" || true
grep -v -e '^#' -e '^builtin/' "$golden" >"$work/expected" || true
if ! diff "$work/expected" "$work/found" >"$work/difference"; then
    cat "$work/difference"
    exit 1
fi
[ -s "$work/found" ] || { echo "nothing was compared"; exit 1; }
echo "$(wc -l <"$work/found") lines, all as in the golden file"
