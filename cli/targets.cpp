// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "targets.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/interpolate.h"
#include "rondel/native_weights.h"
#include "rondel/read_cells.h"

namespace rondel::cli {
namespace {

Weights bilinear_from(const NetcdfSites& grid, const Targets& targets) {
  const std::string& name = grid.table.name;
  const std::optional<LonLatAxes> axes = axes_of_grid(grid.table.positions, grid.shape);
  if (!axes) {
    throw FileError(name +
                    ": --method bilinear needs netCDF with a grid along axes of longitude and "
                    "latitude; --method linear takes any sites");
  }
  try {
    Weights weights = bilinear_weights(*axes, targets.side.points, rounding_of(*axes));
    return grid.mask.empty() ? weights : without_columns(weights, grid.mask);
  } catch (const InvalidInput& error) {  // of the axes: all positions are known to be valid
    throw FileError(name + ": " + error.what());
  }
}

Weights given_to_nearest(Job& job, const NetcdfSites& grid, const Targets& targets) {
  const std::size_t num_targets = targets.table.sites.size();
  const std::vector<std::int32_t>& mask = targets.side.mask;
  std::vector<bool> is_taken(num_targets, true);
  std::vector<Index> taken;
  for (std::size_t t = 0; t < num_targets; ++t) {
    is_taken[t] = mask.empty() || mask[t] != 0;
    if (is_taken[t]) taken.push_back(static_cast<Index>(t));
  }
  const SiteTable kept = targets.table.selection(is_taken);
  const Triangulation triangulation = job.triangulate(kept);
  const SiteTable sources = grid.table.selection(grid.unmasked());
  const Weights weights = with_places(sources, [&] {
    return nearest_d2s_weights(Interpolator(triangulation), sources.sites, job.execution());
  });
  return renumbered(weights, taken, num_targets, unmasked_sites(grid), grid.table.sites.size());
}

Weights in_native_cells(const Job& job, const FileName& file, const NetcdfSites& grid,
                        const Targets& targets) {
  if (!is_netcdf_file(file_and_variable(file).first)) {
    throw FileError(grid.table.name + ": --method native needs netCDF with a mesh");
  }
  const NativeCells native = read_native_cells(file, grid.table.positions);
  tell(grid.table.name, native.remarks);
  return with_places(targets.table, [&] {
    return native_weights(native.cells, targets.table.sites, job.execution());
  });
}

// True if two names are the same but for the case of letters.
bool is_same_name(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

// Removes the column of a coordinate: that of the name that was chosen, or that of a usual one.
void drop_column(const std::string& chosen, std::initializer_list<std::string_view> usual,
                 std::vector<Column>& columns) {
  auto found = std::ranges::find(columns, chosen, &Column::name);
  if (found == columns.end()) {
    found = std::ranges::find_if(columns, [&](const Column& column) {
      if (!chosen.empty()) return is_same_name(column.name, chosen);
      return std::ranges::any_of(
          usual, [&](std::string_view name) { return is_same_name(column.name, name); });
    });
  }
  if (found != columns.end()) columns.erase(found);
}

// Returns the columns of a table that are no coordinates, such as names, and the properties of
// features: they stand beside the values.
std::vector<Column> columns_beside(const FileName& target, const ReadOptions& read,
                                   SiteTable& table) {
  std::vector<Column> columns = std::move(table.columns);
  table.columns.clear();
  if (is_geojson(target)) return columns;
  if (table.is_lonlat() || table.sites.empty()) {
    drop_column(read.lon, {"lon", "lng", "long", "longitude"}, columns);
    drop_column(read.lat, {"lat", "latitude"}, columns);
  } else {
    drop_column(read.x, {"x"}, columns);
    drop_column(read.y, {"y"}, columns);
    drop_column(read.z, {"z"}, columns);
  }
  return columns;
}

// Throws FileError for the first target that is where the directions are seen from, and so is no place.
void require_directions_of(const SiteTable& table, const std::vector<LonLat>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!std::isnan(places[i].lon_deg)) continue;
    throw FileError(table.where(i) + ": the point has no direction, so that it is no place");
  }
}

// Reads targets whose longitudes and latitudes are seen from the origin.
Targets read_given_targets(const FileName& target, const ReadOptions& read, const Point& center) {
  Targets targets;
  const std::string& name = target.path;
  if (NamedGrid::is_name(name)) {
    const NamedGrid grid = grid_of(name);
    targets.side.points = grid.centers();
    if (grid.shape().size() > 1) targets.side.shape = grid.shape();
    targets.table.name = name;
    targets.table.first_line = 0;
    targets.table.sites = unit_vectors(targets.side.points);
    if (center != Point{}) targets.table.positions = targets.side.points;
    return targets;
  }
  require_grid_or_file(target);
  if (const auto [file, variable] = file_and_variable(target); is_netcdf_file(file)) {
    std::vector<std::string> names;
    if (!variable.empty()) names.push_back(variable);
    NetcdfSites sites = read_netcdf_sites(file, names, false);
    tell(file.path, sites.remarks);
    tell_of_columns(file.path, read);
    targets.table = std::move(sites.table);
    targets.side.points = targets.table.positions;
    targets.side.mask = std::move(sites.mask);
    if (sites.shape.size() > 1) targets.side.shape = std::move(sites.shape);
    return targets;
  }
  ReadOptions options = read;
  options.radius.clear();
  options.keep_columns = true;
  targets.table = read_sites(target, options);
  targets.side.columns = columns_beside(target, options, targets.table);
  const SiteTable& table = targets.table;
  if (table.num_unlocated > 0) {
    tell(table.name,
         {"left out " + count(table.num_unlocated, "target", "targets") + " without a place"});
  }
  targets.side.points = lonlats_of(table, center);
  require_directions_of(table, targets.side.points);
  return targets;
}

}  // namespace

