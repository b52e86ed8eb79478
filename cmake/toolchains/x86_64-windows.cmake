# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0

# Windows on x86-64, by Debian's MinGW-w64 with POSIX threads, with the libraries that scripts/same-bytes
# --targets unpacks; programs need no other file and run in Wine.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
set(rondel_sysroot "${CMAKE_CURRENT_LIST_DIR}/../../build/targets/sysroot/x86_64-windows")
set(CMAKE_FIND_ROOT_PATH "${rondel_sysroot}/usr/x86_64-w64-mingw32" "${rondel_sysroot}/usr")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(Boost_NO_BOOST_CMAKE ON)  # Debian's is in a folder for the machine that it was built for
