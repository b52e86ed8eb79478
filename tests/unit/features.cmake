# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(features_test
  proximity/features_cells_test.cpp
  LIBS rondel_geo)