NamedGrid grid_of(const std::string& name, GridSides sides) {
  try {
    return NamedGrid(name, sides);
  } catch (const InvalidInput& error) {
    throw UsageError(error.what());
  }
}

Targets read_targets(const FileName& target, const ReadOptions& read, const Point& center) {
  Targets targets = read_given_targets(target, read, center);
  move_to(center, targets.table);
  return targets;
}

std::vector<Index> unmasked_sites(const NetcdfSites& grid) {
  const std::vector<bool> is_kept = grid.unmasked();
  std::vector<Index> numbers;
  for (std::size_t i = 0; i < is_kept.size(); ++i) {
    if (is_kept[i]) numbers.push_back(static_cast<Index>(i));
  }
  return numbers;
}

Weights regrid_weights(Job& job, RegridMethod method, const FileName& file, const NetcdfSites& grid,
                       const Targets& targets) {
  Weights weights;
  job.time(Stage::query, [&] {
    if (method == RegridMethod::bilinear) weights = bilinear_from(grid, targets);
    if (method == RegridMethod::nearest_d2s) weights = given_to_nearest(job, grid, targets);
    if (method == RegridMethod::native) weights = in_native_cells(job, file, grid, targets);
  });
  if (!targets.side.mask.empty()) weights = with_rows(weights, targets.side.mask);
  weights.sites_hash = point_set_hash(grid.table.sites);
  weights.targets_hash = point_set_hash(targets.table.sites);
  return weights;
}

Extrapolator extrapolator_to(const Targets& targets, const NetcdfSites& grid, const Point& center,
                             const ExtrapolationOptions& options, const Execution& execution) {
  const std::vector<LonLat> places = lonlats_of(grid.table, center);
  std::vector<Point> points = known_unit_vectors(targets.side.points);
  CompressedRows<Index> neighbors;
  if (options.method == Extrapolation::creep) {
    neighbors = target_neighbors(points, targets.side.shape, execution);
  }
  return {known_unit_vectors(places), std::move(points), std::move(neighbors), options, grid.mask,
          targets.side.mask};
}

}  // namespace rondel::cli
