# The flags that every target of the project builds with. Users of the installed library get none of
# them: the library's own code is compiled already.
function(cairn_target name)
  target_compile_options(${name} PRIVATE
    -ffp-contract=off -fno-fast-math -Wall -Wextra -Wpedantic -Wshadow -Wdouble-promotion
    -Wfloat-conversion -Wnon-virtual-dtor -Werror)
endfunction()
