# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(check_test
  proof/check_convexity_test.cpp
  proof/check_sites_test.cpp
  proof/check_surface_test.cpp
  LIBS rondel_test_support)
