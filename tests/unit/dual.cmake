# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
add_library(rondel_dual_support STATIC ${PROJECT_SOURCE_DIR}/tests/support/mpfr_oracle.cpp)
rondel_target_settings(rondel_dual_support)
target_link_libraries(rondel_dual_support PUBLIC rondel_test_support)

rondel_add_test(dual_test
  dual/areas_test.cpp
  dual/cells_test.cpp
  dual/circumcenters_test.cpp
  exact/argument_test.cpp
  LIBS rondel_dual_support)
