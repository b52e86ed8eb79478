# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(interpolation_test
  interpolation/bilinear_test.cpp
  interpolation/collected_test.cpp
  interpolation/errors_test.cpp
  interpolation/flat_faces_test.cpp
  interpolation/linear_test.cpp
  interpolation/places_test.cpp
  interpolation/regrid_test.cpp
  interpolation/rings_test.cpp
  interpolation/rules_test.cpp
  interpolation/weights_test.cpp
  LIBS rondel_geo rondel_dual_support rondel_test_support)

rondel_add_test(interpolation_natural_test
  interpolation/natural_cell_test.cpp
  interpolation/natural_laws_test.cpp
  interpolation/natural_test.cpp
  ${PROJECT_SOURCE_DIR}/tests/support/natural_oracle.cpp
  LIBS rondel_geo rondel_dual_support rondel_test_support)

rondel_add_test(interpolation_slopes_test
  interpolation/cubic_test.cpp
  interpolation/fit_test.cpp
  interpolation/gradient_test.cpp
  interpolation/hermite_test.cpp
  interpolation/tracks_test.cpp
  LIBS rondel_geo rondel_dual_support rondel_test_support)

rondel_add_test(weight_files_test formats/field_names_test.cpp formats/field_places_test.cpp formats/field_slices_test.cpp formats/weight_check_test.cpp formats/weight_files_test.cpp LIBS rondel_geo)
