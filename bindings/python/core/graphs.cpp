// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/graphs.h"

#include <nanobind/stl/tuple.h>

#include <array>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "rondel/outlines.h"

namespace rondel::python {
namespace {

using GraphOut = std::tuple<ArrayOut<std::int32_t>, ArrayOut<double>>;
using OutlineOut =
    std::tuple<ArrayOut<std::int64_t>, ArrayOut<std::int64_t>, ArrayOut<std::int32_t>>;
using CirclesOut = std::tuple<ArrayOut<double>, ArrayOut<double>, ArrayOut<std::int32_t>>;

GraphOut graph(const Triangulation& t, nb::handle name) {
  const auto kind = named<GraphKind>("kind", name);
  SiteGraph found = watched_quietly(t.num_sites(), threads_of(t), [&](const Execution& execution) {
    return site_graph(t, kind, execution);
  });
  return {to_array<std::int32_t>(std::move(found.edges)),
          to_array<double>(std::move(found.lengths))};
}

OutlineOut outline_out(Outline&& outline) {
  return {offsets_out(std::move(outline.offsets)), offsets_out(std::move(outline.rows.offsets)),
          indices_out(std::move(outline.rows.values))};
}

OutlineOut hull_polygon_of(const Triangulation& t) {
  return outline_out(unlocked([&] { return hull_polygon(t); }));
}

OutlineOut alpha_shape_of(const Triangulation& t, double radius) {
  return outline_out(watched_quietly(t.num_sites(), threads_of(t), [&](const Execution& execution) {
    return alpha_shape(t, radius, execution);
  }));
}

CirclesOut empty_circles(const Triangulation& t, std::size_t count, bool anywhere) {
  const auto centers = anywhere ? CircleCenters::anywhere : CircleCenters::inside;
  const std::vector<EmptyCircle> found =
      watched_quietly(t.num_sites(), threads_of(t), [&](const Execution& execution) {
        return largest_empty_circles(t, count, centers, execution);
      });
  std::vector<Point> middles;
  std::vector<double> radii;
  std::vector<Triple> sites;
  for (const EmptyCircle& circle : found) {
    middles.push_back(circle.center);
    radii.push_back(circle.radius);
    sites.push_back(circle.sites);
  }
  return {points_out(std::move(middles)), to_array<double>(std::move(radii)),
          to_array<std::int32_t>(std::move(sites))};
}

}  // namespace

void add_graphs(nb::module_& module) {
  module.def("site_graph", &graph);
  module.def("hull_polygon", &hull_polygon_of);
  module.def("alpha_shape", &alpha_shape_of);
  module.def("largest_empty_circles", &empty_circles);
}

}  // namespace rondel::python
