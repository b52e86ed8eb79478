// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the cells of grids and meshes: read_cells(), CellSet::read() and cells_of_corners().
//
// The readers of the conventions (netcdf_cells.h) are asked in turn, and the first one that
// recognizes the file gives nodes and rings. Then nodes in one place become one corner, rings
// become counterclockwise, and centers are compared with the cells that they belong to.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "exact/vector.h"
#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/grid_of_file.h"
#include "formats/netcdf_cells.h"
#include "formats/own_centers.h"
#include "formats/sites_gdal.h"
#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/netcdf_groups.h"
#include "io/number.h"
#include "map/ring_area.h"
#include "overlay/same_nodes.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/named_grids.h"
#include "rondel/read_cells.h"
#include "system/distinct.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel {
namespace {

// Nodes in double precision that are nearer to each other than this (radians) are one corner.
constexpr double same_place = 1e-10;
// The distance for nodes in single precision.
constexpr double same_single_place = 1e-6;

// Makes rings with the inside to the left, without repeated corners. Nodes within a distance are
// one corner.
class RingsOfNodes {
 public:
  // Precondition: all nodes are places. `distance` is in radians.
  RingsOfNodes(std::span<const LonLat> nodes, double distance) {
    system::Distinct<LonLat> places = system::distinct<LonLat>(nodes);
    made_.points = unit_vectors(places.values);
    const std::vector<Index> same = overlay::same_nodes(made_.points, distance);
    for (Index& number : places.numbers) number = same[number];
    corner_of_ = std::move(places.numbers);
  }

  // Reserves room for as many cells, rings and corners.
  void reserve(std::size_t num_cells, std::size_t num_rings, std::size_t num_corners) {
    made_.cells.reserve(num_cells + 1);
    made_.rings.reserve(num_rings + 1);
    made_.corners.reserve(num_corners);
  }

  // Adds a corner to the ring, unless it equals the corner before.
  void add_corner(Index node) {
    const Index corner = corner_of_[node];
    if (ring_.empty() || corner != ring_.back()) ring_.push_back(corner);
  }
  // Ends a ring. A ring with fewer than three different corners is dropped.
  void end_ring() {
    while (ring_.size() > 1 && ring_.back() == ring_.front()) ring_.pop_back();
    if (ring_.size() >= 3) {
      points_.clear();
      for (const Index corner : ring_) points_.push_back(made_.points[corner]);
      if (map::is_clockwise(points_)) std::ranges::reverse(ring_);
      made_.append_ring(ring_);
    }
    ring_.clear();
  }
  // Ends a cell, which has the rings that were ended since the last call; it may have none.
  void end_cell() { made_.end_cell(); }
  // Returns the cells. This object is empty afterwards.
  CellRings take() && { return std::move(made_); }

 private:
  CellRings made_;
  std::vector<Index> corner_of_;  // the point of each node
  std::vector<Index> ring_;
  std::vector<Point> points_;
};

// Makes cells of a mesh, and adds remarks about cells that are empty.
CellRings cells_of(formats::MeshContent& mesh) {
  formats::leave_out_cells_without_corners(mesh);
  RingsOfNodes maker(mesh.nodes, mesh.is_single ? same_single_place : same_place);
  const CellRings& given = mesh.cells;
  maker.reserve(given.num_cells(), given.rings.size() - 1, given.corners.size());
  for (std::size_t i = 0; i < given.num_cells(); ++i) {
    for (std::uint64_t r = given.cells[i]; r < given.cells[i + 1]; ++r) {
      for (const Index node : given.corners_of(r)) maker.add_corner(node);
      maker.end_ring();
    }
    maker.end_cell();
  }
  CellRings cells = std::move(maker).take();
  // A masked cell may have no corners, so it is not counted.
  std::size_t num_empty = 0;
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    const bool is_masked = !mesh.mask.empty() && mesh.mask[i] == 0;
    if (cells.cells[i] == cells.cells[i + 1] && !is_masked) ++num_empty;
  }
  if (num_empty > 0) {
    mesh.remarks.push_back(std::to_string(num_empty) + " of " + std::to_string(cells.num_cells()) +
                           " cells have fewer than three different corners and are empty");
  }
  return cells;
}

// Returns the middle of the corners of a cell; (0, 0) for a cell without corners.
LonLat middle_of_corners(const CellRings& cells, std::size_t cell) {
  Point sum{0, 0, 0};
  const std::uint64_t end = cells.rings[cells.cells[cell + 1]];
  for (std::uint64_t k = cells.rings[cells.cells[cell]]; k < end; ++k) {
    sum = sum + cells.points[cells.corners[k]];
  }
  if (!(dot(sum, sum) > 0)) return {0, 0};
  const Point middle = normalized(sum);
  return lonlats({&middle, 1}).front();
}

