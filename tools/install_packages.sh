#!/bin/sh
# What Cairn needs from the system, and how to get it.
#
#   tools/install_packages.sh run     what building and running the command line takes
#   tools/install_packages.sh test    that, and all that the tests use
#
# Prints what is missing before it installs anything. Installs with apt where there is apt, through sudo
# where the user is not root; elsewhere prints the list and fails. Does nothing where nothing is missing.
# Needs nothing but a POSIX shell.
set -eu

run_packages="g++ cmake ninja-build nlohmann-json3-dev libcli11-dev libfmt-dev libjs-three"
# Compilers and checkers; doctest; the oracles of the collision tests; the browser of the replay test.
test_packages="$run_packages ccache clang clang-format clang-tidy libclang-rt-14-dev llvm-14
    doctest-dev libfcl-dev libccd-dev libeigen3-dev python3 python3-jsonschema chromium ca-certificates nodejs npm"
# What builds and runs for other machines; left out, with a word, where apt knows no such package. `./test`
# then leaves out the checks that use it.
foreign_packages="clang-19 lld-19 wasi-libc libclang-rt-19-dev-wasm32 libc++-19-dev-wasm32 libc++abi-19-dev-wasm32
    g++-aarch64-linux-gnu qemu-user"

optional=
case "${1:-}" in
    run) wanted=$run_packages ;;
    test) wanted=$test_packages optional=$foreign_packages ;;
    *) echo "usage: $0 run|test" >&2; exit 2 ;;
esac

# True where a Debian package, or a program that stands for it, is there.
is_installed() {
    case "$1" in
        # These also come from elsewhere than Debian, under other package names.
        npm) command -v npm >/dev/null 2>&1 && return 0 ;;
        nodejs) command -v node >/dev/null 2>&1 && return 0 ;;
        qemu-user) command -v qemu-aarch64 >/dev/null 2>&1 && return 0 ;;
    esac
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# Without dpkg the programs and headers themselves are asked for; prints the packages that stand for
# what was not found.
list_missing_without_dpkg() {
    for pair in g++:g++ cmake:cmake ninja:ninja-build; do
        command -v "${pair%%:*}" >/dev/null 2>&1 || echo "${pair#*:}"
    done
    if command -v g++ >/dev/null 2>&1; then
        for pair in nlohmann/json.hpp:nlohmann-json3-dev CLI/CLI.hpp:libcli11-dev \
            fmt/format.h:libfmt-dev; do
            echo "#include <${pair%%:*}>" | g++ -x c++ -E - >/dev/null 2>&1 || echo "${pair#*:}"
        done
    fi
    # Missing doctest and three.js are named by CMake, with the place where they were looked for.
}

if ! command -v apt-get >/dev/null 2>&1 || ! command -v dpkg-query >/dev/null 2>&1; then
    missing=$(list_missing_without_dpkg | tr '\n' ' ')
    [ -z "$missing" ] && exit 0
    echo "Missing here, by the names of their Debian packages: $missing" >&2
    echo "There is no apt on this machine: install them in its own way, then try again. All that is" >&2
    echo "used: $(echo $wanted)" >&2
    exit 1
fi

missing=
for package in $wanted; do
    is_installed "$package" || missing="$missing $package"
done
wished=
for package in $optional; do
    is_installed "$package" || wished="$wished $package"
done

is_known() { apt-cache show "$1" >/dev/null 2>&1; }

# Adds those that are wished for to those that are missing, where apt's lists have them.
sort_wishes() {
    for package in $wished; do
        if is_known "$package"; then
            missing="$missing $package"
        else
            echo "Not in apt's lists, so what uses it is left out: $package"
        fi
    done
    wished=
}
# A fresh system has no lists yet: they say nothing before they are fetched.
is_known g++ && sort_wishes
[ -z "$missing$wished" ] && exit 0

# shellcheck disable=SC2086  # words, with one space between
echo "Missing, and to be installed with apt:" $missing $wished
as_root=
if [ "$(id -u)" != 0 ]; then
    if ! command -v sudo >/dev/null 2>&1; then
        echo "That takes root, and there is no sudo here. As root:" >&2
        echo "  apt-get update && apt-get install --no-install-recommends$missing$wished" >&2
        exit 1
    fi
    as_root="sudo"
fi

# A machine that lives for one run of the tests need not have every file on its disk at once.
unsafe=
[ "${CI:-}" = true ] && unsafe="-o Dpkg::Options::=--force-unsafe-io"

# Runs apt-get with its noise put aside, to be shown only where it fails.
log=$(mktemp)
trap 'rm -f "$log"' EXIT
quiet_apt() {
    # shellcheck disable=SC2086  # options are meant to be split
    if ! $as_root env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 \
        -o Acquire::Retries=3 $unsafe "$@" >"$log" 2>&1 </dev/null; then
        echo "apt-get $* failed:" >&2
        tail -n 25 "$log" >&2
        return 1
    fi
}
quiet_apt -q update
sort_wishes
[ -z "$missing" ] && exit 0
# shellcheck disable=SC2086  # the list is meant to be split
quiet_apt -q -y install --no-install-recommends $missing
echo "Installed."
