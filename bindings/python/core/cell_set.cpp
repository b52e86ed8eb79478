// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/cell_set.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "file_name.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "polygon_rules.h"
#include "rondel/geometries.h"
#include "rondel/named_grids.h"
#include "rondel/polygon_files.h"
#include "rondel/read_cells.h"

namespace rondel::python {
namespace {

// Meridians and parallels, and the name of the sides between them.
using LinesOut = std::tuple<ArrayOut<double>, ArrayOut<double>, std::string>;

// Returns the lines of a grid, or nothing for other cells.
std::optional<LinesOut> lines_out(const CellSet& cells) {
  if (cells.lines() == nullptr) return std::nullopt;
  LonLatGrid lines = *cells.lines();
  const GridSides sides = cells.has_parallels() ? GridSides::parallels : GridSides::great_circles;
  return LinesOut{to_array<double>(std::move(lines.lon_deg)),
                  to_array<double>(std::move(lines.lat_deg)), std::string(name_of(sides))};
}

// Offsets of the sides of each cell, and longitudes and latitudes of their ends.
using SidesIn = nb::ndarray<const double, nb::shape<-1, 4>, nb::c_contig, nb::device::cpu>;
using SidesOut = std::pair<ArrayOut<std::int64_t>, ArrayOut<double>>;

// Returns the straight sides of cells, or nothing if none are known.
std::optional<SidesOut> sides_out(const CellSet& cells) {
  CompressedRows<LonLatSide> sides = cells.sides();
  if (sides.size() == 0) return std::nullopt;
  return SidesOut{offsets_out(std::move(sides.offsets)), to_array<double>(std::move(sides.values))};
}

// Returns cells whose arcs stand for straight sides.
CellSet straight_polygons(const CellRings& rings, const OffsetsIn& offsets, const SidesIn& sides,
                          unsigned threads) {
  return unlocked([&] {
    CompressedRows<LonLatSide> rows{vector_of<std::uint64_t>(offsets),
                                    vector_of<LonLatSide>(sides)};
    return CellSet::polygons(rings, std::move(rows), {.threads = threads});
  });
}

// Returns a choice of the polygons whose group is not below 0, or of all without groups.
FeatureChoice chosen(const std::optional<IndicesIn>& groups) {
  if (!groups) return {};
  return [taken = vector_of<std::int32_t>(*groups)](std::size_t feature, auto&&) {
    return feature >= taken.size() || taken[feature] >= 0;
  };
}

// Reads the cells of a file, or of bytes of GeoJSON; polygons whose group is below 0 are left out.
CellSet read_cell_set(const PathIn& path, nb::handle sides, nb::handle edges, nb::handle overlap,
                      nb::handle invalid, const std::optional<IndicesIn>& groups,
                      nb::handle corners, unsigned threads) {
  const PolygonOptions rules = polygon_rules(edges, overlap, invalid);
  const CellFileOptions options{.sides = named<GridSides>("sides", sides),
                                .edges = rules.edges,
                                .invalid = rules.invalid,
                                .overlap = rules.overlap,
                                .is_taken = chosen(groups),
                                .corners = named<MissingCorners>("corners", corners)};
  return read_from(path, [&](const FileName& file) {
    return unlocked([&] { return CellSet::read(file, options, {.threads = threads}); });
  });
}

// Reads the cells of a mesh that Python has as the bytes of netCDF.
CellSet cells_of_mesh(const nb::bytes& content, unsigned threads) {
  std::string bytes(content.c_str(), content.size());
  return unlocked([&] {
    return CellSet::read(FileName::in_memory(bytes, "nc", "the data"), {}, {.threads = threads});
  });
}

// Returns the cells of polygons, those whose group is below 0 left out.
CellSet cells_of_geometries(const LonLatGeometries& geometries, nb::handle edges,
                            nb::handle overlap, nb::handle invalid,
                            const std::optional<IndicesIn>& groups, unsigned threads) {
  PolygonOptions options = polygon_rules(edges, overlap, invalid);
  options.is_taken = chosen(groups);
  return unlocked([&] {
    const Execution execution{.threads = threads};
    return CellSet::of(cells_of_polygons(geometries.polygons, options, execution),
                       GridSides::parallels, execution);
  });
}

// Returns the cells; the number of centers outside of them, of how many, and the first one; and
// whether most are. There may be no centers.
std::tuple<CellSet, std::array<std::size_t, 3>, bool> corner_cells(const PairsIn& corners,
                                                                   std::size_t corners_per_cell,
                                                                   const PairsIn& centers,
                                                                   unsigned threads) {
  return unlocked([&] {
    const CellRings cells = cells_of_corners(rows_of<LonLat>(corners), corners_per_cell);
    CentersOutside found;
    if (centers.shape(0) > 0) found = centers_outside(cells, rows_of<LonLat>(centers));
    return std::tuple(CellSet::polygons(cells, {.threads = threads}),
                      std::array{found.number, found.of, found.first}, found.are_most());
  });
}

ArrayOut<double> corners_of_nodes(const PairsIn& nodes, std::array<std::size_t, 2> node_shape,
                                  const PairsIn& centers, std::array<std::size_t, 2> shape) {
  return to_array<double>(corners_of_grid(rows_of<LonLat>(nodes), {node_shape[0], node_shape[1]},
                                          rows_of<LonLat>(centers), {shape[0], shape[1]}));
}

// The members of a column.
using ColumnText = std::tuple<std::string, bool, std::string, std::vector<std::uint64_t>,
                              std::vector<bool>, std::vector<std::pair<std::string, std::string>>>;

void add_cell_facts(nb::module_& module) {
  nb::class_<Column>(module, "Column")
      .def(
          "__init__",
          [](Column* self, const ColumnText& text) {
            std::apply([&](const auto&... members) { new (self) Column{members...}; }, text);
          },
          nb::arg("text"))
      .def("__reduce__", [](const nb::object& self) {
        const auto& [name, is_numeric, text, ends, is_json, attributes] =
            nb::cast<const Column&>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(ColumnText{name, is_numeric, text, ends,
                                                                     is_json, attributes}));
      });
  nb::class_<CellFacts> facts(module, "CellFacts");
  add_array<double, &CellFacts::centers>(facts, "centers");
  add_array<std::int32_t, &CellFacts::mask>(facts, "mask");
  facts.def(nb::init<>())
      .def(nb::init<const CellFacts&>(), nb::arg("facts"))
      .def_rw("name", &CellFacts::name)
      .def_rw("convention", &CellFacts::convention)
      .def_prop_rw(
          "axes",
          [](const CellFacts& self) { return std::tuple(self.axes.lon_deg, self.axes.lat_deg); },
          [](CellFacts& self, const std::tuple<std::vector<double>, std::vector<double>>& axes) {
            self.axes = {std::get<0>(axes), std::get<1>(axes)};
          })
      .def_rw("shape", &CellFacts::shape)
      .def_rw("columns", &CellFacts::columns)
      .def_rw("has_corners", &CellFacts::has_corners)
      .def_rw("are_corners_made", &CellFacts::are_corners_made)
      .def_rw("remarks", &CellFacts::remarks);
}

// Adds the functions that make cells of grids.
void add_grid_makers(nb::class_<CellSet>& cells) {
  cells
      .def_static(
          "lonlat_grid",
          [](const NumbersIn& lon, const NumbersIn& lat, nb::handle sides, unsigned threads) {
            const auto grid_sides = named<GridSides>("sides", sides);
            const LonLatGrid grid{vector_of<double>(lon), vector_of<double>(lat)};
            return unlocked(
                [&] { return CellSet::lonlat_grid(grid, grid_sides, {.threads = threads}); });
          },
          nb::arg("lon").noconvert(), nb::arg("lat").noconvert(), nb::arg("sides").none(),
          nb::arg("threads"))
      .def_static(
          "global_grid",
          [](std::uint64_t nlon, std::uint64_t nlat, nb::handle sides, unsigned threads) {
            const auto grid_sides = named<GridSides>("sides", sides);
            return unlocked([&] {
              return CellSet::lonlat_grid(GlobalGrid{nlon, nlat}, grid_sides, {.threads = threads});
            });
          },
          nb::arg("nlon"), nb::arg("nlat"), nb::arg("sides").none(), nb::arg("threads"))
      .def_static(
          "named",
          [](const std::string& name, nb::handle sides, unsigned threads) {
            const auto grid_sides = named<GridSides>("sides", sides);
            return unlocked(
                [&] { return NamedGrid(name, grid_sides).cells({.threads = threads}); });
          },
          nb::arg("name"), nb::arg("sides").none(), nb::arg("threads"))
      .def_static(
          "some_of_named",
          [](const std::string& name, const IndicesIn& numbers, unsigned threads) {
            const auto some = vector_of<Index>(numbers);
            return unlocked([&] { return NamedGrid(name).cells(some, {.threads = threads}); });
          },
          nb::arg("name"), nb::arg("numbers").noconvert(), nb::arg("threads"));
}

// Adds the functions that make cells.
void add_makers(nb::class_<CellSet>& cells) {
  cells
      .def_static(
          "voronoi",
          [](const Triangulation& t, unsigned threads) {
            return unlocked([&] { return CellSet::voronoi(t, {.threads = threads}); });
          },
          nb::arg("triangulation"), nb::arg("threads"))
      .def_static(
          "triangles",
          [](const Triangulation& t, unsigned threads) {
            return unlocked([&] { return CellSet::triangles(t, {.threads = threads}); });
          },
          nb::arg("triangulation"), nb::arg("threads"))
      .def_static(
          "polygons",
          [](const CellRings& rings, unsigned threads) {
            return unlocked([&] { return CellSet::polygons(rings, {.threads = threads}); });
          },
          nb::arg("rings"), nb::arg("threads"))
      .def_static("straight_polygons", &straight_polygons, nb::arg("rings"), nb::arg("offsets"),
                  nb::arg("sides"), nb::arg("threads"))
      .def_static(
          "valid_polygons",
          [](const CellRings& rings, unsigned threads) {
            return unlocked([&] { return CellSet::valid_polygons(rings, {.threads = threads}); });
          },
          nb::arg("rings"), nb::arg("threads"))
      .def_static("read", &read_cell_set, nb::arg("path"), nb::arg("sides").none(),
                  nb::arg("edges").none(), nb::arg("overlap").none(), nb::arg("invalid").none(),
                  nb::arg("groups").noconvert().none(), nb::arg("corners").none(),
                  nb::arg("threads"))
      .def_static("of_mesh", &cells_of_mesh, nb::arg("content"), nb::arg("threads"))
      .def_static("of_geometries", &cells_of_geometries, nb::arg("geometries"),
                  nb::arg("edges").none(), nb::arg("overlap").none(), nb::arg("invalid").none(),
                  nb::arg("groups").noconvert().none(), nb::arg("threads"));
}

// Adds how data say on which named grid they are.
void add_grid_mappings(nb::module_& module) {
  using Texts = std::vector<std::pair<std::string, std::string>>;
  using Numbers = std::vector<std::pair<std::string, double>>;
  module.def(
      "grid_named_by",
      [](const Texts& texts, const Numbers& numbers) {
        const std::string name = grid_named_by({texts, numbers});
        std::vector<std::uint64_t> shape;
        if (!name.empty()) shape = NamedGrid(name).shape();
        return std::pair(name, shape);
      },
      nb::arg("texts"), nb::arg("numbers"));
  module.def(
      "lack_of_mapping",
      [](const Texts& texts, const Numbers& numbers) {
        return lack_of_mapping({texts, numbers});
      },
      nb::arg("texts"), nb::arg("numbers"));
  module.def(
      "numbers_at",
      [](const std::string& name, const PairsIn& places, double max_apart_deg) {
        return indices_out(unlocked(
            [&] { return NamedGrid(name).numbers_at(rows_of<LonLat>(places), max_apart_deg); }));
      },
      nb::arg("name"), nb::arg("places").noconvert(), nb::arg("max_apart_deg"));
  module.def(
      "grid_mapping",
      [](const std::string& name) {
        const GridMapping mapping =
            NamedGrid::is_name(name) ? NamedGrid(name).mapping() : GridMapping();
        std::vector<std::pair<std::string, std::int64_t>> numbers;  // a mapping has integers alone
        numbers.reserve(mapping.numbers.size());
        for (const auto& [key, number] : mapping.numbers) {
          numbers.emplace_back(key, static_cast<std::int64_t>(number));
        }
        return std::pair(mapping.texts, numbers);
      },
      nb::arg("name"));
}

}  // namespace

