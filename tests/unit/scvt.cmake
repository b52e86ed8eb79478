# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(scvt_test
  mesh_outlines_test.cpp
  mesh_partition_test.cpp
  mesh_size_test.cpp
  mesh_spacing_files_test.cpp
  point_sets_test.cpp
  scvt_energy_test.cpp
  scvt_fixed_test.cpp
  scvt_memory_test.cpp
  scvt_minimizer_test.cpp
  scvt_repair_test.cpp
  scvt_steps_test.cpp
  scvt_test.cpp
  LIBS rondel_geo rondel_test_support)
