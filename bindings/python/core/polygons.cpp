// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "file_name.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "rondel/set_operations.h"

namespace rondel::python {
namespace {

// Returns the polygons of a file, or of bytes of GeoJSON, and what is to be said of them.
std::tuple<CellRings, std::vector<std::string>> polygons_in(const PathIn& path, nb::handle edges,
                                                            nb::handle invalid, unsigned threads) {
  const PolygonOptions options{.edges = named<PolygonEdges>("edges", edges),
                               .invalid = named<InvalidPolygons>("invalid", invalid)};
  return read_from(path, [&](const FileName& file) {
    return watched_quietly(0, threads, [&](const Execution& execution) {
      CellTable table = read_polygons(file, options, execution);
      return std::tuple(std::move(table.cells), std::move(table.facts.remarks));
    });
  });
}

// Returns what is wrong with each polygon.
std::vector<std::string> faults_in(const PathIn& path, nb::handle edges, unsigned threads) {
  const PolygonOptions options{.edges = named<PolygonEdges>("edges", edges)};
  return read_from(path, [&](const FileName& file) {
    return watched_quietly(0, threads, [&](const Execution& execution) {
      return polygon_faults(file, options, execution);
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
        do_overlap = !overlapping_cells(made.rings, execution).empty();
        return made;
      });
  return {std::move(pieces.rings), indices_out(std::move(pieces.cells)),
          indices_out(std::move(pieces.regions)), do_overlap};
}

}  // namespace

void add_polygons(nb::module_& module) {
  module.def("read_polygons", &polygons_in, nb::arg("path"), nb::arg("edges").none(),
             nb::arg("invalid").none(), nb::arg("threads"));
  module.def("polygon_faults", &faults_in, nb::arg("path"), nb::arg("edges").none(),
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