void add_cell_set(nb::module_& module) {
  add_grid_mappings(module);
  add_cell_facts(module);
  nb::class_<CellSet> cells(module, "CellSet");
  add_makers(cells);
  add_grid_makers(cells);
  cells.def_prop_ro("num_cells", &CellSet::num_cells)
      .def_prop_ro("covers_sphere", &CellSet::covers_sphere)
      .def_prop_ro("facts", &CellSet::facts, nb::rv_policy::reference_internal)
      .def("with_facts", &CellSet::with_facts, nb::arg("facts"))
      .def_prop_ro("areas",
                   [](const nb::object& self) {
                     return array_of<double>(self, nb::cast<const CellSet&>(self).areas());
                   })
      .def("centers", [](const CellSet& self) { return points_out(self.centers()); })
      .def("lines", &lines_out)
      .def("sides", &sides_out)
      .def("rings", [](const CellSet& self) { return unlocked([&] { return self.rings(); }); })
      .def("given_rings",
           [](const CellSet& self) { return unlocked([&] { return self.given_rings(); }); })
      .def("places",
           [](const CellSet& self) {
             return to_array<double>(unlocked([&] { return self.places(); }));
           })
      .def("corners",
           [](const CellSet& self) {
             return to_array<double>(unlocked([&] { return self.corners(); }));
           })
      .def("bounds",
           [](const CellSet& self) {
             return to_array<double>(unlocked([&] { return self.bounds(); }));
           })
      .def(
          "repaired",
          [](const CellSet& self, unsigned threads) {
            return unlocked([&] { return self.repaired({.threads = threads}); });
          },
          nb::arg("threads"));
  module.def("corner_cells", &corner_cells, nb::arg("corners").noconvert(),
             nb::arg("corners_per_cell"), nb::arg("centers").noconvert(), nb::arg("threads"));
  module.def("corners_of_grid", &corners_of_nodes, nb::arg("nodes").noconvert(),
             nb::arg("node_shape"), nb::arg("centers").noconvert(), nb::arg("shape"));
}

}  // namespace rondel::python
