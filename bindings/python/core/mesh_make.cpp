// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "arrays.h"
#include "interrupt.h"
#include "mesh_sizes.h"
#include "module.h"
#include "rondel/mesh_equal_area.h"
#include "rondel/scvt.h"

namespace rondel::python {
namespace {

using mesh::SizeFunction;

// A tessellation, and the density at each site; empty if all are the same.
using ScvtOut = std::tuple<mesh::Scvt, ArrayOut<double>>;

ScvtOut make_scvt(std::size_t count, const NumbersIn& spacings, std::size_t steps, double gradient,
                  double mean_tolerance, double largest_tolerance, int max_steps, bool repair,
                  const PointsIn& fixed, unsigned threads, const nb::object& listener) {
  mesh::ScvtOptions options{.count = count,
                            .mean_tolerance = mean_tolerance,
                            .largest_tolerance = largest_tolerance,
                            .max_iterations = max_steps,
                            .repair = repair,
                            .fixed = points_of(fixed)};
  mesh::Scvt made = watched(many_sites, threads, listener, [&](const Execution& execution) {
    options.size = size_of(rows_of<double>(spacings), steps, gradient);
    options.on_step = [&](const mesh::ScvtStep& step) {
      if (!execution.progress) return;
      execution.progress(std::to_string(step.sites) + " cells", step.done);
    };
    mesh::Scvt found = mesh::scvt(options, execution);
    if (execution.progress) {
      execution.progress(std::to_string(found.sites.size()) + " cells", 1);
    }
    return found;
  });
  std::vector<double> density;
  if (options.size) {
    for (const Point& site : made.sites) density.push_back(options.size->density(site));
  }
  return {std::move(made), to_array<double>(std::move(density))};
}

mesh::EqualArea make_equal_area(const PointsIn& points, const NumbersIn& areas, double tolerance,
                                unsigned threads) {
  return watched_quietly(many_sites, threads, [&](const Execution& execution) {
    return mesh::equal_area(points_of(points), rows_of<double>(areas), {.tolerance = tolerance},
                            execution);
  });
}

void add_results(nb::module_& module) {
  nb::class_<mesh::ScvtDefects>(module, "ScvtDefects")
      .def_ro("odd_cells", &mesh::ScvtDefects::odd_cells)
      .def_ro("short_edges", &mesh::ScvtDefects::short_edges)
      .def_ro("obtuse_triangles", &mesh::ScvtDefects::obtuse_triangles)
      .def_ro("min_edge_ratio", &mesh::ScvtDefects::min_edge_ratio);
  nb::class_<mesh::Scvt> scvt(module, "Scvt");
  add_fixed_array<double, &mesh::Scvt::sites>(scvt, "points");
  add_fixed_array<std::int32_t, &mesh::Scvt::fixed>(scvt, "fixed");
  scvt.def_prop_ro("end", [](const mesh::Scvt& self) { return std::string(name_of(self.end)); })
      .def_prop_ro("steps", [](const mesh::Scvt& self) { return self.last.iteration; })
      .def_prop_ro("mean_offset", [](const mesh::Scvt& self) { return self.last.mean_offset; })
      .def_prop_ro("largest_offset",
                   [](const mesh::Scvt& self) { return self.last.largest_offset; })
      .def_prop_ro("defects_before", [](const mesh::Scvt& self) { return self.repair.before; })
      .def_prop_ro("defects_after", [](const mesh::Scvt& self) { return self.repair.after; })
      .def_prop_ro("moved", [](const mesh::Scvt& self) { return self.repair.moved; });
  nb::class_<mesh::EqualArea> equal_area(module, "EqualArea");
  add_fixed_array<double, &mesh::EqualArea::poles>(equal_area, "points");
  add_fixed_array<double, &mesh::EqualArea::weights>(equal_area, "weights");
  add_fixed_array<double, &mesh::EqualArea::areas>(equal_area, "areas");
  equal_area
      .def_prop_ro("end",
                   [](const mesh::EqualArea& self) { return std::string(name_of(self.end)); })
      .def_ro("steps", &mesh::EqualArea::steps)
      .def_ro("largest_error", &mesh::EqualArea::largest_error)
      .def_ro("reason", &mesh::EqualArea::reason);
}

}  // namespace

void add_mesh_make(nb::module_& module) {
  add_results(module);
  module.def("make_scvt", &make_scvt, nb::kw_only(), nb::arg("count"),
             nb::arg("spacings").noconvert(), nb::arg("steps"), nb::arg("gradient"),
             nb::arg("mean_tolerance"), nb::arg("largest_tolerance"), nb::arg("max_steps"),
             nb::arg("repair"), nb::arg("fixed").noconvert(), nb::arg("threads"),
             nb::arg("listener").none());
  module.def("make_equal_area", &make_equal_area, nb::arg("points").noconvert(),
             nb::arg("areas").noconvert(), nb::arg("tolerance"), nb::arg("threads"));
}

}  // namespace rondel::python
