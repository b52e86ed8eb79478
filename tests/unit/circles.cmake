# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(circles_test
  api/circles_cells_test.cpp
  api/circles_hull_test.cpp
  api/circles_polar_point_test.cpp
  LIBS rondel_test_support)
rondel_compile_alone(circles_test api/circles_hull_test.cpp)
