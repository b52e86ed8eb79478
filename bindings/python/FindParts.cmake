# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0

# The headers in RONDEL_PYTHON_HEADERS are of another Python than the one that runs here: of another version, or of
# another machine. From 3.12 they make a module for the stable ABI.
macro(rondel_use_python_headers)
  find_package(Python 3.10 COMPONENTS Interpreter)
  file(STRINGS ${RONDEL_PYTHON_HEADERS}/patchlevel.h Python_VERSION REGEX "define PY_VERSION ")
  string(REGEX MATCH "[0-9]+[.][0-9]+" Python_VERSION "${Python_VERSION}")
  string(REPLACE "." "" rondel_digits ${Python_VERSION})
  set(SKBUILD_SOABI cpython-${rondel_digits}-${CMAKE_SYSTEM_PROCESSOR}-linux-gnu)
  set(SKBUILD_SOSABI abi3)
  set(Python_INCLUDE_DIRS ${RONDEL_PYTHON_HEADERS})
  set(rondel_kinds Module)
  if(Python_VERSION VERSION_GREATER_EQUAL 3.12)
    set(SKBUILD_SABI_VERSION 3.12)
    list(APPEND rondel_kinds SABIModule)
    add_compile_options("SHELL:-include cstdio")  # nanobind uses it, and this Python.h has it no more
  endif()
  foreach(kind ${rondel_kinds})
    add_library(Python::${kind} INTERFACE IMPORTED)
    target_include_directories(Python::${kind} INTERFACE ${RONDEL_PYTHON_HEADERS})
  endforeach()
endmacro()

# Finds Python, nanobind and, with RONDEL_BUILD_TESTS, what the tests import. Says in `result` what is missing,
# or nothing. (A macro: the packages define variables and commands for the caller.)
macro(rondel_find_python_parts result)
  set(${result} "")
  if(Python_EXECUTABLE AND NOT EXISTS "${Python_EXECUTABLE}")
    set(${result} "there is no ${Python_EXECUTABLE}")
  else()
    # SKBUILD_SABI_COMPONENT is Development.SABIModule where pip will tag the wheel abi3, otherwise empty.
    if(RONDEL_PYTHON_HEADERS)
      rondel_use_python_headers()
    else()
      find_package(Python 3.10 COMPONENTS Interpreter Development.Module
                   OPTIONAL_COMPONENTS ${SKBUILD_SABI_COMPONENT})
    endif()
    if(NOT Python_FOUND)
      set(${result} "Python 3.10 or later, with its headers (Debian: python3-dev), was not found")
    endif()
  endif()
  if(NOT ${result})
    execute_process(COMMAND ${Python_EXECUTABLE} -m nanobind --cmake_dir
                    OUTPUT_VARIABLE nanobind_ROOT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    find_package(nanobind CONFIG QUIET)
    if(NOT nanobind_FOUND)
      set(${result} "${Python_EXECUTABLE} has no nanobind (python -m pip install nanobind)")
    endif()
  endif()
  if(NOT ${result} AND RONDEL_BUILD_TESTS)
    execute_process(COMMAND ${Python_EXECUTABLE} -c "import importlib.util
parts = ('numpy', 'scipy', 'matplotlib', 'pytest', 'hypothesis')
print(', '.join(p for p in parts if importlib.util.find_spec(p) is None), end='')"
                    OUTPUT_VARIABLE missing_modules)
    if(missing_modules)
      set(${result} "${Python_EXECUTABLE} has no ${missing_modules}")
    endif()
  endif()
endmacro()