// Completes the centers: missing ones of masked cells become (0, 0), and those of others, as ocean models have
// none on land, the middle of the corners. A mesh without any center gets none.
void require_centers(const CellRings& cells, formats::MeshContent& mesh) {
  if (std::ranges::all_of(mesh.centers, formats::is_missing_place)) mesh.centers.clear();
  for (std::size_t i = 0; i < mesh.centers.size(); ++i) {
    const bool is_masked = !mesh.mask.empty() && mesh.mask[i] == 0;
    LonLat& center = mesh.centers[i];
    if (is_masked) {
      const bool is_place = std::isfinite(center.lon_deg) && std::abs(center.lat_deg) <= 90;
      if (!is_place) center = {0, 0};
    } else if (formats::is_missing_place(center)) {
      center = middle_of_corners(cells, i);
      ++mesh.num_made_centers;
    } else {
      center = formats::require_position("the centers of cells", i, center);
    }
  }
}

// Compares the centers of CF with the cells, where files have zeros under land. If more than half
// of the cells do not contain their center, the corners are those of other places: throws BadValue.
// For other conventions require_own_centers() does this.
void require_centers_in_cells(const formats::MeshContent& mesh, CellTable& table) {
  CellFacts& facts = table.facts;
  if (facts.convention != "CF" || table.grid || facts.centers.empty()) return;
  const CentersOutside outside = centers_outside(table.cells, facts.centers, facts.mask);
  if (outside.number == 0) return;
  const LonLat& center = facts.centers[outside.first];
  const std::string text = std::to_string(outside.number) + " of " + std::to_string(outside.of) +
                           " cells with the corners " + mesh.names +
                           " do not contain their centers, the first one cell " +
                           std::to_string(outside.first) + " with the center " +
                           system::shortest_text(center.lon_deg) + " " +
                           system::shortest_text(center.lat_deg);
  if (outside.are_most()) {
    throw io::BadValue(text + ": corners and centers are of different places or orders");
  }
  facts.remarks.push_back(text);
}

}  // namespace

CellRings cells_of_corners(std::span<const LonLat> corners, std::size_t corners_per_cell) {
  const system::ArithmeticScope arithmetic;
  if (corners_per_cell == 0 || corners.size() % corners_per_cell != 0) {
    throw InvalidInput(std::to_string(corners.size()) + " corners are no multiple of " +
                           std::to_string(corners_per_cell) + " each",
                       corners.size());
  }
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto [lon, lat] = corners[k];
    if (std::isfinite(lon) && std::abs(lat) <= 90) continue;
    throw InvalidInput("cell " + std::to_string(k / corners_per_cell) +
                           " has a corner at longitude " + system::shortest_text(lon) +
                           " and latitude " + system::shortest_text(lat) + ", which is no place",
                       k / corners_per_cell);
  }
  // Each cell is one ring; corners that it repeats to fill up its row are dropped.
  RingsOfNodes maker(corners, same_place);
  maker.reserve(corners.size() / corners_per_cell, corners.size() / corners_per_cell,
                corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    maker.add_corner(static_cast<Index>(k));
    if ((k + 1) % corners_per_cell == 0) {
      maker.end_ring();
      maker.end_cell();
    }
  }
  return std::move(maker).take();
}

void require_grid_or_file(const FileName& side) {
  const std::string& path = side.path;
  if (side.bytes != nullptr || path.empty() || path == "-" || NamedGrid::is_name(path)) return;
  const std::string_view before_colon = std::string_view(path).substr(0, path.find(':'));
  std::error_code error;
  if (before_colon.find_first_of("./\\") != std::string_view::npos ||
      std::filesystem::exists(path, error) || std::filesystem::exists(before_colon, error)) {
    return;
  }
  throw FileError(path + " is neither a file nor a grid: grids are " +
                  std::string(NamedGrid::forms()) + ", with any numbers");
}

bool can_read_cells(const FileName& file) { return is_netcdf_file(file_and_variable(file).first); }

// A file may have the ending of GeoJSON and be netCDF all the same; its first bytes decide.
bool can_read_polygons(const FileName& file) {
  if (io::is_geojson(file)) return !can_read_cells(file);
  return formats::is_read_by_gdal(file) && !formats::is_read_once(file) &&
         formats::begins_with_polygon(file);
}

