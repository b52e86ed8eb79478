// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
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

SiteTable make_table(const PointsIn& points, const std::vector<ColumnIn>& columns) {
  SiteTable table;
  const std::span<const Point> sites = points_of(points);
  table.sites.assign(sites.begin(), sites.end());
  table.columns = make_columns(columns);
  return table;
}

}  // namespace

void add_files(nb::module_& module) {
  nb::class_<LonLatPolygons> polygons(module, "LonLatPolygons");
  using Rings = CompressedRows<LonLat>;
  add_fixed_array<double, &LonLatPolygons::rings, &Rings::values>(polygons, "positions");
  add_fixed_array<std::int64_t, &LonLatPolygons::rings, &Rings::offsets>(polygons, "rings");
  add_fixed_array<std::int32_t, &LonLatPolygons::owners>(polygons, "owners");
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
        return watched_quietly(t.num_sites(), threads_of(t), [&](const Execution& execution) {
          return cell_polygons(t, diagram, tolerance_deg, execution);
        });
      },
      nb::arg("triangulation"), nb::arg("diagram"), nb::arg("tolerance_deg"));
  module.def(
      "face_polygons",
      [](const Triangulation& t) {
        return watched_quietly(t.num_sites(), threads_of(t), [&](const Execution& execution) {
          return face_polygons(t, execution);
        });
      },
      nb::arg("triangulation"));
  module.def(
      "arc_lines",
      [](const PointsIn& starts, const PointsIn& ends) {
        std::vector<std::array<Point, 2>> arcs(starts.shape(0));
        for (std::size_t i = 0; i < arcs.size(); ++i) {
          arcs[i] = {points_of(starts)[i], points_of(ends)[i]};
        }
        CompressedRows<LonLat> lines = unlocked([&] { return arc_lines(arcs); });
        return std::tuple(to_array<double>(std::move(lines.values)),
                          offsets_out(std::move(lines.offsets)));
      },
      nb::arg("starts").noconvert(), nb::arg("ends").noconvert());
}

}  // namespace rondel::python
