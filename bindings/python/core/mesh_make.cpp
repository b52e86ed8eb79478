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
#include "rondel/mesh_partition.h"
#include "rondel/scvt.h"

namespace rondel::python {
namespace {

using mesh::SizeFunction;

// The number of odd cells, of short edges and of obtuse triangles, and the least ratio.
using DefectsOut = std::tuple<std::size_t, std::size_t, std::size_t, double>;
// Points, densities (empty if there are none), how the work ended, steps of the last level, mean
// offset, largest offset, defects before and after the repair, the number of sites that it moved,
// and the sites of fixed places.
using ScvtOut = std::tuple<ArrayOut<double>, ArrayOut<double>, std::string, int, double, double,
                           DefectsOut, DefectsOut, std::size_t, ArrayOut<std::int32_t>>;
using AreasOut = std::tuple<ArrayOut<double>, ArrayOut<double>, ArrayOut<double>, std::string, int,
                            double, std::string>;

DefectsOut defects_out(const mesh::ScvtDefects& defects) {
  return {defects.odd_cells, defects.short_edges, defects.obtuse_triangles,
          defects.least_edge_ratio};
}

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
    options.seen = [&](const mesh::ScvtStep& step) {
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
  return {points_out(std::move(made.sites)),
          to_array<double>(std::move(density)),
          std::string(name_of(made.end)),
          made.last.iteration,
          made.last.mean_offset,
          made.last.largest_offset,
          defects_out(made.repair.before),
          defects_out(made.repair.after),
          made.repair.moved,
          indices_out(std::move(made.fixed))};
}

AreasOut make_area_partition(const PointsIn& points, const NumbersIn& areas, double tolerance,
                             unsigned threads) {
  mesh::AreaPartition made = watched_quietly(many_sites, threads, [&](const Execution& execution) {
    return mesh::area_partition(points_of(points), rows_of<double>(areas), {.tolerance = tolerance},
                                execution);
  });
  return {points_out(std::move(made.poles)),
          to_array<double>(std::move(made.weights)),
          to_array<double>(std::move(made.areas)),
          std::string(name_of(made.end)),
          made.steps,
          made.largest_error,
          std::move(made.reason)};
}

}  // namespace

void add_mesh_make(nb::module_& module) {
  module.def(
      "raster_places", [](std::size_t steps) { return points_out(SizeFunction::nodes(steps)); },
      nb::arg("steps"));
  module.def("make_scvt", &make_scvt, nb::arg("count"), nb::arg("spacings").noconvert(),
             nb::arg("steps"), nb::arg("gradient"), nb::arg("mean_tolerance"),
             nb::arg("largest_tolerance"), nb::arg("max_steps"), nb::arg("repair"),
             nb::arg("fixed").noconvert(), nb::arg("threads"), nb::arg("listener").none());
  module.def("make_area_partition", &make_area_partition, nb::arg("points").noconvert(),
             nb::arg("areas").noconvert(), nb::arg("tolerance"), nb::arg("threads"));
}

}  // namespace rondel::python
