# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(contours_test
  interpolation/contours_cells_test.cpp
  interpolation/contours_field_test.cpp
  interpolation/contours_map_test.cpp
  interpolation/contours_pieces_test.cpp
  interpolation/contours_topology_test.cpp
  LIBS rondel_geo rondel_test_support nlohmann_json::nlohmann_json)
