# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(check_test
  check_api_test.cpp
  check_convexity_test.cpp
  check_sites_by_place_test.cpp
  check_sites_test.cpp
  check_surface_test.cpp
  check_valid_test.cpp
  LIBS rondel_test_support)
