// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/remap.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
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
#include "rondel/cell_set.h"
#include "rondel/mesh_files.h"
#include "rondel/polygon_files.h"

namespace rondel::python {
namespace {

using RingsOut = std::tuple<ArrayOut<std::int64_t>, ArrayOut<std::int64_t>, ArrayOut<std::int32_t>,
                            ArrayOut<double>, ArrayOut<std::int32_t>>;
// The weights, the areas of sources and of targets, and the fractions of both.
using RemapOut =
    std::tuple<Weights, ArrayOut<double>, ArrayOut<double>, ArrayOut<double>, ArrayOut<double>>;

std::vector<std::uint64_t> offsets_of(const OffsetsIn& offsets) {
  const auto numbers = rows_of<std::uint64_t>(offsets);
  return {numbers.begin(), numbers.end()};
}

CellRings rings_of(const OffsetsIn& cells, const OffsetsIn& rings, const IndicesIn& corners,
                   const PointsIn& points, const IndicesIn& whole) {
  const auto indices = rows_of<Index>(corners);
  const auto places = points_of(points);
  const auto named = rows_of<Index>(whole);
  return {.cells = offsets_of(cells),
          .rings = offsets_of(rings),
          .corners = {indices.begin(), indices.end()},
          .points = {places.begin(), places.end()},
          .whole = {named.begin(), named.end()}};
}

RingsOut rings_out(CellRings rings) {
  return {offsets_out(std::move(rings.cells)), offsets_out(std::move(rings.rings)),
          indices_out(std::move(rings.corners)), points_out(std::move(rings.points)),
          indices_out(std::move(rings.whole))};
}

// Returns the partition, its mask, its shape, the centers of the file in degrees, the remarks of the
// reader, and the meridians and parallels between the cells, if it is a grid.
nb::tuple read_cell_set(const std::string& path, nb::handle sides, unsigned threads) {
  const auto grid_sides = named<GridSides>("sides", sides);
  auto [partition, table] = unlocked([&] {
    CellTable read = read_cells(path);
    CellSet made = partition_of(read, grid_sides, {.threads = threads});
    return std::tuple(std::move(made), std::move(read));
  });
  LonLatGrid lines = table.grid.value_or(LonLatGrid{});
  nb::list lengths;
  for (const std::uint64_t length : table.shape) lengths.append(length);
  return nb::make_tuple(std::move(partition), to_array<std::int32_t>(std::move(table.mask)),
                        nb::tuple(lengths), to_array<double>(std::move(table.centers)),
                        table.remarks, to_array<double>(std::move(lines.lon_deg)),
                        to_array<double>(std::move(lines.lat_deg)));
}

std::vector<std::int32_t> mask_of(const IndicesIn& mask) {
  return {mask.data(), mask.data() + mask.size()};
}

// Returns the partition and the properties of its cells; polygons whose group is below 0 are left
// out.
// Returns the cells, the properties and the remarks of the reader.
std::tuple<CellSet, CellColumns, std::vector<std::string>> read_polygon_cells(
    const std::string& path, nb::handle edges, nb::handle overlap,
    const std::optional<IndicesIn>& groups, unsigned threads) {
  PolygonOptions options{.edges = named<PolygonEdges>("edges", edges),
                         .overlap = named<PolygonOverlap>("overlap", overlap)};
  if (groups) {
    options.is_taken = [taken = mask_of(*groups)](std::size_t feature, auto&&) {
      return feature >= taken.size() || taken[feature] >= 0;
    };
  }
  return unlocked([&] {
    PolygonTable table = read_polygons(path, options, {.threads = threads});
    return std::tuple(CellSet(table.cells, {.threads = threads}),
                      CellColumns{std::move(table.columns)}, std::move(table.remarks));
  });
}

// The members of a column.
using ColumnText =
    std::tuple<std::string, bool, std::string, std::vector<std::uint64_t>, std::vector<bool>>;

std::vector<ColumnText> texts_of_columns(const CellColumns& self) {
  std::vector<ColumnText> made;
  for (const Column& column : self.columns) {
    made.emplace_back(column.name, column.is_numeric, column.text, column.ends, column.is_json);
  }
  return made;
}

void set_columns(CellColumns& self, const std::vector<ColumnText>& texts) {
  self.columns.clear();
  for (const auto& [name, is_numeric, text, ends, is_json] : texts) {
    self.columns.push_back({name, is_numeric, text, ends, is_json});
  }
}

std::vector<double> numbers_of(const NumbersIn& array) {
  return {array.data(), array.data() + array.size()};
}

// Returns the cells; the number of centers outside of them, of how many, and the first one; and
// whether most are. There may be no centers.
std::tuple<CellSet, std::array<std::size_t, 3>, bool> corner_cells(const PairsIn& corners,
                                                                   std::size_t of_each,
                                                                   const PairsIn& centers,
                                                                   unsigned threads) {
  return unlocked([&] {
    const CellRings cells = cells_of_corners(rows_of<LonLat>(corners), of_each);
    CentersOutside found;
    if (centers.shape(0) > 0) found = centers_outside(cells, rows_of<LonLat>(centers));
    return std::tuple(CellSet(cells, {.threads = threads}),
                      std::array{found.number, found.of, found.first}, found.are_most());
  });
}

ArrayOut<double> corners_of_nodes(const PairsIn& nodes, std::array<std::size_t, 2> node_shape,
                                  const PairsIn& centers, std::array<std::size_t, 2> shape) {
  return to_array<double>(corners_of_grid(rows_of<LonLat>(nodes), {node_shape[0], node_shape[1]},
                                          rows_of<LonLat>(centers), {shape[0], shape[1]}));
}

RemapOut remap_of(const CellSet& source, const CellSet& target, unsigned order, nb::handle norm,
                  const IndicesIn& source_mask, const IndicesIn& target_mask, nb::handle overlap,
                  unsigned threads, const nb::object& listener) {
  const RemapOptions options{
      .order = order,
      .norm = named<RemapNorm>("norm", norm),
      .source_mask = mask_of(source_mask),
      .target_mask = mask_of(target_mask),
      .overlap = named<CellOverlap>("overlap", overlap),
  };
  Remap found = watched(
      source.num_cells() + target.num_cells(), threads, listener,
      [&](const Execution& execution) { return remap(source, target, options, execution); });
  return {std::move(found.weights), to_array<double>(std::move(found.source_areas)),
          to_array<double>(std::move(found.target_areas)),
          to_array<double>(std::move(found.source_fractions)),
          to_array<double>(std::move(found.target_fractions))};
}

void add_cell_set(nb::module_& module) {
  nb::class_<CellSet>(module, "CellSet")
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
          "lonlat_grid",
          [](const NumbersIn& lon, const NumbersIn& lat, nb::handle sides, unsigned threads) {
            const auto grid_sides = named<GridSides>("sides", sides);
            const LonLatGrid grid{numbers_of(lon), numbers_of(lat)};
            return unlocked(
                [&] { return CellSet::lonlat_grid(grid, grid_sides, {.threads = threads}); });
          },
          nb::arg("lon").noconvert(), nb::arg("lat").noconvert(), nb::arg("sides").none(),
          nb::arg("threads"))
      .def_static(
          "from_rings",
          [](const OffsetsIn& cells, const OffsetsIn& rings, const IndicesIn& corners,
             const PointsIn& points, const IndicesIn& whole, unsigned threads) {
            const CellRings all = rings_of(cells, rings, corners, points, whole);
            return unlocked([&] { return CellSet(all, {.threads = threads}); });
          },
          nb::arg("cells").noconvert(), nb::arg("rings").noconvert(),
          nb::arg("corners").noconvert(), nb::arg("points").noconvert(),
          nb::arg("whole").noconvert(), nb::arg("threads"))
      .def_prop_ro("num_cells", &CellSet::num_cells)
      .def_prop_ro("is_cover", &CellSet::is_cover)
      .def_prop_ro("areas",
                   [](const nb::object& self) {
                     return array_of<double>(self, nb::cast<const CellSet&>(self).areas());
                   })
      .def("centers", [](const CellSet& self) { return points_out(self.centers()); })
      .def("rings",
           [](const CellSet& self) { return rings_out(unlocked([&] { return self.rings(); })); })
      .def("given_rings",
           [](const CellSet& self) {
             return rings_out(unlocked([&] { return self.given_rings(); }));
           })
      .def("weight_corners", [](const CellSet& self) {
        return to_array<double>(unlocked([&] { return weight_corners(self); }));
      });
}

}  // namespace

