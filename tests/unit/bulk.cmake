# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(bulk_test
  bulk_api_test.cpp
  bulk_bounds_test.cpp
  bulk_buckets_test.cpp
  bulk_collinear_test.cpp
  bulk_divide_test.cpp
  bulk_few_sites_test.cpp
  bulk_nasty_test.cpp
  bulk_order_test.cpp
  bulk_same_test.cpp
  bulk_scale_test.cpp
  bulk_sphere_test.cpp
  LIBS rondel_test_support)
