# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(graphs_test
  proximity/graphs_files_test.cpp
  proximity/graphs_kinds_test.cpp
  proximity/graphs_outlines_test.cpp
  LIBS rondel_geo rondel_test_support)
