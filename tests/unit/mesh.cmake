# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(mesh_test
  mesh_arrays_test.cpp
  mesh_border_test.cpp
  mesh_cell_corners_test.cpp
  mesh_cull_test.cpp
  mesh_files_test.cpp
  mesh_quality_test.cpp
  LIBS rondel_geo rondel_test_support nlohmann_json::nlohmann_json)
