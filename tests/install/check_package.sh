#!/bin/sh
# Does an installed Cairn serve a program of its user's?
#
#   check_package.sh BUILD_DIR COMPILER VERSION
#
# Installs the build into an empty prefix, then, with nothing but that prefix: every public header compiles
# alone, without exceptions and run-time types; the README's example builds through find_package(cairn)
# and prints what the README says; and a program that leans on the headers' inline code gets the same state
# hash whether it is built plainly, with -O3 -ffast-math -march=native, or with the standard library's checks.
set -eu
build=$1
compiler=$2
version=$3
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"

echo "-- each public header by itself"
for header in "$work"/prefix/include/cairn/*.h; do
    name=cairn/$(basename "$header")
    # Twice: a header must bear that too.
    printf '#include <%s>\n#include <%s>\n' "$name" "$name" >"$work/alone.cpp"
    "$compiler" -std=c++20 -fsyntax-only -fno-exceptions -fno-rtti -Wall -Wextra -Wpedantic -Wshadow \
        -Wconversion -Werror -I "$work/prefix/include" "$work/alone.cpp"
done

echo "-- the README's example"
mkdir "$work/consumer"
cp "$here"/consumer/* "$work/consumer/"
awk '/<!-- example: end/ { inside = 0 } inside && !/^```/ { print } /<!-- example: begin/ { inside = 1 }' \
    "$root/README.md" >"$work/consumer/readme_example.cpp"
lines=$(grep -c . "$work/consumer/readme_example.cpp")
[ "$lines" -gt 5 ] || { echo "README.md has no example between its markers" >&2; exit 1; }

# build_consumer NAME FLAGS: a build of the user's programs, with these flags of the user's own.
build_consumer() {
    cmake -S "$work/consumer" -B "$work/$1" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" \
        -DCMAKE_PREFIX_PATH="$work/prefix" -DCAIRN_WANTED="$version" -DCMAKE_CXX_FLAGS="$2" \
        >"$work/$1.log" 2>&1 && cmake --build "$work/$1" >>"$work/$1.log" 2>&1 || {
        cat "$work/$1.log" >&2
        return 1
    }
}
build_consumer plain "-O2 -Wall -Wextra -Wpedantic -Werror"
said=$("$work/plain/readme_example")
echo "$said"
# The README shows what the example prints, between markers of its own.
promised=$(awk '/<!-- output: end/ { inside = 0 } inside && !/^```/ { print } /<!-- output: begin/ { inside = 1 }' \
    "$root/README.md")
if [ "$said" != "$promised" ]; then
    echo "the README promises: $promised" >&2
    exit 1
fi

echo "-- the same bits whatever the user's flags"
build_consumer unoptimised "-O0"
build_consumer fast "-O3 -ffast-math -march=native"
build_consumer checked "-O2 -D_GLIBCXX_ASSERTIONS"
expected=$("$work/plain/hash")
echo "plain        $expected"
for variant in unoptimised fast checked; do
    found=$("$work/$variant/hash")
    printf '%-12s %s\n' "$variant" "$found"
    [ "$found" = "$expected" ] || { echo "$variant differs from plain" >&2; exit 1; }
done
