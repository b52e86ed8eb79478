# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(overlay_test
  overlay/arcs_test.cpp
  overlay/cell_set_test.cpp
  overlay/empty_rings_test.cpp
  overlay/filling_test.cpp
  overlay/flips_test.cpp
  overlay/graticule_test.cpp
  overlay/grid_test.cpp
  overlay/hostile_test.cpp
  overlay/inside_test.cpp
  overlay/inside_plane_test.cpp
  overlay/limiter_test.cpp
  overlay/measure_test.cpp
  overlay/merged_cells_test.cpp
  formats/arrow_test.cpp
  formats/mesh_blocks_test.cpp
  formats/mesh_faults_test.cpp
  formats/mesh_files_test.cpp
  overlay/oracle.cpp
  overlay/overlaps_test.cpp
  overlay/parts_test.cpp
  overlay/pieces_test.cpp
  overlay/plane_test.cpp
  overlay/polar_test.cpp
  overlay/polygons_test.cpp
  overlay/regions_test.cpp
  overlay/remap_test.cpp
  overlay/repair_test.cpp
  overlay/repaired_cells_test.cpp
  overlay/rings_test.cpp
  overlay/shapes.cpp
  overlay/snaps_test.cpp
  overlay/straight_test.cpp
  overlay/subdivision_test.cpp
  overlay/twins_test.cpp
  overlay/sweep_test.cpp
  overlay/thin_test.cpp
  overlay/touching_test.cpp
  overlay/trial.cpp
  overlay/valid_test.cpp
  overlay/weight_comparison_test.cpp
  overlay/whole_test.cpp
  overlay/written_test.cpp
  overlay/zonal_statistics_test.cpp
  LIBS rondel_geo rondel_test_support nlohmann_json::nlohmann_json)
rondel_compile_alone(overlay_test overlay/plane_test.cpp overlay/valid_test.cpp)
