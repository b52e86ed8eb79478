# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(convex_hull_test
  hull_api_test.cpp
  hull_clouds_test.cpp
  hull_hidden_faces_test.cpp
  hull_inner_sites_test.cpp
  hull_small_test.cpp
  LIBS rondel_test_support)
