# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
find_package(nlohmann_json 3.11 REQUIRED)
find_package(ZLIB REQUIRED)

rondel_add_test(io_test
  io/atomic_file_test.cpp
  formats/axes_test.cpp
  io/binary_test.cpp
  formats/cf_names_test.cpp
  formats/cf_reader_test.cpp
  io/circles_test.cpp
  io/columns_test.cpp
  io/features_test.cpp
  formats/conventions_test.cpp
  io/files_test.cpp
  io/json_test.cpp
  io/meshes_test.cpp
  io/mutation_test.cpp
  io/netcdf4_test.cpp
  io/netcdf_boxes_test.cpp
  io/netcdf_header_test.cpp
  io/netcdf_test.cpp
  io/number_test.cpp
  io/rows_test.cpp
  io/sites_test.cpp
  io/triangles_test.cpp
  formats/numbered_pixels_test.cpp
  formats/unpacked_test.cpp
  formats/vector_components_test.cpp
  io/wide_integers_test.cpp
  io/zip_test.cpp
  io/zlib_data_test.cpp
  LIBS rondel_geo rondel_test_support nlohmann_json::nlohmann_json ZLIB::ZLIB)

# A program of its own: what a sanitizer of threads needs.
rondel_add_test(io_parallel_test io/parallel_test.cpp LIBS rondel_geo rondel_test_support)

# What netCDF-C, which judges it, comes with is in scripts/tools/packages/test.txt.
add_executable(netcdf_large io/netcdf_large.cpp)
rondel_target_settings(netcdf_large)
target_include_directories(netcdf_large PRIVATE ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(netcdf_large PRIVATE rondel_geo)
add_test(NAME netcdf_writer.of_more_than_4_gib_is_read_by_netcdf_c
         COMMAND ${RONDEL_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/io/netcdf_large_test.py
                 $<TARGET_FILE:netcdf_large>)
