# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(scvt_test
  meshing/outlines_test.cpp
  meshing/equal_area_test.cpp
  meshing/size_region_test.cpp
  meshing/size_test.cpp
  meshing/spacing_files_test.cpp
  meshing/point_sets_test.cpp
  meshing/scvt_energy_test.cpp
  meshing/scvt_fixed_test.cpp
  meshing/scvt_memory_test.cpp
  meshing/scvt_minimizer_test.cpp
  meshing/scvt_steps_test.cpp
  meshing/scvt_test.cpp
  LIBS rondel_geo rondel_test_support)
