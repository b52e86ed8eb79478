# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(api_test
  api/arguments_test.cpp
  api/arithmetic_test.cpp
  api/progress_test.cpp
  api/threads_test.cpp
  LIBS rondel_geo rondel_test_support)

# What -ffast-math leaves of the proofs is nothing, so that the library does not compile with it, nor with those of its
# parts for which the compiler has a macro. Flags of one test are separated by semicolons.
set(flags_of_fast -ffast-math)
set(flags_of_finite -ffinite-math-only)
set(flags_of_unsafe -funsafe-math-optimizations)
set(flags_of_associative -fassociative-math -fno-signed-zeros -fno-trapping-math)
set(flags_of_reciprocal -freciprocal-math)
set(flags_of_unsigned_zeros -fno-signed-zeros)
set(flags_of_fast_with_infinity -Ofast -fno-finite-math-only)
set(parts fast finite)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  list(APPEND parts unsafe associative reciprocal unsigned_zeros fast_with_infinity)
endif()
foreach(part ${parts})
  set(name arithmetic.does_not_compile_without_ieee_rules_${part})
  add_test(NAME ${name}
           COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 -fsyntax-only ${flags_of_${part}} -I${PROJECT_SOURCE_DIR}/include
                   -I${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/src/system/arithmetic.cpp)
  set_tests_properties(${name} PROPERTIES PASS_REGULAR_EXPRESSION "Rondel does not compile with -ffast-math")
endforeach()
