// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/globe.h"

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "columns.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"

namespace rondel::python {
namespace {

using ValuesIn = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

SiteTable table_of(const PointsIn& points, const std::vector<ColumnIn>& columns) {
  SiteTable table;
  const std::span<const Point> sites = points_of(points);
  table.sites.assign(sites.begin(), sites.end());
  table.columns = make_columns(columns, false);
  return table;
}

nb::bytes page_of(const Triangulation& t, const PointsIn& points, const Diagram& diagram,
                  const std::vector<ColumnIn>& columns, const std::optional<ValuesIn>& values,
                  const Isolines* isolines, GlobeOptions options) {
  options.isolines = isolines;
  if (values) options.values = {values->data(), values->shape(0)};
  options.fill = values ? GlobeFill::values : GlobeFill::none;
  const std::string page =
      watched_quietly(t.num_sites(), threads_of(t), [&](const Execution& execution) {
        return globe_page(table_of(points, columns), t, diagram, options, execution);
      });
  return nb::bytes(page.data(), page.size());
}

}  // namespace

void add_globe(nb::module_& module) {
  module.def(
      "globe_page",
      [](const Triangulation& t, const PointsIn& points, const Diagram& diagram,
         const std::vector<ColumnIn>& columns, const std::optional<ValuesIn>& values,
         const Isolines* isolines, const std::string& name, const std::string& title,
         nb::handle show, bool sites, bool circles,
         const std::optional<std::tuple<double, double>>& view) {
        GlobeOptions options;
        options.title = title;
        options.value_name = name;
        options.lines = named<GlobeLines>("show", show);
        options.show_sites = sites;
        options.show_circles = circles;
        if (view) options.view = LonLat{std::get<0>(*view), std::get<1>(*view)};
        return page_of(t, points, diagram, columns, values, isolines, options);
      },
      nb::arg("triangulation"), nb::arg("points").noconvert(), nb::arg("diagram"),
      nb::arg("columns"), nb::kw_only(), nb::arg("values").none(), nb::arg("isolines").none(),
      nb::arg("name"), nb::arg("title"), nb::arg("show").none(), nb::arg("sites"),
      nb::arg("circles"), nb::arg("view").none());
  module.def("coast_lines", [] {
    CompressedRows<LonLat> coast = coast_lines();
    return std::tuple(to_array<double>(std::move(coast.values)),
                      offsets_out(std::move(coast.offsets)));
  });
  module.def("write_file", [](const std::string& path, const nb::bytes& content) {
    write_file(path, {content.c_str(), content.size()});
  });
}

}  // namespace rondel::python
