# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0

# Linux on `machine`, which the file that includes this one names, by Debian's cross compiler, with the libraries that
# scripts/same-bytes --targets unpacks; programs run in QEMU.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${machine})
set(CMAKE_CXX_COMPILER ${machine}-linux-gnu-g++-12)
set(CMAKE_C_COMPILER ${machine}-linux-gnu-gcc-12)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-${machine}-static;-L;/usr/${machine}-linux-gnu)
set(CMAKE_FIND_ROOT_PATH "${CMAKE_CURRENT_LIST_DIR}/../../build/targets/sysroot/${machine}-linux")
set(CMAKE_CXX_FLAGS_INIT "-isystem ${CMAKE_FIND_ROOT_PATH}/usr/include/${machine}-linux-gnu")  # headers for one machine alone
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
