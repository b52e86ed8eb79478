// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "columns.h"
#include "file_name.h"
#include "interrupt.h"
#include "module.h"
#include "rondel/io.h"
#include "rondel/polygons.h"

namespace rondel::python {
namespace {

using PolygonsOut = std::tuple<ArrayOut<double>, ArrayOut<std::int64_t>, ArrayOut<std::int32_t>>;

SiteTable make_table(const PointsIn& points, const std::vector<ColumnIn>& columns) {
  SiteTable table;
  const std::span<const Point> sites = points_of(points);
  table.sites.assign(sites.begin(), sites.end());
  table.columns = make_columns(columns);
  return table;
}

// Returns the positions (k, 2), the offsets of the rings and their owners.
PolygonsOut polygons_out(LonLatPolygons&& polygons) {
  return {to_array<double>(std::move(polygons.rings.values)),
          offsets_out(std::move(polygons.rings.offsets)), indices_out(std::move(polygons.owners))};
}

}  // namespace

void add_files(nb::module_& module) {
  module.def(
      "write_cells",
      [](const PathOut& path, const Triangulation& t, const PointsIn& points,
         const Diagram& diagram, const std::vector<ColumnIn>& columns, double tolerance_deg) {
        return written(path, [&](const FileName& file) {
          run_watched(points.shape(0), threads_of(t), nb::none(), [&](const Execution& execution) {
            write_cells(file, make_table(points, columns), t, diagram, tolerance_deg, execution);
          });
        });
      },
      nb::arg("path").none(), nb::arg("triangulation"), nb::arg("points").noconvert(),
      nb::arg("diagram"), nb::arg("columns"), nb::arg("tolerance_deg"));
  module.def(
      "write_triangles",
      [](const PathOut& path, const Triangulation& t, const PointsIn& points) {
        return written(path, [&](const FileName& file) {
          run_watched(points.shape(0), threads_of(t), nb::none(), [&](const Execution& execution) {
            write_triangles(file, make_table(points, {}), t, execution);
          });
        });
      },
      nb::arg("path").none(), nb::arg("triangulation"), nb::arg("points").noconvert());
  module.def(
      "cell_polygons",
      [](const Triangulation& t, const Diagram& diagram, double tolerance_deg) {
        return polygons_out(
            watched_quietly(t.num_sites(), threads_of(t), [&](const Execution& execution) {
              return cell_polygons(t, diagram, tolerance_deg, execution);
            }));
      },
      nb::arg("triangulation"), nb::arg("diagram"), nb::arg("tolerance_deg"));
  module.def(
      "face_polygons",
      [](const Triangulation& t) {
        return polygons_out(watched_quietly(
            t.num_sites(), threads_of(t),
            [&](const Execution& execution) { return face_polygons(t, execution); }));
      },
      nb::arg("triangulation"));
}

}  // namespace rondel::python
