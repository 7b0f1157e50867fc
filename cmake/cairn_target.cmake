# The flags that every target of the project builds with. Users of the installed library get none of
# them: the library's own code is compiled already. Only gcc is asked for promotions to binary64: it means
# those by accident, clang also a double that is made from a float on purpose.
function(cairn_target name)
  target_compile_options(${name} PRIVATE
    -ffp-contract=off -fno-fast-math -Wall -Wextra -Wpedantic -Wshadow
    # gcc 12 drops both roundings of two neighbouring double(float(x)) when it packs them in a vector.
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
    # libstdc++ 12's stable_sort calls what it has deprecated itself; later clangs lay that to its callers.
    $<$<AND:$<CXX_COMPILER_ID:Clang>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,15>>:-Wno-deprecated-declarations>
    $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>
    $<$<CXX_COMPILER_ID:Clang>:-Wreserved-identifier> -Wfloat-conversion -Wnon-virtual-dtor -Werror)
endfunction()
