# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(cells_test
  map/cells_arrays_test.cpp
  map/cells_map_test.cpp
  map/cells_mending_test.cpp
  map/cells_nested_test.cpp
  map/cells_parts_test.cpp
  map/cells_polygon_test.cpp
  map/cells_settled_test.cpp
  map/cells_write_test.cpp
  map/cells_test.cpp
  map/faces_test.cpp
  map/mending_test.cpp
  map/nested_test.cpp
  map/planar_faces_test.cpp
  map/planar_loops_test.cpp
  map/plane_test.cpp
  map/polygon_test.cpp
  map/region_test.cpp
  map/ring_area_test.cpp
  map/trace_test.cpp
  map/troubles_test.cpp
  LIBS rondel_geo rondel_test_support nlohmann_json::nlohmann_json)
