# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(predicates_test
  exact/ball_test.cpp
  exact/big_integer_test.cpp
  exact/integer_rays_test.cpp
  exact/long_integer_test.cpp
  predicates/distance_test.cpp
  predicates/perturbation_test.cpp
  predicates/rung_test.cpp
  predicates/sign_test.cpp
  predicates/symmetry_test.cpp
  exact/unit_vectors_test.cpp
  LIBS rondel_test_support)
rondel_compile_alone(predicates_test predicates/rung_test.cpp)
rondel_add_test(predicates_bounds_test predicates/bounds_test.cpp LIBS rondel_test_support)
