// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The functions by which each file adds to the module rondel._core.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <string>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::python {

void add_triangulation(nanobind::module_& module);
void add_diagram(nanobind::module_& module);
void add_query(nanobind::module_& module);
void add_arrow(nanobind::module_& module);
void add_cell_set(nanobind::module_& module);
void add_constrained(nanobind::module_& module);
void add_contours(nanobind::module_& module);
void add_conventions(nanobind::module_& module);
void add_dynamic(nanobind::module_& module);
void add_dynamic_constrained(nanobind::module_& module);
void add_files(nanobind::module_& module);
void add_geometries(nanobind::module_& module);
void add_globe(nanobind::module_& module);
void add_graphs(nanobind::module_& module);
void add_interpolation(nanobind::module_& module);
void add_mesh(nanobind::module_& module);
void add_mesh_make(nanobind::module_& module);
void add_mesh_parts(nanobind::module_& module);
void add_out_of_core(nanobind::module_& module);
void add_distributed(nanobind::module_& module);
void add_polygons(nanobind::module_& module);
void add_regions(nanobind::module_& module);
void add_remap(nanobind::module_& module);
void add_triangle_meshes(nanobind::module_& module);
void add_native_weights(nanobind::module_& module);
void add_regrid_files(nanobind::module_& module);
void add_weight_checks(nanobind::module_& module);
void add_weight_files(nanobind::module_& module);
void add_zonal_statistics(nanobind::module_& module);

// Returns the options of a build.
inline Options make_options(bool is_weighted, const std::array<double, 3>& center,
                            double squared_radius) {
  return {.model = is_weighted ? Model::weighted : Model::projected,
          .sphere = {{center[0], center[1], center[2]}, squared_radius}};
}

// Returns how many threads to use for a triangulation: as many as built it. A triangulation that
// was not built here, such as a snapshot or a copy from a pickle, has no such number, and one for
// each core is used (0).
inline unsigned threads_of(const Triangulation& t) {
  return t.report().builder == Builder::given ? 0 : t.report().threads;
}

}  // namespace rondel::python
