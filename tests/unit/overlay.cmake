# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(overlay_test
  overlay_arcs_test.cpp
  overlay_cell_set_test.cpp
  overlay_filling_test.cpp
  overlay_flips_test.cpp
  overlay_graticule_test.cpp
  overlay_grid_test.cpp
  overlay_hostile_test.cpp
  overlay_inside_cases_test.cpp
  overlay_inside_plane_test.cpp
  overlay_inside_test.cpp
  overlay_measure_test.cpp
  overlay_mesh_blocks_test.cpp
  overlay_mesh_faults_test.cpp
  overlay_mesh_files_test.cpp
  overlay_oracle.cpp
  overlay_overlaps_test.cpp
  overlay_parts_test.cpp
  overlay_pieces_test.cpp
  overlay_plane_test.cpp
  overlay_polar_test.cpp
  overlay_poles_test.cpp
  overlay_polygons_test.cpp
  overlay_regions_test.cpp
  overlay_remap_test.cpp
  overlay_rings_test.cpp
  overlay_shapes.cpp
  overlay_snaps_test.cpp
  overlay_subdivision_test.cpp
  overlay_sweep_test.cpp
  overlay_thin_test.cpp
  overlay_touching_test.cpp
  overlay_trial.cpp
  overlay_valid_test.cpp
  overlay_whole_test.cpp
  overlay_written_test.cpp
  LIBS rondel_geo rondel_test_support nlohmann_json::nlohmann_json)
rondel_compile_alone(overlay_test overlay_plane_test.cpp overlay_valid_test.cpp)
