// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/graphs.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "rondel/outlines.h"

namespace rondel::python {
namespace {

// Dictionaries have the members of the tuples that Python makes of them.
nb::dict graph(const Triangulation& t, nb::handle name) {
  const auto kind = named<GraphKind>("kind", name);
  SiteGraph found = watched_quietly(t.num_sites(), threads_of(t), [&](const Execution& execution) {
    return site_graph(t, kind, execution);
  });
  nb::dict made;
  made["edges"] = to_array<std::int32_t>(std::move(found.edges));
  made["lengths"] = to_array<double>(std::move(found.lengths));
  return made;
}

nb::dict outline_out(Outline&& outline) {
  nb::dict made;
  made["polygon_offsets"] = offsets_out(std::move(outline.offsets));
  made["ring_offsets"] = offsets_out(std::move(outline.rows.offsets));
  made["sites"] = indices_out(std::move(outline.rows.values));
  return made;
}

nb::dict hull_polygon_of(const Triangulation& t) {
  return outline_out(unlocked([&] { return hull_polygon(t); }));
}

nb::dict alpha_shape_of(const Triangulation& t, double radius) {
  return outline_out(watched_quietly(t.num_sites(), threads_of(t), [&](const Execution& execution) {
    return alpha_shape(t, radius, execution);
  }));
}

nb::dict empty_circles(const Triangulation& t, std::size_t count, bool anywhere) {
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
  nb::dict made;
  made["centers"] = points_out(std::move(middles));
  made["radii"] = to_array<double>(std::move(radii));
  made["sites"] = to_array<std::int32_t>(std::move(sites));
  return made;
}

}  // namespace

void add_graphs(nb::module_& module) {
  module.def("site_graph", &graph);
  module.def("hull_polygon", &hull_polygon_of);
  module.def("alpha_shape", &alpha_shape_of);
  module.def("largest_empty_circles", &empty_circles);
}

}  // namespace rondel::python
