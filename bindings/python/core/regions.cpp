// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/regions.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "columns.h"
#include "file_name.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "polygon_rules.h"
#include "rondel/cell_set.h"
#include "rondel/feature_cells.h"
#include "rondel/geometries.h"

namespace rondel::python {
namespace {

LonLatRegions polygons_of(const CellRings& rings, double tolerance_deg, unsigned threads,
                          nb::handle drawing) {
  const auto as_told = named<CellDrawing>("drawing", drawing);
  return watched_quietly(rings.corners.size(), threads, [&](const Execution& execution) {
    return region_polygons(rings, tolerance_deg, execution, as_told);
  });
}

void add_region_functions(nb::module_& module) {
  module.def(
      "clip",
      [](const CellSet& cells, const CellSet& regions, unsigned threads,
         const nb::object& listener) {
        return watched(cells.num_cells(), threads, listener,
                       [&](const Execution& execution) { return clip(cells, regions, execution); });
      },
      nb::arg("cells"), nb::arg("regions"), nb::arg("threads"), nb::arg("progress").none());
  // Binds the pieces of cells and regions, joined by the groups of regions, with the cell and the
  // group of each piece.
  module.def(
      "intersection",
      [](const CellSet& cells, const CellSet& regions, const IndicesIn& groups, unsigned threads,
         const nb::object& listener) {
        RegionPieces pieces =
            watched(cells.num_cells(), threads, listener, [&](const Execution& execution) {
              return dissolve(intersection(cells, regions, execution), {}, rows_of<Index>(groups),
                              execution);
            });
        return std::tuple(std::move(pieces.rings), indices_out(std::move(pieces.cells)),
                          indices_out(std::move(pieces.regions)));
      },
      nb::arg("cells"), nb::arg("regions"), nb::arg("groups").noconvert(), nb::arg("threads"),
      nb::arg("progress").none());
  module.def(
      "feature_cells",
      [](const PathIn& path, double tolerance, nb::handle edges, nb::handle overlap,
         nb::handle invalid, const CellSet* within, unsigned threads, const nb::object& listener) {
        const PolygonOptions options = polygon_rules(edges, overlap, invalid);
        return read_from(path, [&](const FileName& file) {
          return watched(0, threads, listener, [&](const Execution& execution) {
            FeatureTable table = read_features(file, options, execution);
            CellRings made = within == nullptr
                                 ? feature_cells(table.lines, table.polygons, tolerance, execution)
                                 : clipped_feature_cells(table.lines, table.polygons, tolerance,
                                                         *within, execution);
            return std::tuple(std::move(made), std::move(table.facts.remarks));
          });
        });
      },
      nb::arg("path"), nb::arg("tolerance"), nb::arg("edges").none(), nb::arg("overlap").none(),
      nb::arg("invalid").none(), nb::arg("within").none(), nb::arg("threads"),
      nb::arg("progress").none());
  module.def(
      "cell_rings", [](const CellSet& cells) { return unlocked([&] { return cells.rings(); }); },
      nb::arg("cells"));
}

using LonLatRows = CompressedRows<LonLat>;
using LonLatRowGroups = RowGroups<LonLatRows>;

void add_lonlat_geometries(nb::module_& module) {
  using Given = LonLatGeometries;
  nb::class_<Given> given(module, "LonLatGeometries");
  add_array<std::int64_t, &Given::lines, &LonLatRowGroups::offsets>(given, "line_groups");
  add_array<std::int64_t, &Given::lines, &LonLatRowGroups::rows, &LonLatRows::offsets>(given,
                                                                                       "lines");
  add_array<double, &Given::lines, &LonLatRowGroups::rows, &LonLatRows::values>(given,
                                                                                "line_positions");
  add_array<std::int64_t, &Given::polygons, &LonLatMultiPolygons::offsets>(given, "polygon_groups");
  add_array<std::int64_t, &Given::polygons, &LonLatMultiPolygons::rows, &LonLatRowGroups::offsets>(
      given, "polygons");
  add_array<std::int64_t, &Given::polygons, &LonLatMultiPolygons::rows, &LonLatRowGroups::rows,
            &LonLatRows::offsets>(given, "rings");
  add_array<double, &Given::polygons, &LonLatMultiPolygons::rows, &LonLatRowGroups::rows,
            &LonLatRows::values>(given, "ring_positions");
  given.def(nb::init<>());
}

}  // namespace

void add_regions(nb::module_& module) {
  nb::class_<LonLatRegions> drawn(module, "LonLatRegions");
  add_fixed_array<double, &LonLatRegions::polygons, &LonLatRowGroups::rows, &LonLatRows::values>(
      drawn, "positions");
  add_fixed_array<std::int64_t, &LonLatRegions::polygons, &LonLatRowGroups::rows,
                  &LonLatRows::offsets>(drawn, "rings");
  add_fixed_array<std::int64_t, &LonLatRegions::polygons, &LonLatRowGroups::offsets>(drawn,
                                                                                     "polygons");
  add_fixed_array<std::int32_t, &LonLatRegions::owners>(drawn, "owners");
  nb::class_<CellRings> rings(module, "CellRings");
  add_array<std::int64_t, &CellRings::cells>(rings, "cells");
  add_array<std::int64_t, &CellRings::rings>(rings, "rings");
  add_array<std::int32_t, &CellRings::corners>(rings, "corners");
  add_array<double, &CellRings::points>(rings, "points");
  add_array<std::int32_t, &CellRings::whole>(rings, "whole");
  rings.def(nb::init<>())
      .def_prop_ro("num_cells", &CellRings::num_cells)
      .def("areas",
           [](const CellRings& self) {
             return to_array<double>(unlocked([&] { return areas(self); }));
           })
      .def("lengths",
           [](const CellRings& self) {
             return to_array<double>(unlocked([&] { return lengths(self); }));
           })
      .def(
          "dissolve",
          [](const CellRings& self, const IndicesIn& groups, std::size_t num_groups,
             unsigned threads, const nb::object& listener) {
            return watched(self.corners.size(), threads, listener, [&](const Execution& execution) {
              return dissolve(self, rows_of<Index>(groups), num_groups, execution);
            });
          },
          nb::arg("groups").noconvert(), nb::arg("num_groups"), nb::arg("threads"),
          nb::arg("progress").none())
      .def("polygons", &polygons_of, nb::arg("tolerance_deg"), nb::arg("threads"),
           nb::arg("drawing") = "together")
      .def(
          "write",
          [](const CellRings& self, const PathOut& path, const std::vector<ColumnIn>& columns,
             double tolerance_deg) {
            return written(path, [&](const FileName& file) {
              run_watched(self.corners.size(), 0, nb::none(), [&](const Execution& execution) {
                write_regions(file, self, make_columns(columns), tolerance_deg, execution);
              });
            });
          },
          nb::arg("path").none(), nb::arg("columns"), nb::arg("tolerance_deg"));
  add_lonlat_geometries(module);
  add_region_functions(module);
}

}  // namespace rondel::python
