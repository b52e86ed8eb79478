# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(grids_test
  grids/dual_grids_test.cpp
  grids/named_grids_test.cpp
  grids/regrid_files_test.cpp
  grids/regrid_streams_test.cpp
  grids/tiled_remap_test.cpp
  LIBS rondel_geo rondel_test_support)
