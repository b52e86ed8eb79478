# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0

# Compile settings of every target of the project.
#
# -ffp-contract=off is part of the correctness proof: a fused multiply-add
# changes the error of a filter and the bits of a spatial key.
# -fno-math-errno: nothing reads errno behind a square root, and loops with one
# become vector code.
function(rondel_target_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno -Wall -Wextra -Wconversion
                                           -Wshadow)
  # GCC collects its garbage once it has a gigabyte, which saves a seventh of the time and takes up to 1.7 GB.
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(
      ${target} PRIVATE "$<$<CONFIG:RelWithDebInfo>:--param=ggc-min-expand=1000;--param=ggc-min-heapsize=1000000>")
  endif()
  # Where pointers have 32 bits, 64 of them are the offsets of results, which are the same everywhere, and
  # hashes and keys that were shifted to a position: both name elements of arrays that lie in memory.
  if(CMAKE_SIZEOF_VOID_P EQUAL 4)
    target_compile_options(${target} PRIVATE -Wno-sign-conversion -Wno-shorten-64-to-32)
  endif()
  if(RONDEL_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(RONDEL_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${RONDEL_SANITIZE}
                                             -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${RONDEL_SANITIZE})
    # A sanitizer's checks take three times as long to compile where they are optimized, and what stands above the core
    # runs little with them. The checks that are left out there make two fifths of the code: null pointers crash without
    # them, values in files are copied before they are read, and sizes of objects are known to the optimizer alone.
    # Fuzzers, which run for long, have them all.
    if(NOT target STREQUAL rondel AND NOT RONDEL_BUILD_FUZZERS)
      target_compile_options(${target} PRIVATE -O0)
      if(RONDEL_SANITIZE MATCHES undefined)
        target_compile_options(${target} PRIVATE -fno-sanitize=null,alignment,vptr,object-size)
      endif()
    endif()
  endif()
endfunction()

# What users link, static or shared. A shared library shows what RONDEL_API marks; before 1.0 each minor
# version has a binary interface of its own. Objects are the same for both kinds, so that tests can make a
# shared library of those of the static one.
function(rondel_library_settings target)
  rondel_target_settings(${target})
  target_compile_options(${target} PRIVATE -Wpedantic)  # other compilers take no extensions of GNU's
  set_target_properties(${target} PROPERTIES
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    DEFINE_SYMBOL ""
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  # A function and an array have a section each, so that a shared library that is linked of static ones can leave out
  # what it does not use (-Wl,--gc-sections), although the files of a layer are one object.
  target_compile_options(${target} PRIVATE -ffunction-sections -fdata-sections)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL SHARED_LIBRARY AND NOT APPLE)  # whose linker does so by itself
    target_link_options(${target} PRIVATE -Wl,--no-undefined)
  endif()
endfunction()

# Where files are compiled together (CMAKE_UNITY_BUILD), these stay alone: names in their unnamed namespaces
# mean something else in their neighbours', or they are large themselves.
function(rondel_compile_alone target)
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target}
                              PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# For what reads files of strangers. A sanitizer checks more, and cannot look through _FORTIFY_SOURCE,
# which needs an optimizing build. What MinGW checks with needs a library that its users would have to link.
function(rondel_harden target)
  if(RONDEL_SANITIZE OR WIN32)
    return()
  endif()
  target_compile_options(${target} PRIVATE -fstack-protector-strong)
  target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS
    $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:_FORTIFY_SOURCE=2>)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL EXECUTABLE AND NOT APPLE)  # whose programs are so by themselves
    target_link_options(${target} PRIVATE -pie -Wl,-z,relro -Wl,-z,now -Wl,-z,noexecstack)
  endif()
endfunction()

# Of a hardened target, files that read nothing of strangers, only what has been validated, and whose loops the
# checks would slow down by a tenth. What has options of its own is compiled alone.
function(rondel_compile_unchecked target)
  if(WIN32 OR RONDEL_SANITIZE)
    return()
  endif()
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES
    SKIP_UNITY_BUILD_INCLUSION ON
    COMPILE_OPTIONS "-U_GLIBCXX_ASSERTIONS;-fno-stack-protector")
endfunction()
