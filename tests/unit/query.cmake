# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(query_test
  query/api_test.cpp
  query/oracle_test.cpp
  query/visited_test.cpp
  LIBS rondel_test_support)
