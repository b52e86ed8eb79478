// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/query.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "query_answers.h"
#include "rondel/delaunay.h"

namespace rondel::python {

LocationsOut locations_out(const std::vector<Location>& found) {
  struct Columns {
    std::vector<Index> where;
    std::vector<Index> faces;
    std::vector<Triple> sites;
  };
  Columns columns;
  columns.where.reserve(found.size());
  columns.faces.reserve(found.size());
  columns.sites.reserve(found.size());
  for (const Location& location : found) {
    columns.where.push_back(static_cast<Index>(location.where));
    columns.faces.push_back(location.face);
    columns.sites.push_back(location.sites);
  }
  const nb::gil_scoped_acquire acquired;
  return {indices_out(std::move(columns.where)), indices_out(std::move(columns.faces)),
          to_array<std::int32_t>(std::move(columns.sites))};
}

LocationsOut locate_all(const Locator& locator, std::span<const Point> queries,
                        const Execution& execution) {
  return locations_out(locator.locate(queries, execution));
}

// Returns one distance for each query: to its own site, or to the only one.
std::vector<double> distances(const Locator& locator, std::span<const Point> queries,
                              std::span<const Index> sites) {
  std::vector<double> result;
  result.reserve(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    result.push_back(locator.distance(queries[i], sites[sites.size() == 1 ? 0 : i]));
  }
  return result;
}

void add_query(nb::module_& module) {
  nb::class_<Locator>(module, "Locator")
      .def(
          "__init__",
          [](Locator* self, const Triangulation& t) {
            new (self) Locator(unlocked([&] { return Locator(t); }));
          },
          nb::arg("triangulation"))
      .def(
          "locate",
          [](const Locator& self, const PointsIn& queries, unsigned threads) {
            return watched_quietly(queries.shape(0), threads, [&](const Execution& execution) {
              return locate_all(self, points_of(queries), execution);
            });
          },
          nb::arg("queries").noconvert(), nb::arg("threads"))
      .def(
          "nearest",
          [](const Locator& self, const PointsIn& queries, unsigned threads) {
            return indices_out(
                watched_quietly(queries.shape(0), threads, [&](const Execution& execution) {
                  return self.nearest(points_of(queries), execution);
                }));
          },
          nb::arg("queries").noconvert(), nb::arg("threads"))
      .def(
          "k_nearest",
          [](const Locator& self, const PointsIn& queries, std::size_t k, unsigned threads) {
            return indices_out(
                watched_quietly(queries.shape(0), threads, [&](const Execution& execution) {
                  return self.k_nearest(points_of(queries), k, execution);
                }));
          },
          nb::arg("queries").noconvert(), nb::arg("k"), nb::arg("threads"))
      .def(
          "within",
          [](const Locator& self, const PointsIn& queries, double angle, unsigned threads) {
            return site_lists_out(
                watched_quietly(queries.shape(0), threads, [&](const Execution& execution) {
                  return self.within(points_of(queries), angle, execution);
                }));
          },
          nb::arg("queries").noconvert(), nb::arg("angle"), nb::arg("threads"))
      .def(
          "distance",
          [](const Locator& self, const PointsIn& queries, const IndicesIn& sites) {
            return to_array<double>(unlocked(
                [&] { return distances(self, points_of(queries), rows_of<Index>(sites)); }));
          },
          nb::arg("queries").noconvert(), nb::arg("sites").noconvert())
      .def(
          "conflict_region",
          [](const Locator& self, const std::array<double, 3>& query) {
            return indices_out(self.conflict_region(point_of(query)));
          },
          nb::arg("query"));
}

}  // namespace rondel::python
