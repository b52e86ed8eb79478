// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/constrained.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/tuple.h>

#include <array>
#include <cstdint>
#include <tuple>
#include <utility>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "query_answers.h"
#include "rondel/constrained_features.h"
#include "rondel/constrained_locator.h"
#include "rondel/geometries.h"

namespace rondel::python {
namespace {

using Ends = std::array<Index, 2>;

ConstrainedTriangulation build_constrained(const PointsIn& points, const IndexPairsIn& constraints,
                                           const std::array<double, 3>& center, bool is_split,
                                           unsigned threads, const nb::object& listener) {
  const Sites sites = sites_of(points);
  const ConstrainedOptions options = {
      .sphere = make_options(false, center, 1).sphere,
      .crossings = is_split ? ConstraintCrossings::split : ConstraintCrossings::refuse};
  return watched(points.shape(0), threads, listener, [&](const Execution& execution) {
    return constrained_delaunay(sites, rows_of<Ends>(constraints), options, execution);
  });
}

// Returns the faces in each polygon as offsets and faces.
std::tuple<ArrayOut<std::int64_t>, ArrayOut<std::int32_t>> faces_in_polygons(
    const ConstrainedTriangulation& result, const IndexPairsIn& constraints,
    const OffsetsIn& offsets, const IndicesIn& sides) {
  const CompressedRows<Index> polygons = {vector_of<std::uint64_t>(offsets),
                                          vector_of<Index>(sides)};
  CompressedRows<Index> inside =
      unlocked([&] { return faces_inside(result, rows_of<Ends>(constraints), polygons); });
  return {offsets_out(std::move(inside.offsets)), indices_out(std::move(inside.values))};
}

// Returns sites, constraints, the geometry of each constraint, and the sides of polygons.
std::tuple<ArrayOut<double>, ArrayOut<std::int32_t>, ArrayOut<std::int32_t>, ArrayOut<std::int64_t>,
           ArrayOut<std::int32_t>>
constraints_of_geometries(const Geometries& geometries) {
  FeatureConstraints made =
      unlocked([&] { return constraints_of_features(geometries.lines, geometries.polygons); });
  return {points_out(std::move(made.sites)), to_array<std::int32_t>(std::move(made.constraints)),
          indices_out(std::move(made.features)), offsets_out(std::move(made.polygons.offsets)),
          indices_out(std::move(made.polygons.values))};
}

CheckReport check_constrained_faces(const PointsIn& points, const IndexPairsIn& constraints,
                                    const TriplesIn& faces, const std::array<double, 3>& center,
                                    unsigned threads) {
  return watched_quietly(points.shape(0), threads, [&](const Execution& execution) {
    return check_constrained(points_of(points), rows_of<Ends>(constraints), rows_of<Triple>(faces),
                             make_options(false, center, 1).sphere, execution);
  });
}

}  // namespace

void add_constrained(nb::module_& module) {
  using Rows = CompressedRows<Index>;
  using Result = ConstrainedTriangulation;
  nb::class_<Result> made(module, "ConstrainedTriangulation");
  made.def(nb::init<>()).def_rw("triangulation", &Result::triangulation);
  add_array<std::int32_t, &Result::edges>(made, "edges");
  add_array<std::int64_t, &Result::sources, &Rows::offsets>(made, "source_offsets");
  add_array<std::int32_t, &Result::sources, &Rows::values>(made, "sources");
  add_array<std::uint8_t, &Result::sides>(made, "sides");
  nb::class_<ConstrainedLocator>(module, "ConstrainedLocator")
      .def(
          "__init__",
          [](ConstrainedLocator* self, const Result& result) {
            new (self) ConstrainedLocator(unlocked([&] { return ConstrainedLocator(result); }));
          },
          nb::arg("result"))
      .def(
          "locate",
          [](const ConstrainedLocator& self, const PointsIn& queries, unsigned threads) {
            return watched_quietly(queries.shape(0), threads, [&](const Execution& execution) {
              return locations_out(self.locate(points_of(queries), execution));
            });
          },
          nb::arg("queries").noconvert(), nb::arg("threads"));
  module.def("constrained_delaunay", &build_constrained, nb::arg("points").noconvert(),
             nb::arg("constraints").noconvert(), nb::arg("center"), nb::arg("is_split"),
             nb::arg("threads"), nb::arg("progress").none());
  module.def("faces_inside", &faces_in_polygons, nb::arg("result"),
             nb::arg("constraints").noconvert(), nb::arg("offsets").noconvert(),
             nb::arg("sides").noconvert());
  module.def("constraints_of_geometries", &constraints_of_geometries, nb::arg("geometries"));
  module.def(
      "short_lonlats",
      [](const PointsIn& points, double west_deg) {
        return to_array<double>(
            unlocked([&] { return short_lonlats(points_of(points), west_deg); }));
      },
      nb::arg("points").noconvert(), nb::arg("west_deg"));
  module.def("check_constrained", &check_constrained_faces, nb::arg("points").noconvert(),
             nb::arg("constraints").noconvert(), nb::arg("faces").noconvert(), nb::arg("center"),
             nb::arg("threads"));
}

}  // namespace rondel::python
