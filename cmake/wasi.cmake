# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0

# Toolchain of wasm32-wasi with Debian's clang-19, lld-19, libc++ and wasi-libc (scripts/tools/packages/js.txt).
# There are no threads and no files. Exceptions are those of WebAssembly; what Debian's libc++abi lacks
# for them is the target rondel_wasm_exceptions (bindings/js/exceptions), which every program links.
# Vectors of 128 bits are in every engine since 2023, as these exceptions are; copies and fills of memory, and
# conversions to integers that never trap, are older.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_AR llvm-ar-19)
set(CMAKE_RANLIB llvm-ranlib-19)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_EXECUTABLE_SUFFIX_CXX .wasm)
set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)

set(features "-fwasm-exceptions -msimd128 -mbulk-memory -mnontrapping-fptoint")
set(CMAKE_C_FLAGS_INIT "${features}")
set(CMAKE_CXX_FLAGS_INIT "${features}")

# A stack that overflows traps, as it begins where memory does, instead of writing over data.
set(CMAKE_EXE_LINKER_FLAGS_INIT
    "-Wl,-z,stack-size=1048576 -Wl,--stack-first -Wl,--max-memory=4294967296")

set(RONDEL_PARALLEL OFF CACHE BOOL "WebAssembly has no threads here")
