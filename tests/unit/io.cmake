# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
find_package(nlohmann_json 3.11 REQUIRED)
find_package(ZLIB REQUIRED)

rondel_add_test(io_test
  io_atomic_file_test.cpp
  io_axes_test.cpp
  io_binary_test.cpp
  io_cf_names_test.cpp
  io_cf_reader_test.cpp
  io_circles_test.cpp
  io_columns_test.cpp
  io_features_test.cpp
  io_conventions_test.cpp
  io_files_test.cpp
  io_json_test.cpp
  io_meshes_test.cpp
  io_mutation_test.cpp
  io_netcdf4_test.cpp
  io_netcdf_boxes_test.cpp
  io_netcdf_header_test.cpp
  io_netcdf_test.cpp
  io_number_test.cpp
  io_rows_test.cpp
  io_sites_test.cpp
  io_triangles_test.cpp
  io_unpacked_test.cpp
  io_utf8_test.cpp
  io_wide_integers_test.cpp
  io_zip_test.cpp
  LIBS rondel_geo rondel_test_support nlohmann_json::nlohmann_json ZLIB::ZLIB)

# A program of its own: what a sanitizer of threads needs.
rondel_add_test(io_parallel_test io_parallel_test.cpp LIBS rondel_geo rondel_test_support)

# What netCDF-C, which judges it, comes with is in scripts/tools/packages/test.txt.
add_executable(netcdf_large netcdf_large.cpp)
rondel_test_settings(netcdf_large)
target_include_directories(netcdf_large PRIVATE ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(netcdf_large PRIVATE rondel_geo)
add_test(NAME netcdf_writer.of_more_than_4_gib_is_read_by_netcdf_c
         COMMAND ${RONDEL_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/netcdf_large_test.py
                 $<TARGET_FILE:netcdf_large>)
