# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(bulk_test
  bulk/api_test.cpp
  bulk/bounds_test.cpp
  bulk/collinear_test.cpp
  bulk/leaves_test.cpp
  bulk/nasty_test.cpp
  bulk/same_test.cpp
  bulk/sphere_test.cpp
  bulk/squares_test.cpp
  LIBS rondel_test_support)
