// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a CellSet knows of its cells beside their borders, and what files of weights get of it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "overlay/cell_set_data.h"
#include "overlay/prepared_grid.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/read_cells.h"
#include "rondel/regrid.h"
#include "rondel/remap.h"
#include "system/checked_product.h"
#include "system/job.h"
#include "system/large_arrays.h"

namespace rondel {
namespace {

// Cells with more corners are written without corners.
constexpr std::size_t max_corners = 16;

// Throws InvalidInput unless there is nothing, or something for each cell.
void require_size(const char* what, std::size_t size, std::size_t num_cells) {
  if (size == 0 || size == num_cells) return;
  throw InvalidInput(std::string(what) + std::to_string(size) + " values for " +
                     std::to_string(num_cells) + " cells");
}

// Returns four corners for each cell of a grid, counterclockwise.
std::vector<LonLat> corners_of_lines(const LonLatGrid& grid) {
  std::vector<double> lon = grid.lon_deg;
  const double least = std::min(lon.front(), lon.back());
  const double most = std::max(lon.front(), lon.back());
  const bool goes_around = std::abs(most - least - 360) <= overlay::same_line_degrees;
  if (goes_around) (lon.front() < lon.back() ? lon.back() : lon.front()) = least + 360;
  std::vector<LonLat> corners;
  corners.reserve(4 * (lon.size() - 1) * (grid.lat_deg.size() - 1));
  for (std::size_t j = 0; j + 1 < grid.lat_deg.size(); ++j) {
    const auto [south, north] = std::minmax(grid.lat_deg[j], grid.lat_deg[j + 1]);
    for (std::size_t i = 0; i + 1 < lon.size(); ++i) {
      const auto [west, east] = std::minmax(lon[i], lon[i + 1]);
      corners.insert(corners.end(), {{west, south}, {east, south}, {east, north}, {west, north}});
    }
  }
  return corners;
}

// Returns the number of corners that each cell gets, or 0 if a cell has several rings or too many
// corners.
std::size_t corners_of_each(const CellRings& cells) {
  std::size_t most = 0;
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    const std::uint64_t ring = cells.cells[i];
    if (cells.cells[i + 1] == ring) continue;
    if (cells.cells[i + 1] != ring + 1) return 0;
    most = std::max<std::size_t>(most, cells.rings[ring + 1] - cells.rings[ring]);
  }
  return most > max_corners ? 0 : most;
}

// Returns the corners of cells that have one ring at most.
std::vector<LonLat> corners_of_rings(const CellRings& cells) {
  const std::size_t most = corners_of_each(cells);
  if (most == 0) return {};
  const std::vector<LonLat> places = lonlats(cells.points);
  std::vector<LonLat> corners;
  system::reserve_large(corners, cells.num_cells() * most);
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    if (cells.cells[i] == cells.cells[i + 1]) {
      corners.insert(corners.end(), most, LonLat{0, 0});
      continue;
    }
    const std::span<const Index> ring = cells.corners_of(cells.cells[i]);
    for (std::size_t k = 0; k < most; ++k) {
      corners.push_back(places[ring[std::min(k, ring.size() - 1)]]);
    }
  }
  return corners;
}

// Makes bounds of corners, the same number for each place: NaN for a cell without ring, and longitudes
// at most 180 degrees from the place's.
void make_bounds(std::span<const LonLat> places, std::vector<LonLat>& corners) {
  const std::size_t of_cell = corners.size() / places.size();
  const auto is_zero = [](const LonLat& corner) { return corner == LonLat{0, 0}; };
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto cell = std::span(corners).subspan(i * of_cell, of_cell);
    if (std::ranges::all_of(cell, is_zero)) std::ranges::fill(cell, LonLat{missing, missing});
    for (LonLat& corner : cell) {
      const double turns = std::round((places[i].lon_deg - corner.lon_deg) / 360);
      if (std::isfinite(turns)) corner.lon_deg += 360 * turns;
    }
  }
}

}  // namespace

