# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(query_test
  query_api_test.cpp
  query_oracle_test.cpp
  query_visited_test.cpp
  LIBS rondel_test_support)