formats::MeshContent formats::read_by_convention(const io::NetcdfReader& file,
                                                 const std::string& name, MissingCorners corners) {
  // The name of a grid of OASIS, such as torc, is that of no variable.
  const bool is_oasis = file.find(name + ".clo") != nullptr;
  if (!name.empty() && !is_oasis) (void)file.require(name);
  const std::optional<io::NetcdfReader> once = without_times_of_mesh(file);
  for (const auto read : {&read_ugrid, &read_scrip_grid, &read_esmf_mesh, &read_mpas_cells,
                          &read_icon, &read_oasis, &read_exodus}) {
    if (std::optional<MeshContent> mesh = read(once ? *once : file, name)) return std::move(*mesh);
  }
  // CF comes last, since files of the other conventions may have longitudes and latitudes, too.
  if (std::optional<MeshContent> mesh = read_cf_grid(file, name, corners)) return std::move(*mesh);
  if (!name.empty()) {
    throw io::BadValue("it has no cells that variable " + io::in_quotes(name) + " is on");
  }
  const std::string text =
      "it has no cells: it follows none of UGRID, SCRIP, ESMF, MPAS, ICON, OASIS and Exodus, and "
      "has no longitudes and latitudes of CF";
  throw io::BadValue(text + remark_on_units(headers_of(file)));
}

CellTable formats::cells_in(const io::NetcdfReader& file, const std::string& file_name,
                            const std::string& part, MissingCorners corners) {
  MeshContent mesh = read_by_convention(file, io::full_name(file.variables(), part), corners);
  // A grid of meridians and parallels has lines in place of rings.
  CellTable table;
  if (!mesh.grid) table.cells = cells_of(mesh);
  require_centers(table.cells, mesh);
  // CF has no `center_names`: its centers are compared at the end, by a weaker rule.
  if (!mesh.center_names.empty() && !mesh.centers.empty()) {
    std::string remark = require_own_centers(mesh, table.cells);
    if (!remark.empty()) mesh.remarks.push_back(std::move(remark));
  }
  table.grid = std::move(mesh.grid);
  table.facts = std::move(static_cast<CellFacts&>(mesh));
  table.facts.name = file_name;
  require_centers_in_cells(mesh, table);
  return table;
}

CellSet formats::cells_by_rules(CellTable table, const CellFileOptions& options,
                                const Execution& execution) {
  CellSet cells = CellSet::of(std::move(table), options.sides, execution);
  if (options.invalid == InvalidPolygons::error) return cells;
  try {
    return cells.repaired(execution);
  } catch (const InvalidInput& error) {
    throw FileError(cells.facts().name + ": " + error.what());
  }
}

CellTable read_cells(const FileName& file, MissingCorners corners) {
  const system::ArithmeticScope arithmetic;
  const std::pair<FileName, std::string> part = file_and_variable(file);
  io::FileBytes bytes(part.first, true);
  if (!io::is_netcdf(bytes.head()) && !io::has_netcdf_ending(part.first)) {
    io::throw_unknown_ending(part.first,
                             "cells of models are read from netCDF:", io::netcdf_endings);
  }
  return io::in_file(bytes.name(), [&] {
    return formats::cells_in(io::NetcdfReader(bytes), bytes.name(), part.second, corners);
  });
}

CellSet CellSet::read(const FileName& file, const CellFileOptions& options,
                      const Execution& execution) {
  const PolygonOptions rules{.edges = options.edges,
                             .invalid = options.invalid,
                             .overlap = options.overlap,
                             .is_taken = options.is_taken};
  // Files of GDAL without polygons are refused by what they have.
  if (formats::is_read_by_gdal(file) || can_read_polygons(file))
    return of(read_polygons(file, rules, execution), options.sides, execution);
  const formats::GridOfFile grid = formats::grid_of_file(file, true);
  if (!grid.name.empty()) {
    try {
      const NamedGrid named(grid.name, options.sides);
      if (grid.numbers.empty()) return named.cells(execution);
      const CellSet some = named.cells(grid.numbers, execution);
      CellFacts facts = some.facts();
      if (!grid.shape.empty()) facts.shape = grid.shape;
      return some.with_facts(std::move(facts));
    } catch (const InvalidInput& error) {
      throw FileError(file.path + ": " + error.what());
    }
  }
  return formats::cells_by_rules(
      formats::read_without_grid(grid, [&] { return read_cells(file, options.corners); }), options,
      execution);
}

}  // namespace rondel
