# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(triangle_mesh_test
  formats/mesh_depths_test.cpp
  formats/triangle_faults_test.cpp
  formats/triangle_files_test.cpp
  map/longitudes_test.cpp
  meshing/boundary_segments_test.cpp
  meshing/domain_crossings_test.cpp
  meshing/domain_small_rings_test.cpp
  meshing/domain_triangles_test.cpp
  meshing/flat_triangles_test.cpp
  meshing/sound_positions_test.cpp
  meshing/triangle_meshes.cpp
  meshing/triangle_picture_test.cpp
  LIBS rondel_geo rondel_test_support)
