# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
if(NOT RONDEL_BUILD_TOOL)
  return()
endif()
find_package(PkgConfig REQUIRED)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)

set(plot_sources ${PROJECT_SOURCE_DIR}/cli)
rondel_add_test(unit_plot
  plot_arcs_test.cpp
  plot_circles_test.cpp
  plot_draw_test.cpp
  plot_globe_test.cpp
  plot_region_test.cpp
  ${plot_sources}/globe.cpp
  ${plot_sources}/plot_arcs.cpp
  ${plot_sources}/plot_canvas.cpp
  ${plot_sources}/plot_circles.cpp
  ${plot_sources}/plot_color.cpp
  ${plot_sources}/plot_draw.cpp
  LIBS rondel_io PkgConfig::CAIRO)
target_include_directories(unit_plot PRIVATE ${plot_sources})
