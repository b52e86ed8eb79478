# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(native_test
  interpolation/extrapolate_test.cpp
  overlay/native_test.cpp
  overlay/nodes_test.cpp
  LIBS rondel_geo rondel_test_support)
