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

"$@" >"$work/printed" || { tail -n 5 "$work/printed"; echo "failed: $*"; exit 1; }
grep '^#' "$work/printed" || true
grep -v '^#' "$work/printed" >"$work/found" || true
grep -v -e '^#' -e '^builtin/' "$golden" >"$work/expected" || true
[ -s "$work/found" ] || { echo "it printed no hash"; exit 1; }
if ! diff "$work/expected" "$work/found" >"$work/difference"; then
    head -n 50 "$work/difference"
    exit 1
fi
echo "$(wc -l <"$work/found") lines, all as in the golden file"
