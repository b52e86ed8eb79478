# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(convex_hull_test
  api/hull_test.cpp
  hidden/hull_hidden_test.cpp
  LIBS rondel_test_support)
