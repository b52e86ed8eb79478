// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <tuple>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "rondel/io.h"

namespace rondel::python {
namespace {

// Name, whether every cell that is not empty is a JSON number, and the cells.
using ColumnIn = std::tuple<std::string, bool, std::vector<std::string>>;

SiteTable make_table(const PointsIn& points, const std::vector<ColumnIn>& columns) {
  SiteTable table;
  table.sites = PointArray(points_of(points), nullptr);
  for (const auto& [name, is_numeric, cells] : columns) {
    Column column{.name = name, .is_numeric = is_numeric, .text = {}, .ends = {}};
    for (const std::string& cell : cells) {
      column.text += cell;
      column.ends.push_back(column.text.size());
    }
    table.columns.push_back(std::move(column));
  }
  return table;
}

}  // namespace

void add_files(nb::module_& module) {
  module.def(
      "write_cells",
      [](const std::string& path, const Triangulation& t, const PointsIn& points,
         const Diagram& diagram, const std::vector<ColumnIn>& columns, double tolerance_deg) {
        unlocked([&] {
          write_cells(path, make_table(points, columns), t, diagram, tolerance_deg);
          return true;
        });
      },
      nb::arg("path"), nb::arg("triangulation"), nb::arg("points").noconvert(), nb::arg("diagram"),
      nb::arg("columns"), nb::arg("tolerance_deg"));
  module.def(
      "write_triangles",
      [](const std::string& path, const Triangulation& t, const PointsIn& points) {
        unlocked([&] {
          write_triangles(path, make_table(points, {}), t);
          return true;
        });
      },
      nb::arg("path"), nb::arg("triangulation"), nb::arg("points").noconvert());
}

}  // namespace rondel::python
