#!/bin/sh
# Which room includes which: holds the sources to tools/layers.txt.
#
#   tools/check_layers.sh          fails, with file and line, where an include crosses a wall, or where the
#                                  map in ARCHITECTURE.md is not the one that the list gives
#   tools/check_layers.sh --map    prints that map
#   tools/check_layers.sh --write  writes it into ARCHITECTURE.md
#
# Includes in quotes are those of the project; those in angle brackets are the system's. A file belongs to
# the longest room that its path begins with: src/solver/xpbd/rows.cpp to solver/xpbd.
set -eu
cd "$(dirname "$0")/.."
list=tools/layers.txt

print_map() {
    echo '```text'
    awk -F'|' '!/^#/ && NF == 3 {
        gsub(/^ +| +$/, "", $1); gsub(/^ +| +$/, "", $2); gsub(/^ +| +$/, "", $3)
        count = split($2, allowed, " "); sees = ""
        for (i = 1; i <= count; i++)
            if (allowed[i] != "public" && allowed[i] !~ /^cairn\//)
                sees = sees (sees == "" ? "" : " ") allowed[i]
        if (sees == "") sees = "nothing"
        if ($1 == "world") sees = "every room above"
        if ($1 == "scene") sees = "the public headers alone"
        printf "src/%-26s%s\n%-30s  sees %s\n", $1 "/", $3, "", sees
    }' "$list"
    echo '```'
}

case "${1:-}" in
    --map) print_map; exit 0 ;;
    --write)
        print_map >ARCHITECTURE.map
        awk '/<!-- map: begin/ { print; while ((getline line < "ARCHITECTURE.map") > 0) print line; skip = 1 }
             /<!-- map: end/ { skip = 0 } !skip && !/<!-- map: begin/ { print }' \
            ARCHITECTURE.md >ARCHITECTURE.new
        mv ARCHITECTURE.new ARCHITECTURE.md
        rm ARCHITECTURE.map
        exit 0 ;;
    "") ;;
    *) echo "usage: $0 [--map|--write]" >&2; exit 2 ;;
esac

failed=0
find src tools bench -name '*.h' -o -name '*.cpp' | sort | xargs awk -v list="$list" '
    BEGIN {
        plain = " types ids settings shape body report result threads trace version "
        while ((getline line < list) > 0) {
            if (line ~ /^#/ || split(line, column, "|") != 3) continue
            gsub(/ /, "", column[1])
            gsub(/ +/, " ", column[2])
            allowed[column[1]] = " " column[2] " "
        }
        # Programs outside src/ stand on the public headers and the scene room.
        allowed["tools"] = allowed["bench"] = " public scene cairn/world.h cairn/cairn.h cairn/math.h "
    }
    function room_of(path,   parts, count) {
        sub(/^src\//, "", path)
        count = split(path, parts, "/")
        if (count > 2 && (parts[1] "/" parts[2]) in allowed) return parts[1] "/" parts[2]
        return parts[1]
    }
    FNR == 1 {
        room = room_of(FILENAME)
        if (!(room in allowed) && !reported[room]++) {
            printf "%s:1: %s is not in %s\n", FILENAME, room, list
            bad = 1
        }
    }
    /^[ \t]*#[ \t]*include[ \t]*"/ {
        target = $0
        sub(/^[^"]*"/, "", target); sub(/".*/, "", target)
        if (target !~ /\//) next   # a neighbour in the same folder
        if (target ~ /^cairn\//) {
            name = target
            sub(/^cairn\//, "", name); sub(/\.h$/, "", name)
            if (index(plain, " " name " ") && index(allowed[room], " public ")) next
            if (index(allowed[room], " " target " ")) next
            printf "%s:%d: %s may not include %s\n", FILENAME, FNR, room, target
            bad = 1
            next
        }
        other = room_of("src/" target)
        if (other == room || index(allowed[room], " " other " ")) next
        printf "%s:%d: %s may not include %s (it may:%s)\n", FILENAME, FNR, room, target, allowed[room]
        bad = 1
    }
    END { exit bad }' || failed=1

if [ -f ARCHITECTURE.md ]; then
    if [ "$(awk '/<!-- map: end/ { inside = 0 } inside { print } /<!-- map: begin/ { inside = 1 }' \
        ARCHITECTURE.md)" != "$(print_map)" ]; then
        echo "ARCHITECTURE.md: its map is not that of $list: run tools/check_layers.sh --write"
        failed=1
    fi
fi
[ "$failed" = 0 ] && echo "Every include keeps to $list."
exit "$failed"
