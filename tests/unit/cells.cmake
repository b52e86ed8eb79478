# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(cells_test
  cells_arrays_test.cpp
  cells_common_test.cpp
  cells_map_test.cpp
  cells_mending_test.cpp
  cells_merged_test.cpp
  cells_nested_test.cpp
  cells_parts_test.cpp
  cells_polygon_test.cpp
  cells_settled_test.cpp
  cells_tips_test.cpp
  cells_write_test.cpp
  map_cells_test.cpp
  map_faces_test.cpp
  map_mending_test.cpp
  map_nested_test.cpp
  map_planar_faces_test.cpp
  map_planar_loops_test.cpp
  map_plane_test.cpp
  map_polygon_test.cpp
  map_region_test.cpp
  map_ring_area_test.cpp
  map_trace_test.cpp
  map_troubles_test.cpp
  LIBS rondel_geo rondel_test_support nlohmann_json::nlohmann_json)
