# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(circles_test
  circles_cells_test.cpp
  circles_hull_test.cpp
  circles_polar_point_test.cpp
  LIBS rondel_test_support)
rondel_compile_alone(circles_test circles_hull_test.cpp)