std::vector<LonLat> LonLatAxes::places() const {
  std::vector<LonLat> places;
  places.reserve(lon_deg.size() * lat_deg.size());
  for (const double lat : lat_deg) {
    for (const double lon : lon_deg) places.push_back({lon, lat});
  }
  return places;
}

CellSet CellSet::of(CellTable table, GridSides sides, const Execution& execution) {
  const std::string name = table.facts.name;
  try {
    const CellSet cells = table.grid ? lonlat_grid(*table.grid, sides, execution)
                                     : polygons(table.cells, std::move(table.sides), execution);
    return cells.with_facts(std::move(table.facts));
  } catch (const InvalidInput& error) {
    throw FileError(name + ": " + error.what());
  }
}

CellSet CellSet::with_facts(CellFacts facts) const {
  const std::size_t size = num_cells();
  require_size("the centers have ", facts.centers.size(), size);
  require_size("the axes have ", facts.axes.lon_deg.size() * facts.axes.lat_deg.size(), size);
  require_size("the mask has ", facts.mask.size(), size);
  for (const Column& column : facts.columns) {
    require_size("a column has ", column.ends.size(), size);
  }
  std::uint64_t of_shape = facts.shape.empty() ? 0 : 1;
  for (const std::uint64_t length : facts.shape) {
    if (!system::multiply_checked(of_shape, length, of_shape)) of_shape = no_index;
  }
  require_size("the shape has ", of_shape, size);
  return CellSet(data_, std::move(facts));
}

std::vector<LonLat> CellSet::places() const {
  std::vector<LonLat> places = facts_->given_centers();
  return places.empty() ? lonlats(centers()) : places;
}

std::vector<LonLat> CellSet::corners() const {
  const system::ArithmeticScope arithmetic;
  if (!facts_->has_corners) return {};
  return lines() != nullptr ? corners_of_lines(*lines()) : corners_of_rings(rings());
}

std::vector<LonLat> CellSet::bounds() const {
  std::vector<LonLat> bounds = corners();
  if (!bounds.empty()) make_bounds(places(), bounds);
  return bounds;
}

void use_corners_as_bounds(WeightSide& side) {
  if (side.corners.empty() || side.points.empty() || axes_of_grid(side.points, side.shape)) return;
  make_bounds(side.points, side.corners);
  side.has_bounds = true;
}

WeightSide weight_side(const CellSet& cells) {
  const CellFacts& facts = cells.facts();
  WeightSide side;
  side.points = cells.places();
  side.mask = facts.mask;
  side.shape = facts.shape;
  side.corners = cells.corners();
  side.columns = facts.columns;
  side.are_corners_made = facts.are_corners_made;
  return side;
}

std::vector<double> told_areas(const CellSet& cells, std::vector<double> areas) {
  constexpr double rounding = 1e-9;
  const std::vector<double>& defined = overlay::CellSetData::of(cells).defined_areas();
  for (std::size_t i = 0; i < std::min(areas.size(), defined.size()); ++i) {
    if (std::abs(areas[i] - defined[i]) <= rounding * defined[i]) areas[i] = defined[i];
  }
  return areas;
}

WeightFile weight_file(Remap remap) {
  WeightFile file;
  file.source = weight_side(remap.source);
  file.target = weight_side(remap.target);
  file.method = "Conservative remapping";
  if (remap.order == 2) file.method += ", second order";
  file.normalization = name_of(remap.norm);
  file.weights = std::move(remap.weights);
  file.source.areas = told_areas(remap.source, std::move(remap.source_areas));
  file.target.areas = told_areas(remap.target, std::move(remap.target_areas));
  file.source.fractions = std::move(remap.source_fractions);
  file.target.fractions = std::move(remap.target_fractions);
  return file;
}

}  // namespace rondel
