# For WebAssembly with 128-bit vectors, by Debian's clang-19, lld-19, wasi-libc, libclang-rt-19-dev-wasm32,
# libc++-19-dev-wasm32 and libc++abi-19-dev-wasm32; what is built runs in node.
#
# "Generic" is what CMake calls a machine that it has no rules for.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
# Debian's C++ library for WebAssembly is built without exceptions, and the core throws none.
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fno-exceptions")
set(CMAKE_AR llvm-ar-14)
set(CMAKE_RANLIB llvm-ranlib-14)
set(CMAKE_EXECUTABLE_SUFFIX_CXX .wasm)
set(CMAKE_CROSSCOMPILING_EMULATOR node --no-warnings ${CMAKE_CURRENT_LIST_DIR}/run_wasi.mjs)
