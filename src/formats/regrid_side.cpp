// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_side.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "formats/described_places.h"
#include "formats/field_cells.h"
#include "formats/grid_of_file.h"
#include "formats/netcdf_cells.h"
#include "formats/places_of_points.h"
#include "formats/sites_gdal.h"
#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/netcdf_groups.h"
#include "io/netcdf_reader.h"
#include "overlay/cell_set_data.h"
#include "rondel/error.h"
#include "rondel/regrid.h"

namespace rondel::formats {
namespace {

// Returns the cells of the grid that the first of the variables is on, where the file has several;
// else, as where its dimensions do not say it, those of the file.
CellTable cells_of_variable(const FileName& file, const std::vector<std::string>& names,
                            MissingCorners corners) {
  if (!names.empty() && file_and_variable(file).second.empty()) {
    try {
      FileName grid = file;
      io::FileBytes bytes(file, true);
      grid.path += ":" + io::in_file(bytes.name(), [&] {
                     const io::NetcdfReader reader(bytes);
                     return variable_of(reader, io::full_name(reader.variables(), names.front()));
                   });
      return read_cells(grid, corners);
    } catch (const FileError&) {
      return read_cells(file, corners);  // if it has none, the error is about the whole file
    }
  }
  return read_cells(file, corners);
}

// Throws FileError for a file that has no places: neither netCDF nor points.
void require_places(const FileName& file) {
  if (is_netcdf_file(file) || may_have_points(file)) return;
  std::error_code error;
  if (!std::filesystem::exists(file.path, error)) return;  // which its reader says
  throw FileError(file.path +
                  ": it is neither the name of a grid, nor netCDF with places, nor points (.csv "
                  ".tsv .xyz .txt .npy .geojson, and by GDAL .gpkg .fgb .shp .parquet)");
}

}  // namespace

RegridSide::RegridSide(const FileName& file, const char* what, const CellFileOptions& options,
                       bool has_cells, const Execution& execution,
                       const std::vector<std::string>& names)
    : name_(file.path), what_(what), file_(file), options_(options) {
  require_grid_or_file(file);
  const bool is_name = NamedGrid::is_name(file.path);
  const GridOfFile grid = is_name ? GridOfFile{file.path} : grid_of_file(file, has_cells);
  if (grid.name.empty()) {
    read_without_grid(grid, [&] { read_file(file, has_cells, execution, names); });
    if (what_ == "target") take_descriptions(has_cells);
    return;
  }
  try {
    NamedGrid named(grid.name, options.sides);
    if (!grid.numbers.empty()) {
      take_some(named, grid, has_cells, execution);
      return;
    }
    named_ = std::move(named);
  } catch (const InvalidInput& error) {
    throw FileError((is_name ? "" : file.path + ": ") + error.what());
  }
  shape_ = named_->shape();
  if (named_->axes() != nullptr) axes_ = *named_->axes();
}

void RegridSide::read_file(const FileName& file, bool has_cells, const Execution& execution,
                           std::vector<std::string> names) {
  if (!has_cells) return read_places(file, execution, std::move(names));
  if (!can_read_cells(file)) {
    refuse_points_as_cells(file, execution);
    if (!is_read_by_gdal(file) && !can_read_polygons(file)) {
      throw FileError(file.path +
                      ": it is neither the name of a grid, nor netCDF with cells, nor polygons "
                      "(.geojson, and by GDAL .gpkg .fgb .shp .parquet)");
    }
    cells_ = CellSet::read(file, options_, execution);
  } else {
    CellTable table = cells_of_variable(file, names, options_.corners);
    if (table.grid && options_.sides == GridSides::parallels) {
      lines_ = std::move(table.grid);
      shape_ = table.facts.shape;
      mask_ = table.facts.mask;
      remarks_ = table.facts.remarks;
      axes_ = std::move(table.facts.axes);
      given_lines_ = std::move(table.facts.given_lines);
      return;
    }
    cells_ = cells_by_rules(std::move(table), options_, execution);
    are_corners_made_ = cells_->facts().are_corners_made;
  }
  if (cells_->num_cells() == 0) throw FileError(file.path + ": there are no cells");
  take_facts_of_cells();
}

void RegridSide::read_places(const FileName& file, const Execution& execution,
                             std::vector<std::string> names) {
  const auto [path, variable] = file_and_variable(file);
  require_places(path);
  if (!is_netcdf_file(path)) {
    PlacesOfPoints points = read_places_of_points(file, execution);
    places_ = std::move(points.places);
    shape_ = {places_.size()};
    columns_ = std::move(points.columns);
    remarks_ = std::move(points.remarks);
    has_sites_ = true;
    return;
  }
  if (!variable.empty()) names = {variable};
  NetcdfSites sites = read_netcdf_sites(path, names, false);
  places_ = std::move(sites.table.positions);
  shape_ = std::move(sites.shape);
  mask_ = std::move(sites.mask);
  remarks_ = std::move(sites.remarks);
  axes_ = axes_of_grid(places_, shape_);
}

void RegridSide::take_descriptions(bool has_cells) {
  DescribedPlaces described = described_places(file_, num_places());
  if (!described.remark.empty()) remarks_.push_back(described.remark);
  std::ranges::move(described.columns, std::back_inserter(columns_));
  if (described.are_sites && !has_cells) has_sites_ = true;
}

std::uint64_t RegridSide::bytes_of_columns() const {
  std::uint64_t bytes = 0;
  for (const Column& column : columns_) {
    bytes += column.text.size() + sizeof(std::uint64_t) * column.ends.size();
  }
  return bytes;
}

// Cells without given centers have their centroids, unless they cross themselves.
void RegridSide::take_facts_of_cells() {
  const CellFacts& facts = cells_->facts();
  shape_ = facts.shape;
  mask_ = facts.mask;
  remarks_ = facts.remarks;
  columns_ = facts.columns;
  given_lines_ = facts.given_lines;
  if (!facts.axes.lon_deg.empty()) axes_ = facts.axes;
  try {
    places_ = cells_->places();
  } catch (const InvalidInput& error) {
    throw InvalidInput(facts.name + ": " + what_ + ' ' + error.what(), error.index());
  }
}

void RegridSide::take_some(const NamedGrid& grid, const GridOfFile& some, bool has_cells,
                           const Execution& execution) {
  for (const Index number : some.numbers) places_.push_back(grid.center(number));
  shape_ = some.shape.empty() ? std::vector<std::uint64_t>{some.numbers.size()} : some.shape;
  if (has_cells) cells_ = grid.cells(some.numbers, execution);
}

std::size_t RegridSide::num_places() const {
  if (named_) return named_->num_cells();
  return axes_ ? axes_->lon_deg.size() * axes_->lat_deg.size() : places_.size();
}

std::vector<LonLat> RegridSide::places() const {
  if (named_) return named_->centers();
  return places_.empty() && axes_ ? axes_->places() : places_;
}

LonLat RegridSide::place(std::size_t index) const {
  if (named_) return named_->center(index);
  return places_.empty() && axes_ ? axes_->place(index) : places_[index];
}

const CellSet& RegridSide::cells(const Execution& execution) {
  try {
    make_cells(execution);
  } catch (const InvalidInput& error) {
    throw FileError(name_ + ": " + error.what());
  }
  return *cells_;
}

// The sides of grids may be too wide for great circles.
void RegridSide::make_cells(const Execution& execution) {
  if (!cells_ && named_) cells_ = named_->cells(execution);
  if (!cells_ && lines_) {
    const CellSet grid = CellSet::lonlat_grid(*lines_, options_.sides, execution);
    CellFacts facts = grid.facts();
    facts.name = name_;
    facts.mask = mask_;
    cells_ = grid.with_facts(std::move(facts));
  }
}

bool RegridSide::has_tiles(const Execution& execution) const {
  if (named_ || lines_) return true;
  const overlay::CellSetData& data = overlay::CellSetData::of(*cells_);
  return data.whole() == no_index && !data.has_overlaps(execution);
}

bool RegridSide::is_walked() const {
  if (named_) return has_parallels() || named_->covers_sphere();
  return lines_ || cells_->covers_sphere();
}

bool RegridSide::has_parallels() const {
  return options_.sides == GridSides::parallels && (lines_ || (named_ && axes_));
}

std::size_t RegridSide::num_stored() const {
  const bool is_computed = has_parallels() || (named_ && !axes_);
  return is_computed ? 0 : num_places();
}

double RegridSide::largest_share() const {
  if (num_stored() == 0 || !cells_) return 0;
  const std::vector<double>& areas = overlay::CellSetData::of(*cells_).areas();
  return areas.empty() ? 0 : std::ranges::max(areas) / (4 * std::numbers::pi);
}

const LonLatGrid* RegridSide::lines_between() const {
  if (!has_parallels()) return nullptr;
  return lines_ ? &*lines_ : named_->lines();
}

// These are the areas of the overlay, so that sums are kept. Cells that a formula has are made a part at a
// time, so that they need not be in memory together.
std::vector<double> RegridSide::areas(const Execution& execution) {
  constexpr std::size_t of_part = std::size_t{1} << 18U;
  if (num_stored() > 0 || cells_ || num_places() <= of_part) {
    return overlay::CellSetData::of(cells(execution)).areas();
  }
  std::vector<double> areas;
  areas.reserve(num_places());
  std::vector<Index> numbers;
  for (std::size_t first = 0; first < num_places(); first += numbers.size()) {
    numbers.resize(std::min(of_part, num_places() - first));
    std::iota(numbers.begin(), numbers.end(), static_cast<Index>(first));
    const CellSet part = named_->cells(numbers, execution);
    const std::vector<double>& of_part_of_cells = overlay::CellSetData::of(part).areas();
    areas.insert(areas.end(), of_part_of_cells.begin(), of_part_of_cells.end());
  }
  return areas;
}

TiledCells RegridSide::tiled() const {
  if (named_) return TiledCells(*named_);
  return lines_ ? TiledCells(*lines_) : TiledCells(*cells_);
}

WeightSide RegridSide::description(bool is_netcdf, const Execution& execution) const {
  WeightSide side;
  side.shape = shape_;
  side.columns = columns_;
  if (axes_ && is_netcdf) {
    side.axes = *axes_;
  } else {
    side.points = places();
  }
  if (!is_netcdf || named_) return side;
  if (!lines_ && !cells_) {
    if (!has_sites_) find_bounds(file_, side, execution);
    return side;
  }
  side.lines = given_lines_;
  if (cells_ && cells_->lines() == nullptr) side.corners = cells_->bounds();
  side.has_bounds = !side.corners.empty();
  if (side.has_bounds && axes_) {
    side.axes = {};
    side.points = places();
  }
  return side;
}

void RegridSide::add_mapping(FieldSet& fields) const {
  if (named_) add_grid(*named_, fields);
}

Extrapolator extrapolator_between(const RegridSide& source, const RegridSide& target,
                                  const ExtrapolationOptions& options, const Execution& execution) {
  std::vector<Point> targets = known_unit_vectors(target.places());
  CompressedRows<Index> neighbors;
  if (options.method == Extrapolation::creep) {
    neighbors = target_neighbors(targets, target.shape(), execution);
  }
  return {known_unit_vectors(source.places()),
          std::move(targets),
          std::move(neighbors),
          options,
          source.mask(),
          target.mask()};
}

}  // namespace rondel::formats
