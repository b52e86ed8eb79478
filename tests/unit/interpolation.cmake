# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(interpolation_test
  interpolation_linear_test.cpp
  interpolation_rules_test.cpp
  interpolation_weights_test.cpp
  LIBS rondel_remap rondel_dual_support rondel_test_support)
