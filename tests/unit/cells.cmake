# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(cells_polygon_test cells_polygon_test.cpp LIBS rondel_io)
rondel_add_test(cells_map_test cells_map_test.cpp LIBS rondel_io rondel_test_support)
rondel_add_test(cells_write_test cells_write_test.cpp
  LIBS rondel_io rondel_test_support nlohmann_json::nlohmann_json)
