# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
if(NOT RONDEL_BUILD_TOOL OR NOT RONDEL_BUILD_PLOT)
  return()
endif()
rondel_add_test(unit_plot
  plot_arcs_test.cpp
  plot_circles_test.cpp
  plot_draw_test.cpp
  plot_field_test.cpp
  plot_globe_test.cpp
  plot_ground_test.cpp
  plot_pixels_test.cpp
  plot_region_test.cpp
  LIBS rondel_plot rondel_test_support)
rondel_compile_alone(unit_plot plot_pixels_test.cpp plot_region_test.cpp)
