# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(mesh_test
  meshing/arrays_test.cpp
  meshing/border_test.cpp
  meshing/cell_corners_test.cpp
  meshing/cull_test.cpp
  meshing/files_test.cpp
  meshing/quality_test.cpp
  LIBS rondel_geo rondel_test_support nlohmann_json::nlohmann_json)
