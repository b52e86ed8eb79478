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
#include "rondel/set_operations.h"

namespace rondel::python {
namespace {

// Returns the polygons of a file, or of bytes of GeoJSON, and what is to be said of them.
std::tuple<CellRings, std::vector<std::string>> polygons_in(const PathIn& path, nb::handle edges,
                                                            unsigned threads) {
  const PolygonOptions options{.edges = named<PolygonEdges>("edges", edges)};
  return read_from(path, [&](const FileName& file) {
    return watched_quietly(0, threads, [&](const Execution& execution) {
      CellTable table = read_polygons(file, options, execution);
      return std::tuple(std::move(table.cells), std::move(table.facts.remarks));
    });
  });
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
}

}  // namespace rondel::python
