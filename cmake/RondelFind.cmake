# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0

# What the project needs, and what to install where it is missing: pip and others who only configure see
# nothing but these messages.

# Before project(), which says only that there is no compiler.
macro(rondel_require_compiler)
  if(CMAKE_HOST_UNIX AND NOT CMAKE_CXX_COMPILER AND NOT CMAKE_TOOLCHAIN_FILE)
    separate_arguments(rondel_wanted UNIX_COMMAND "$ENV{CXX}")
    list(POP_FRONT rondel_wanted rondel_first)
    find_program(RONDEL_CXX NAMES ${rondel_first} c++ g++ clang++ NO_CACHE)
    if(NOT RONDEL_CXX)
      message(FATAL_ERROR "There is no C++ compiler: Rondel needs GCC 12 or Clang 14, or later. "
                          "On Debian or Ubuntu: apt install g++")
    endif()
  endif()
endmacro()

# find_package(name ...), where a package of Debian's that name provides it.
macro(rondel_find_package name debian_package)
  find_package(${name} ${ARGN} QUIET)
  if(NOT ${name}_FOUND)
    string(JOIN " " rondel_wanted ${name} ${ARGN})
    message(FATAL_ERROR "Rondel needs ${rondel_wanted}, which was not found. On Debian or Ubuntu: apt install "
                        "${debian_package}. All that is needed is in scripts/tools/packages/build.txt, which "
                        "scripts/install build installs.")
  endif()
endmacro()
