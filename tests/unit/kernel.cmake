# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(kernel_test
  kernel/api_test.cpp
  kernel/exact_test.cpp
  kernel/order_test.cpp
  kernel/walk_test.cpp
  system/checked_product_test.cpp
  system/chunk_lists_test.cpp
  system/large_arrays_test.cpp
  order/spatial_index_test.cpp
  order/spatial_order_test.cpp
  system/parallel_test.cpp
  system/message_text_test.cpp
  system/row_assembly_test.cpp
  LIBS rondel_test_support)
