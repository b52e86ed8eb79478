// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points, lines and polygons together: operands that have other parts than polygons.
#include "rondel/geometries.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "geometries_in.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "polygon_rules.h"
#include "rondel/regions.h"
#include "rondel/simplify.h"

namespace rondel::python {
namespace {

// Geometries, and the least and the greatest longitude of each.
using GeometriesOut = std::tuple<Geometries, ArrayOut<double>>;

// Returns the geometries, and what is to be said of them.
std::tuple<GeometriesOut, std::vector<std::string>> geometries_of(const GeometriesIn& given,
                                                                  nb::handle edges,
                                                                  nb::handle invalid,
                                                                  unsigned threads) {
  const PolygonOptions options = polygon_rules(edges, invalid);
  return read_geometries(given, [&](const auto& geometries) {
    FeatureTable table = watched_quietly(0, threads, [&](const Execution& execution) {
      return features_in(geometries, options, execution);
    });
    return std::tuple(GeometriesOut({std::move(table.lines), std::move(table.polygons)},
                                    to_array<double>(std::move(table.longitudes))),
                      std::move(table.facts.remarks));
  });
}

// Returns the extent of all rows: the least and the greatest longitude of each.
LongitudeExtent extent_of(const PairsIn& rows) {
  LongitudeExtent all;
  for (const LongitudeExtent& one : rows_of<LongitudeExtent>(rows)) all.include(one);
  return all;
}

// Returns the pieces and their geometries, and how many lines and points were left out.
std::tuple<Geometries, ArrayOut<std::int32_t>, ArrayOut<std::int32_t>, std::size_t>
geometry_pieces_of(const Geometries& first, const Geometries& second, nb::handle how,
                   bool keeps_touching, unsigned threads) {
  const auto operation = named<SetOperation>("how", how);
  std::size_t num_left_out = 0;
  GeometryPieces made =
      watched_quietly(first.polygons.corners.size() + second.polygons.corners.size(), threads,
                      [&](const Execution& execution) {
                        GeometryPieces all = overlay_pieces(first, second, operation, execution);
                        if (keeps_touching) return all;
                        GeometryPieces some = without_touching_parts(all, first, second);
                        num_left_out = all.pieces.lines.rows.size() - some.pieces.lines.rows.size();
                        return some;
                      });
  return {std::move(made.pieces), indices_out(std::move(made.first)),
          indices_out(std::move(made.second)), num_left_out};
}

// Returns the simplified geometries, remarks, and whether polygons overlap.
std::tuple<Geometries, std::vector<std::string>, bool> simplified_in(
    const GeometriesIn& given, double tolerance, bool drop_small, bool keep_boundary,
    double read_deg, nb::handle edges, nb::handle invalid, unsigned threads) {
  PolygonOptions options = polygon_rules(edges, invalid);
  options.tolerance_deg = std::min(options.tolerance_deg, read_deg);
  const SimplifyOptions how{
      .tolerance = tolerance, .drop_small = drop_small, .keep_boundary = keep_boundary};
  return read_geometries(given, [&](const auto& geometries) {
    return watched_quietly(0, threads, [&](const Execution& execution) {
      FeatureTable table = features_in(geometries, options, execution);
      SimplifiedFeatures made = simplified(table.lines, table.polygons, how, execution);
      const bool do_overlap = drawing_of(made.polygons, execution) == CellDrawing::apart;
      return std::tuple(Geometries{std::move(made.lines), std::move(made.polygons)},
                        std::move(table.facts.remarks), do_overlap);
    });
  });
}

// Returns lines in longitude and latitude: positions, offsets and owners.
std::tuple<ArrayOut<double>, ArrayOut<std::int64_t>, ArrayOut<std::int32_t>> drawn_lines(
    const Geometries& geometries, double tolerance_deg, unsigned threads) {
  LonLatLines drawn =
      unlocked([&] { return lonlat_lines(geometries.lines, tolerance_deg, {.threads = threads}); });
  return {to_array<double>(std::move(drawn.parts.values)),
          offsets_out(std::move(drawn.parts.offsets)), indices_out(std::move(drawn.owners))};
}

}  // namespace

void add_geometries(nb::module_& module) {
  using PointRows = CompressedRows<Point>;
  nb::class_<Geometries> made(module, "Geometries");
  add_array<std::int64_t, &Geometries::lines, &FeatureLines::offsets>(made, "line_groups");
  add_array<std::int64_t, &Geometries::lines, &FeatureLines::rows, &PointRows::offsets>(made,
                                                                                        "lines");
  add_array<double, &Geometries::lines, &FeatureLines::rows, &PointRows::values>(made,
                                                                                 "line_points");
  made.def(nb::init<>())
      .def_rw("polygons", &Geometries::polygons)
      .def("line_lengths",
           [](const Geometries& self) {
             return to_array<double>(unlocked([&] { return lengths(self.lines); }));
           })
      .def("drawn_lines", &drawn_lines, nb::arg("tolerance_deg"), nb::arg("threads"));
  module.def(
      "west_of",
      [](const PairsIn& given, const PairsIn& otherwise) {
        return west_of(extent_of(given), extent_of(otherwise));
      },
      nb::arg("given").noconvert(), nb::arg("otherwise").noconvert());
  module.def("geometries_of", &geometries_of, nb::arg("given"), nb::arg("edges").none(),
             nb::arg("invalid").none(), nb::arg("threads"));
  module.def(
      "combine_geometry_pairs",
      [](const Geometries& first, const Geometries& second, const IndexPairsIn& pairs,
         nb::handle how, unsigned threads) {
        const auto operation = named<SetOperation>("how", how);
        return watched_quietly(pairs.shape(0), threads, [&](const Execution& execution) {
          return combine_pairs(first, second, rows_of<std::array<Index, 2>>(pairs), operation,
                               execution);
        });
      },
      nb::arg("first"), nb::arg("second"), nb::arg("pairs").noconvert(), nb::arg("how").none(),
      nb::arg("threads"));
  module.def(
      "unite_geometries",
      [](const Geometries& geometries, unsigned threads) {
        return watched_quietly(
            geometries.lines.rows.values.size(), threads,
            [&](const Execution& execution) { return unite(geometries, execution); });
      },
      nb::arg("geometries"), nb::arg("threads"));
  module.def("overlay_geometry_pieces", &geometry_pieces_of, nb::arg("first"), nb::arg("second"),
             nb::arg("how").none(), nb::arg("keeps_touching"), nb::arg("threads"));
  module.def("simplified_in", &simplified_in, nb::arg("given"), nb::arg("tolerance"),
             nb::arg("drop_small"), nb::arg("keep_boundary"), nb::arg("read_deg"),
             nb::arg("edges").none(), nb::arg("invalid").none(), nb::arg("threads"));
}

}  // namespace rondel::python
