# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0

# Finds Python, nanobind and, with RONDEL_BUILD_TESTS, what the tests import. Says in `result` what is missing,
# or nothing. (A macro: the packages define variables and commands for the caller.)
macro(rondel_find_python_parts result)
  set(${result} "")
  if(Python_EXECUTABLE AND NOT EXISTS "${Python_EXECUTABLE}")
    set(${result} "there is no ${Python_EXECUTABLE}")
  else()
    # SKBUILD_SABI_COMPONENT is Development.SABIModule where pip will tag the wheel abi3, otherwise empty.
    find_package(Python 3.10 COMPONENTS Interpreter Development.Module
                 OPTIONAL_COMPONENTS ${SKBUILD_SABI_COMPONENT})
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
