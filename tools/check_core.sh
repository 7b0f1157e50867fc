#!/bin/sh
# What must not be found in the sources, because it would break a promise that no test can hold alone.
#
# - the core (every room of src/ but scene/) gives the same bits on every machine: no mathematical function
#   of the C library but those that are exact (sqrt, abs, floor, ceil, isfinite ...), no <random>, no
#   container whose order depends on addresses or hashing;
# - it is a guest in its host: throws nothing, prints nothing, never ends the process, and starts no
#   thread but where src/base/os_thread does, for a user who asked for some;
# - scene files and built-in scenes reach worlds, so scene/ keeps to the first of these too, all but its
#   results and its replay, which only look on;
# - files are of a size that can be read: 600 lines, no tabs, no space at a line's end;
# - nothing is left for later, and no path of one person's machine is in a file.
# Prints file, line and reason for each, and fails where there is one.
set -eu
cd "$(dirname "$0")/.."

find src include -name '*.h' -o -name '*.cpp' | sort | xargs awk '
    function complain(why) { printf "%s:%d: %s\n    %s\n", FILENAME, FNR, why, $0; bad = 1 }
    {
        core = FILENAME !~ /^src\/scene\//
        looks_on = FILENAME ~ /^src\/scene\/(replay|result)/
        code = $0
        sub(/\/\/.*/, "", code)
        gsub(/"([^"\\]|\\.)*"/, "\"\"", code)
    }
    !looks_on && code ~ /(std::|[^A-Za-z0-9_:.>])(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|fma|lerp|tgamma|lgamma|erf)f?l? *\(/ {
        complain("a libm function that differs between C libraries; src/math has the ones to use")
    }
    code ~ /<random>|std::rand|[^A-Za-z0-9_]s?rand *\(|random_device|mt19937/ {
        complain("random numbers differ between standard libraries; use a generator of our own")
    }
    !looks_on && code ~ /unordered_(map|set|multi)/ { complain("the order of its elements is nobody'"'"'s promise") }
    core && code ~ /(^|[^A-Za-z0-9_])(throw|try|catch|dynamic_cast|typeid)([^A-Za-z0-9_]|$)/ {
        complain("the core builds without exceptions and run-time types")
    }
    core && code ~ /<(iostream|cstdio|stdio\.h|fstream|thread|future)>|std::(cout|cerr|clog|exit|abort|terminate)|[^A-Za-z0-9_](printf|puts|exit|abort) *\(/ &&
        FILENAME !~ /^src\/base\/assert/ {
        complain("the library prints nothing, never ends the process and starts no thread")
    }
    code ~ /<pthread\.h>/ && FILENAME !~ /^src\/base\/os_thread/ {
        complain("threads are started in src/base/os_thread alone")
    }
    END { exit bad }' && core_is_clean=yes || core_is_clean=no

find . \( -name node_modules -o -name build -o -name 'build-*' -o -name .git \) -prune -o -type f \( \
    -name '*.h' -o -name '*.cpp' -o -name '*.cmake' -o -name '*.txt' -o -name '*.sh' -o -name '*.py' \
    -o -name '*.js' -o -name '*.mjs' -o -name '*.css' -o -name '*.html' -o -name '*.md' -o -name run \
    -o -name test \) -print | sed 's|^\./||' | sort -u | xargs awk '
    function complain(why) { printf "%s:%d: %s\n    %s\n", FILENAME, FNR, why, $0; bad = 1 }
    { code = FILENAME ~ /\.(h|cpp|mjs|js)$/; document = FILENAME ~ /\.md$/ }
    code && FNR == 601 { complain("past 600 lines: split it where its question splits") }
    /\t/ && !/\\t/ { complain("a tab") }
    !document && /[ ]+$/ { complain("space at the end of the line") }
    FILENAME !~ /check_core/ && /TODO|FIXME|(^|[^X])XXX([^X]|$)|(^|[^A-Za-z])HACK/ { complain("left for later") }
    FILENAME !~ /check_core/ && /["'"'"' ](\/home|\/root|\/Users)\// { complain("a path of one machine") }
    END { exit bad }' && files_are_clean=yes || files_are_clean=no

[ "$core_is_clean$files_are_clean" = yesyes ] || exit 1
echo "Nothing that must not be there."
