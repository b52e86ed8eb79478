# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(convex_hull_test
  api/hull_api_test.cpp
  api/hull_clouds_test.cpp
  hidden/hull_hidden_faces_test.cpp
  hidden/hull_inner_sites_test.cpp
  api/hull_small_test.cpp
  LIBS rondel_test_support)
