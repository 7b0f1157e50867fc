#!/usr/bin/env bash
# clang-tidy over the library and the command line, with .clang-tidy's checks; clang's own build says how
# each file is compiled, so build/clang must have been configured (`cmake --preset clang`).
set -euo pipefail
cd "$(dirname "$0")/.."
tidy=$(command -v clang-tidy-14 || command -v clang-tidy) || {
    echo "clang-tidy is not installed" >&2
    exit 1
}
find src tools -name '*.cpp' -print0 | xargs -0 -n 2 -P "$(nproc 2>/dev/null || echo 2)" \
    "$tidy" -p build/clang --quiet 2>&1 | { grep -v ' warnings\? generated\.$' || true; }
