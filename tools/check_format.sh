#!/bin/sh
# Whether every source is formatted as .clang-format says; names those that are not. `--fix` formats them.
# With clang-format 14, Debian 12's: other versions lay some lines out otherwise.
set -eu
cd "$(dirname "$0")/.."
format=$(command -v clang-format-14 || command -v clang-format) || {
    echo "clang-format is not installed" >&2
    exit 1
}
mode="--dry-run -Werror"
[ "${1:-}" = --fix ] && mode="-i"
# shellcheck disable=SC2086  # the mode is two words
find src include tools tests bench fuzz \( -name '*.h' -o -name '*.cpp' \) -print0 |
    xargs -0 -n 8 -P 2 "$format" --style=file $mode