void add_remap(nb::module_& module) {
  nb::class_<CellColumns>(module, "CellColumns")
      .def(nb::init<>())
      .def_prop_rw("columns", &texts_of_columns, &set_columns);
  add_cell_set(module);
  module.def("read_cell_set", &read_cell_set, nb::arg("path"), nb::arg("sides").none(),
             nb::arg("threads"));
  module.def("corner_cells", &corner_cells, nb::arg("corners").noconvert(), nb::arg("of_each"),
             nb::arg("centers").noconvert(), nb::arg("threads"));
  module.def("corners_of_grid", &corners_of_nodes, nb::arg("nodes").noconvert(),
             nb::arg("node_shape"), nb::arg("centers").noconvert(), nb::arg("shape"));
  module.def("read_polygon_cells", &read_polygon_cells, nb::arg("path"), nb::arg("edges").none(),
             nb::arg("overlap").none(), nb::arg("groups").noconvert().none(), nb::arg("threads"));
  module.def("remap", &remap_of, nb::arg("source"), nb::arg("target"), nb::arg("order"),
             nb::arg("norm").none(), nb::arg("source_mask").noconvert(),
             nb::arg("target_mask").noconvert(), nb::arg("overlap").none(), nb::arg("threads"),
             nb::arg("progress").none());
}

}  // namespace rondel::python
