# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(circles_test
  api/circles_test.cpp
  LIBS rondel_test_support)
