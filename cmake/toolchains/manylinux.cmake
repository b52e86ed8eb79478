# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0

# Any Linux with glibc 2.17 or later, on the machine RONDEL_MACHINE: Zig's Clang, which has the names of every
# version of glibc, with its C++ library linked in. scripts/package wheels installs it in build/packages/zig and
# unpacks the headers (docs/decisions/024-packages.md).
set(rondel_build "${CMAKE_CURRENT_LIST_DIR}/../../build")
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${RONDEL_MACHINE})
set(CMAKE_CXX_COMPILER ${rondel_build}/packages/zig/c++)
set(CMAKE_AR ${rondel_build}/packages/zig/ar)
set(CMAKE_RANLIB ${rondel_build}/packages/zig/ranlib)
set(CMAKE_LIBRARY_ARCHITECTURE ${RONDEL_MACHINE}-linux-gnu)
set(CMAKE_FIND_ROOT_PATH ${rondel_build}/targets/sysroot/${RONDEL_MACHINE}-manylinux)
string(JOIN " " CMAKE_CXX_FLAGS_INIT
  -target ${RONDEL_MACHINE}-linux-gnu.2.17
  -isystem ${CMAKE_FIND_ROOT_PATH}/usr/include
  -isystem ${CMAKE_FIND_ROOT_PATH}/usr/include/${RONDEL_MACHINE}-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)  # nanobind is a part of Python's environment
# Debian's libz.a is for programs: in a module it fits where no other library can replace its names.
set(CMAKE_MODULE_LINKER_FLAGS_INIT -Wl,-Bsymbolic)
set(ZLIB_LIBRARY ${CMAKE_FIND_ROOT_PATH}/usr/lib/${RONDEL_MACHINE}-linux-gnu/libz.a)
# What the machine's vectors can do is asked of GCC's library, which has no name of the C library.
if(RONDEL_MACHINE STREQUAL x86_64)
  execute_process(COMMAND x86_64-linux-gnu-gcc -print-libgcc-file-name OUTPUT_VARIABLE CMAKE_CXX_STANDARD_LIBRARIES
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
# What the environment has: no library of another compiler fits.
set(CMAKE_DISABLE_FIND_PACKAGE_TBB ON)
