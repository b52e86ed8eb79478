# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(interpolation_test
  interpolation_bilinear_test.cpp
  interpolation_collected_test.cpp
  interpolation_errors_test.cpp
  interpolation_linear_test.cpp
  interpolation_names_test.cpp
  interpolation_places_test.cpp
  interpolation_regrid_test.cpp
  interpolation_rings_test.cpp
  interpolation_rules_test.cpp
  interpolation_weights_test.cpp
  LIBS rondel_geo rondel_dual_support rondel_test_support)

rondel_add_test(interpolation_natural_test
  interpolation_natural_cell_test.cpp
  interpolation_natural_laws_test.cpp
  interpolation_natural_test.cpp
  ${PROJECT_SOURCE_DIR}/tests/support/natural_oracle.cpp
  LIBS rondel_geo rondel_dual_support rondel_test_support)

rondel_add_test(interpolation_slopes_test
  interpolation_cubic_test.cpp
  interpolation_fit_test.cpp
  interpolation_gradient_test.cpp
  interpolation_hermite_test.cpp
  interpolation_tracks_test.cpp
  LIBS rondel_geo rondel_dual_support rondel_test_support)

rondel_add_test(weight_files_test field_names_test.cpp field_places_test.cpp field_slices_test.cpp weight_check_test.cpp weight_files_test.cpp LIBS rondel_geo)
