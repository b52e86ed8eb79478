// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

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
#include "rondel/buffer.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "rondel/relate.h"
#include "rondel/set_operations.h"
#include "rondel/simplify.h"

namespace rondel::python {
namespace {

// Returns the polygons as cells, and what is to be said of them.
std::tuple<CellRings, std::vector<std::string>> cells_of(const GeometriesIn& given,
                                                         nb::handle edges, nb::handle invalid,
                                                         unsigned threads) {
  const PolygonOptions options = polygon_rules(edges, invalid);
  return read_geometries(given, [&](const auto& geometries) {
    return watched_quietly(0, threads, [&](const Execution& execution) {
      CellTable table = cells_in(geometries, options, execution);
      return std::tuple(std::move(table.cells), std::move(table.facts.remarks));
    });
  });
}

// Returns what is wrong with each polygon.
std::vector<std::string> faults_of(const GeometriesIn& given, nb::handle edges, unsigned threads) {
  const PolygonOptions options = polygon_rules(edges);
  return read_geometries(given, [&](const auto& geometries) {
    return watched_quietly(0, threads, [&](const Execution& execution) {
      return faults_in(geometries, options, execution);
    });
  });
}

// Returns the cells that cross or overlap themselves, each with a place.
std::tuple<ArrayOut<std::int32_t>, ArrayOut<double>> faulty_cells(const CellRings& cells,
                                                                  unsigned threads) {
  std::vector<Index> found;
  std::vector<Point> places;
  for (const CrossingCells& pair : watched_quietly(
           cells.corners.size(), threads,
           [&](const Execution& execution) { return overlapping_cells(cells, execution); })) {
    if (pair.first != pair.second) continue;
    found.push_back(pair.first);
    places.push_back(pair.place);
  }
  return {indices_out(std::move(found)), points_out(std::move(places))};
}

CellRings pairs_combined(const CellRings& first, const CellRings& second, const IndexPairsIn& pairs,
                         nb::handle how, unsigned threads) {
  const auto operation = named<SetOperation>("how", how);
  return watched_quietly(pairs.shape(0), threads, [&](const Execution& execution) {
    return combine_pairs(first, second, rows_of<std::array<Index, 2>>(pairs), operation, execution);
  });
}

// Returns the pieces and their polygons, and whether pieces overlap.
std::tuple<CellRings, ArrayOut<std::int32_t>, ArrayOut<std::int32_t>, bool> pieces_of(
    const CellRings& first, const CellRings& second, nb::handle how, unsigned threads) {
  const auto operation = named<SetOperation>("how", how);
  bool do_overlap = false;
  RegionPieces pieces = watched_quietly(
      first.corners.size() + second.corners.size(), threads, [&](const Execution& execution) {
        RegionPieces made = overlay_pieces(first, second, operation, execution);
        do_overlap = drawing_of(made.rings, execution) == CellDrawing::apart;
        return made;
      });
  return {std::move(pieces.rings), indices_out(std::move(pieces.cells)),
          indices_out(std::move(pieces.regions)), do_overlap};
}

// The relations of pairs.
struct RelationsOfPairs {
  std::vector<Relation> rows;
};

template <class Operand>
RelationsOfPairs relations_of(const Operand& first, const Operand& second,
                              const IndexPairsIn& pairs, unsigned threads) {
  return watched_quietly(pairs.shape(0), threads, [&](const Execution& execution) {
    return RelationsOfPairs{
        relate_pairs(first, second, rows_of<std::array<Index, 2>>(pairs), execution)};
  });
}

// Returns the answers to a question about each pair.
template <class Question>
ArrayOut<std::uint8_t> answers(const RelationsOfPairs& relations, const Question& question) {
  std::vector<std::uint8_t> found;
  found.reserve(relations.rows.size());
  for (const Relation& row : relations.rows) found.push_back(question(row) ? 1 : 0);
  return to_array<std::uint8_t>(std::move(found));
}

void add_relations(nb::module_& module) {
  nb::class_<RelationsOfPairs>(module, "RelationsOfPairs")
      .def("texts",
           [](const RelationsOfPairs& self) {
             std::vector<std::string> texts;
             for (const Relation& row : self.rows) texts.emplace_back(row.text());
             return texts;
           })
      .def(
          "are",
          [](const RelationsOfPairs& self, nb::handle predicate) {
            const auto asked = named<SpatialPredicate>("predicate", predicate);
            return answers(self, [&](const Relation& row) { return row.is(asked); });
          },
          nb::arg("predicate").none())
      .def(
          "match",
          [](const RelationsOfPairs& self, const std::string& pattern) {
            (void)Relation().matches(pattern);  // refuses what is no pattern
            return answers(self, [&](const Relation& row) { return row.matches(pattern); });
          },
          nb::arg("pattern"));
  module.def("relations", &relations_of<CellRings>, nb::arg("first"), nb::arg("second"),
             nb::arg("pairs").noconvert(), nb::arg("threads"));
  module.def("relations", &relations_of<Geometries>, nb::arg("first"), nb::arg("second"),
             nb::arg("pairs").noconvert(), nb::arg("threads"));
}

// Returns the buffers of points, lines and polygons, and remarks.
std::tuple<CellRings, std::vector<std::string>> buffers_in(const GeometriesIn& given,
                                                           double distance, double tolerance,
                                                           nb::handle edges, nb::handle invalid,
                                                           unsigned threads) {
  const PolygonOptions options = polygon_rules(edges, invalid);
  return read_geometries(given, [&](const auto& geometries) {
    return watched_quietly(0, threads, [&](const Execution& execution) {
      FeatureTable table = features_in(geometries, options, execution);
      return std::tuple(buffered(table.lines, table.polygons, {distance, tolerance}, execution),
                        std::move(table.facts.remarks));
    });
  });
}

CellRings buffers_of(const CellRings& cells, double distance, double tolerance, unsigned threads) {
  return watched_quietly(cells.corners.size(), threads, [&](const Execution& execution) {
    return buffered(cells, {distance, tolerance}, execution);
  });
}

CellRings simplified_of(const CellRings& cells, double tolerance, bool drop_small,
                        bool keep_boundary, unsigned threads) {
  const SimplifyOptions how{
      .tolerance = tolerance, .drop_small = drop_small, .keep_boundary = keep_boundary};
  return watched_quietly(cells.corners.size(), threads, [&](const Execution& execution) {
    return simplified(cells, how, execution);
  });
}

}  // namespace

void add_polygons(nb::module_& module) {
  module.def("cells_of_polygons", &cells_of, nb::arg("given"), nb::arg("edges").none(),
             nb::arg("invalid").none(), nb::arg("threads"));
  module.def("polygon_faults", &faults_of, nb::arg("given"), nb::arg("edges").none(),
             nb::arg("threads"));
  module.def("combine_pairs", &pairs_combined, nb::arg("first"), nb::arg("second"),
             nb::arg("pairs").noconvert(), nb::arg("how").none(), nb::arg("threads"));
  module.def("overlay_pieces", &pieces_of, nb::arg("first"), nb::arg("second"),
             nb::arg("how").none(), nb::arg("threads"));
  module.def(
      "unite",
      [](const CellRings& cells, unsigned threads) {
        return watched_quietly(cells.corners.size(), threads,
                               [&](const Execution& execution) { return unite(cells, execution); });
      },
      nb::arg("cells"), nb::arg("threads"));
  add_relations(module);
  module.def("buffers_in", &buffers_in, nb::arg("given"), nb::arg("distance"), nb::arg("tolerance"),
             nb::arg("edges").none(), nb::arg("invalid").none(), nb::arg("threads"));
  module.def("buffers_of", &buffers_of, nb::arg("cells"), nb::arg("distance"), nb::arg("tolerance"),
             nb::arg("threads"));
  module.def("simplified_of", &simplified_of, nb::arg("cells"), nb::arg("tolerance"),
             nb::arg("drop_small"), nb::arg("keep_boundary"), nb::arg("threads"));
  module.def("faulty_cells", &faulty_cells, nb::arg("cells"), nb::arg("threads"));
  module.def(
      "repaired",
      [](const CellRings& cells, unsigned threads) {
        return watched_quietly(cells.corners.size(), threads, [&](const Execution& execution) {
          return repaired(cells, execution);
        });
      },
      nb::arg("cells"), nb::arg("threads"));
}

}  // namespace rondel::python
