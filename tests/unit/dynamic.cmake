# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(dynamic_test
  dynamic_api_test.cpp
  dynamic_query_test.cpp
  dynamic_range_test.cpp
  dynamic_renumbering_test.cpp
  dynamic_script_test.cpp
  dynamic_stop_test.cpp
  dynamic_ties_test.cpp
  LIBS rondel_test_support)
