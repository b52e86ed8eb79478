# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(api_test
  api/arguments_test.cpp
  api/arithmetic_test.cpp
  api/progress_test.cpp
  api/threads_test.cpp
  LIBS rondel_geo rondel_test_support)

# What -ffast-math leaves of the proofs is nothing, so that the library does not compile with it.
add_test(NAME arithmetic.does_not_compile_without_ieee_rules
         COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 -fsyntax-only -ffast-math -I${PROJECT_SOURCE_DIR}/include
                 -I${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/src/system/arithmetic.cpp)
set_tests_properties(arithmetic.does_not_compile_without_ieee_rules
                     PROPERTIES PASS_REGULAR_EXPRESSION "Rondel does not compile with -ffast-math")
