# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(dynamic_test
  dynamic/api_test.cpp
  dynamic/move_all_test.cpp
  dynamic/query_test.cpp
  dynamic/range_test.cpp
  dynamic/script_test.cpp
  dynamic/ties_test.cpp
  LIBS rondel_test_support)
