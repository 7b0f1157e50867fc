#!/bin/sh
# Whether every file that a document points to, as a link or a picture, is there.
set -eu
cd "$(dirname "$0")/.."
failed=0
for document in $(find . \( -name node_modules -o -name build -o -name .git \) -prune \
    -o -name '*.md' -print | sort); do
    for target in $(grep -o '](\([^)]*\))' "$document" | sed 's/^](//; s/)$//; s/#.*//' |
        grep -v -E '^(https?:|mailto:)' | sort -u); do
        [ -e "$(dirname "$document")/$target" ] && continue
        echo "$document: $target is not there"
        failed=1
    done
done
[ "$failed" = 0 ] && echo "Every link leads somewhere."
exit "$failed"
