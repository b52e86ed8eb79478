# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(constrained_test
  constrained/constrained_oracle.cpp
  constrained/arc_insertion_test.cpp
  constrained/constrained_errors_test.cpp
  constrained/constrained_features_test.cpp
  constrained/constrained_graphs_test.cpp
  constrained/constrained_laws_test.cpp
  constrained/constrained_interpolator_test.cpp
  constrained/constrained_locator_test.cpp
  constrained/constrained_oracle_test.cpp
  constrained/constrained_proof_test.cpp
  constrained/dynamic_constrained_test.cpp
  constrained/faces_inside_test.cpp
  constrained/polygon_triangles_test.cpp
  LIBS rondel_geo rondel_test_support)
