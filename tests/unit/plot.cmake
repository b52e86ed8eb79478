# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
if(NOT RONDEL_BUILD_TOOL OR NOT RONDEL_BUILD_PLOT)
  return()
endif()
rondel_add_test(unit_plot
  plot/circles_test.cpp
  plot/field_test.cpp
  plot/globe_test.cpp
  plot/pixels_test.cpp
  plot/region_test.cpp
  LIBS rondel_plot rondel_test_support)
rondel_compile_alone(unit_plot plot/pixels_test.cpp plot/region_test.cpp)
