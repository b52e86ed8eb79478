# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(arrangement_test
  arrangement/arc_sets.cpp
  arrangement/arrange_test.cpp
  arrangement/buffer_test.cpp
  arrangement/divided_again_test.cpp
  arrangement/exact_places_test.cpp
  arrangement/geometries_test.cpp
  arrangement/halfedges_test.cpp
  arrangement/relate_lines_test.cpp
  arrangement/relate_test.cpp
  arrangement/relation_oracle.cpp
  arrangement/set_operations_test.cpp
  arrangement/simplify_test.cpp
  arrangement/steps_test.cpp
  arrangement/together_test.cpp
  LIBS rondel_geo rondel_test_support)
