# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
add_library(rondel_dual_support STATIC ${PROJECT_SOURCE_DIR}/tests/support/mpfr_oracle.cpp)
rondel_target_settings(rondel_dual_support)
target_link_libraries(rondel_dual_support PUBLIC rondel_test_support)

rondel_add_test(dual_test
  dual_areas_test.cpp
  dual_cells_test.cpp
  dual_centroids_test.cpp
  dual_circumcenters_test.cpp
  dual_face_batch_test.cpp
  dual_facets_test.cpp
  exact_argument_test.cpp
  LIBS rondel_dual_support)
