# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(kernel_test
  kernel_api_test.cpp
  kernel_exact_test.cpp
  kernel_order_test.cpp
  kernel_walk_test.cpp
  large_vector_test.cpp
  spatial_index_test.cpp
  spatial_order_test.cpp
  system_parallel_test.cpp
  system_shortest_text_test.cpp
  LIBS rondel_test_support)
