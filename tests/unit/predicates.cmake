# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(predicates_test
  exact_ball_test.cpp
  exact_integer_rays_test.cpp
  exact_integer_steps_test.cpp
  predicates_distance_test.cpp
  predicates_oracle_test.cpp
  predicates_perturbation_test.cpp
  predicates_rung_test.cpp
  predicates_sign_test.cpp
  predicates_symmetry_test.cpp
  unit_vectors_test.cpp
  LIBS rondel_test_support)
rondel_compile_alone(predicates_test predicates_rung_test.cpp)
rondel_add_test(predicates_bounds_test predicates_bounds_test.cpp LIBS rondel_test_support)
