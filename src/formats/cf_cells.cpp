// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads grids of the Climate and Forecast conventions (CF 1.11, sections 4.1, 4.2, 5.2, 7.1).
// rondel/conventions.h decides which variables are coordinates and bounds; this file makes cells of
// them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "formats/cf_bounds.h"
#include "formats/cf_lines.h"
#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/netcdf_cells.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "rondel/conventions.h"
#include "rondel/error.h"
#include "rondel/read_cells.h"
#include "system/arithmetic.h"
#include "system/large_arrays.h"
#include "system/message_text.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using io::NetcdfReader;

constexpr std::size_t no_variable = CoordinatePair::none;

// True for two rows and two columns or more, between whose centers corners can be made.
bool is_grid_of_rows(std::span<const std::uint64_t> shape) {
  return shape.size() == 2 && shape[0] > 1 && shape[1] > 1;
}

// Finds the coordinates of the grid that is to be read. `remarks` gets what is noteworthy.
class CfGrids {
 public:
  // Finds all pairs of coordinates of the file, or those that `name` means. Throws BadValue if the
  // variable `name` has no coordinates.
  CfGrids(const NetcdfReader& file, const std::string& name, MissingCorners corners,
          std::vector<std::string>& remarks)
      : file_(file), headers_(headers_of(file)), corners_(corners), remarks_(remarks) {
    if (name.empty()) {
      pairs_ = find_coordinates(headers_, {}, &remarks);
      return;
    }
    // `name` may be that of a coordinate, or of a variable that has coordinates.
    for (const CoordinatePair& pair : find_coordinates(headers_, {}, &remarks)) {
      if (headers_[pair.lon].name == name || headers_[pair.lat].name == name)
        pairs_.push_back(pair);
    }
    if (pairs_.empty()) pairs_ = find_coordinates(headers_, {{}, {}, name}, &remarks);
    if (pairs_.empty()) {
      throw BadValue("variable " + io::in_quotes(name) + " has no longitudes and latitudes");
    }
  }

  // Returns the first pair of coordinates that has cells, preferring pairs along which variables
  // lie, or null if the file has no pair. Throws BadValue if no pair has cells.
  const CoordinatePair* best() {
    if (pairs_.empty()) return nullptr;
    // If some pairs have variables along them, a pair without any is no grid.
    const bool has_used = std::ranges::any_of(pairs_, &CoordinatePair::is_used);
    const auto found = std::ranges::find_if(pairs_, [&](const CoordinatePair& pair) {
      return has_cells(pair) && (pair.is_used || !has_used);
    });
    if (found == pairs_.end()) {
      const bool may_be_made = std::ranges::any_of(
          pairs_, [&](const CoordinatePair& pair) { return may_have_made_corners(pair); });
      throw BadValue(
          std::string("its longitudes and latitudes have no bounds, so no cells") +
          (may_be_made ? "; --corners made (corners='made' in Python) makes them from the centers"
                       : "; if they are the points of a grid with a name, such as healpix:7 or "
                         "O320, the name has its cells: give it in place of the file or, for the "
                         "fields of rondel regrid, by --source"));
    }
    if (found != pairs_.begin()) require_same_places(pairs_.front(), *found);
    tell_of_others(*found);
    return &*found;
  }

  // True if both coordinates of a pair have bounds.
  [[nodiscard]] static bool has_bounds(const CoordinatePair& pair) {
    return pair.lon_bounds != no_variable && pair.lat_bounds != no_variable;
  }

  // Returns the variable of the file that has this number in CoordinatePair.
  [[nodiscard]] const io::VariableInFile& variable(std::size_t index) const {
    return file_.variables()[index];
  }

 private:
  // True if cells_around_centers() takes the places of the pair.
  [[nodiscard]] bool may_have_made_corners(const CoordinatePair& pair) const {
    try {
      return is_grid_of_rows(places_of(file_, variable(pair.lon), variable(pair.lat)).shape);
    } catch (const BadValue&) {
      return false;  // coordinates that are no places
    }
  }
  // True if cells can be made: the coordinates are axes, or both have bounds, or these are made.
  [[nodiscard]] bool has_cells(const CoordinatePair& pair) const {
    return pair.are_axes || has_bounds(pair) ||
           (corners_ == MissingCorners::made && headers_[pair.lon].dimensions.size() > 1);
  }

  // True if all names of `some` are among `all`.
  static bool are_among(const std::vector<std::string>& some, const std::vector<std::string>& all) {
    return std::ranges::all_of(
        some, [&](const std::string& name) { return std::ranges::count(all, name) != 0; });
  }

  // Returns the names of the dimensions of both coordinates, each once.
  [[nodiscard]] std::vector<std::string> dimensions_of(const CoordinatePair& pair) const {
    std::vector<std::string> names = headers_[pair.lat].dimensions;
    for (const std::string& name : headers_[pair.lon].dimensions) {
      if (std::ranges::count(names, name) == 0) names.push_back(name);
    }
    return names;
  }

  // Throws BadValue if axes are used instead of `first`, which has no cells, but are other places:
  // along the same dimensions there may be axes of the same places, or variables that only seem to
  // be degrees.
  void require_same_places(const CoordinatePair& first, const CoordinatePair& axes) const {
    const std::vector<std::string> own = dimensions_of(first);
    if (!axes.are_axes || !are_among(dimensions_of(axes), own) || first.are_axes) return;
    const PlaceArrays places = places_of(file_, variable(first.lon), variable(first.lat));
    const io::VariableInFile* const pair[] = {&variable(axes.lon), &variable(axes.lat)};
    const std::vector<double> lon =
        degrees_of(file_, *pair[0], UsualUnits::of_name, {nullptr, pair[1]});
    const std::vector<double> lat =
        degrees_of(file_, *pair[1], UsualUnits::of_name, {nullptr, pair[0]});
    // The places may be stored as (lat, lon) or as (lon, lat).
    const bool is_lon_last = places.dimensions.back() == variable(axes.lon).dimensions[0];
    constexpr double max_apart = 1e-3;  // degrees
    for (std::size_t i = 0; i < places.lon.size(); ++i) {
      const std::size_t along = is_lon_last ? i % lon.size() : i / lat.size();
      const std::size_t across = is_lon_last ? i / lon.size() : i % lat.size();
      if (places.lon.size() == lon.size() * lat.size() &&
          std::abs(std::remainder(places.lon[i] - lon[along], 360)) <= max_apart &&
          std::abs(places.lat[i] - lat[across]) <= max_apart) {
        continue;
      }
      throw BadValue("its longitudes " + io::in_quotes(headers_[first.lon].name) +
                     " and latitudes " + io::in_quotes(headers_[first.lat].name) +
                     " have no bounds, so no cells, and the axes " +
                     io::in_quotes(headers_[axes.lon].name) + " and " +
                     io::in_quotes(headers_[axes.lat].name) + " are other places");
    }
  }

  // Adds a remark that names the grids that are not read.
  void tell_of_others(const CoordinatePair& taken) {
    std::vector<std::string> names;
    for (const CoordinatePair& pair : pairs_) {
      const bool is_other = pair.lon != taken.lon || pair.lat != taken.lat;
      if (!is_other || !has_cells(pair) || !pair.is_used) continue;
      // Coordinates along the same dimensions describe the same cells, so they are no other grid.
      if (are_among(dimensions_of(pair), dimensions_of(taken))) continue;
      names.push_back(headers_[pair.lon].name + " and " + headers_[pair.lat].name);
    }
    if (names.empty()) return;
    remarks_.push_back("the file has several grids; that of " + headers_[taken.lon].name + " and " +
                       headers_[taken.lat].name + " is read, not that of " +
                       text_of_others(std::move(names)) + "; FILE.nc:NAME names one by a variable");
  }

  const NetcdfReader& file_;
  std::vector<VariableHeader> headers_;
  MissingCorners corners_;
  std::vector<std::string>& remarks_;
  std::vector<CoordinatePair> pairs_;
};

// Returns the bounds of an axis in degrees, two for each cell or one more than cells, or none if it
// has no bounds (`bounds` is null). `other` is the other axis, whose units count if the axis has
// none. Throws BadValue for any other number of bounds, and for bounds that change along a further
// dimension.
std::vector<double> bounds_of_axis(const NetcdfReader& file, const io::VariableInFile& axis,
                                   const io::VariableInFile& other,
                                   const io::VariableInFile* bounds) {
  if (bounds == nullptr) return {};
  const PlaceArrays along{axis.dimensions, axis.shape, {}, {}, {}};
  auto [found, values] = read_bounds(file, *bounds, along, {&axis, &other});
  const bool are_lines = found.num_values == axis.num_values + 1;
  if (found.num_values != 2 * axis.num_values && !are_lines) {
    throw BadValue("variable " + io::in_quotes(bounds->name) + " has " +
                   std::to_string(found.num_values) + " values instead of " +
                   std::to_string(2 * axis.num_values));
  }
  // Some files have the bounds as (2, n) in place of (n, 2), the shape of CF section 7.1.
  if (found.dimensions.size() == 2 && found.dimensions[1] == axis.dimensions[0] &&
      found.dimensions[0] != axis.dimensions[0]) {
    values = in_order(found, {found.dimensions[1], found.dimensions[0]}, std::move(values));
  }
  return values;
}

// Returns the lines between cells along an axis in degrees, one more than cells. `bounds` may be
// null. Throws BadValue, with the name of the variable, if coordinates or bounds are out of order.
std::vector<double> lines_of(const NetcdfReader& file, const io::VariableInFile& axis,
                             const io::VariableInFile& other, const io::VariableInFile* bounds,
                             bool is_longitude) {
  const std::vector<double> values = degrees_of(file, axis, UsualUnits::of_name, {bounds, &other});
  const auto refuse = [](const io::VariableInFile& variable, const InvalidInput& error) {
    throw BadValue("variable " + io::in_quotes(variable.name) + ": " + error.what());
  };
  try {
    require_order(values, is_longitude, is_longitude ? "longitude" : "latitude");
  } catch (const InvalidInput& error) {
    refuse(axis, error);
  }
  try {
    return axis_lines(values, bounds_of_axis(file, axis, other, bounds), is_longitude);
  } catch (const InvalidInput& error) {
    refuse(bounds == nullptr ? axis : *bounds, error);
  }
  return {};
}

// Adds a remark if coordinates are outside of their own cells, as with the bounds of others.
void tell_of_outside(const io::VariableInFile& axis, const io::VariableInFile* bounds,
                     std::span<const double> values, std::span<const double> lines,
                     std::vector<std::string>& remarks) {
  if (bounds == nullptr) return;
  constexpr double rounding = 1e-4;  // degrees, of single precision
  std::size_t first = values.size();
  std::size_t number = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double middle = (lines[i] + lines[i + 1]) / 2;
    const double half = std::abs(lines[i + 1] - lines[i]) / 2;
    if (std::abs(std::remainder(values[i] - middle, 360)) <= half + rounding) continue;
    first = std::min(first, i);
    ++number;
  }
  if (number == 0) return;
  remarks.push_back(
      std::to_string(number) + " of " + std::to_string(values.size()) + " coordinates of " +
      io::in_quotes(axis.name) + " are outside of their cells in " + io::in_quotes(bounds->name) +
      ", the first one " + system::shortest_text(values[first]) + " beside " +
      system::shortest_text(lines[first]) + " to " + system::shortest_text(lines[first + 1]));
}

// Returns the lengths of the last two dimensions.
GridShape last_two_of(std::span<const std::uint64_t> lengths) {
  return {lengths[lengths.size() - 2], lengths[lengths.size() - 1]};
}

// True if bounds are the nodes of a grid, (ny + 1, nx + 1), in either order.
bool is_of_nodes(const io::VariableInFile& bounds, const PlaceArrays& places) {
  const std::size_t rank = places.shape.size();
  if (rank < 2 || bounds.shape.size() != rank ||
      !std::equal(bounds.shape.begin(), bounds.shape.end() - 2, places.shape.begin())) {
    return false;
  }
  const auto [rows, columns] = last_two_of(bounds.shape);
  const auto [ny, nx] = last_two_of(places.shape);
  return (rows == ny + 1 && columns == nx + 1) || (rows == nx + 1 && columns == ny + 1);
}

// Puts the corners of all cells in order, cell by cell, and returns their number for each cell. The
// bounds have one more dimension than the coordinate, or they are the nodes of a grid: then these
// stay, and 0 is returned. Throws BadValue if the bounds have neither form.
std::size_t order_corners(BoundsArray& bounds, const PlaceArrays& places) {
  const io::VariableInFile& variable = bounds.variable;
  const std::size_t num_cells = places.lon.size();
  const auto is_of_bounds = [&](std::size_t dimension) {
    return std::ranges::count(variable.dimensions, dimension) == 1;
  };
  if (std::ranges::all_of(places.dimensions, is_of_bounds)) {
    // The dimensions of the places come first, then the corners.
    std::vector<std::size_t> order = places.dimensions;
    std::size_t corners_per_cell = 1;
    for (std::size_t d = 0; d < variable.dimensions.size(); ++d) {
      if (std::ranges::count(order, variable.dimensions[d]) != 0) continue;
      order.push_back(variable.dimensions[d]);
      corners_per_cell *= variable.shape[d];
    }
    if (std::ranges::is_permutation(order, variable.dimensions)) {
      bounds.values = in_order(variable, order, std::move(bounds.values));
      return corners_per_cell;
    }
  }
  if (is_of_nodes(variable, places)) return 0;
  // Bounds may have dimensions of other names; then the corners are taken for the last one.
  if (num_cells == 0 || bounds.values.size() % num_cells != 0) {
    throw BadValue("variable " + io::in_quotes(variable.name) + " has " +
                   std::to_string(variable.num_values) + " values for " +
                   std::to_string(num_cells) + " cells");
  }
  return bounds.values.size() / num_cells;
}

// Makes the cells of coordinates with bounds. Each cell has nodes of its own, which RingsOfNodes
// (cell_files.cpp) joins to corners. Throws BadValue if the bounds of longitudes and latitudes do
// not have the same number of corners.
MeshContent cells_with_corners(const NetcdfReader& file, const CfGrids& grids,
                               const CoordinatePair& pair) {
  MeshContent mesh;
  const io::VariableInFile& lon = grids.variable(pair.lon);
  const io::VariableInFile& lat = grids.variable(pair.lat);
  const PlaceArrays places = places_of(file, lon, lat);
  BoundsArray lons = read_bounds(file, grids.variable(pair.lon_bounds), places, {&lon, &lat});
  BoundsArray lats = read_bounds(file, grids.variable(pair.lat_bounds), places, {&lat, &lon});
  const io::VariableInFile& lon_bounds = lons.variable;
  const io::VariableInFile& lat_bounds = lats.variable;
  std::size_t corners_per_cell = order_corners(lons, places);
  const std::size_t of_each_lat = order_corners(lats, places);
  // The nodes of a grid may be stored as (ny, nx) for one coordinate and (nx, ny) for the other.
  if (of_each_lat == 0 &&
      std::ranges::is_permutation(lon_bounds.dimensions, lat_bounds.dimensions)) {
    lats.values = in_order(lat_bounds, lon_bounds.dimensions, std::move(lats.values));
  }
  const std::size_t num_nodes = lons.values.size();
  if (corners_per_cell != of_each_lat || num_nodes != lats.values.size() || num_nodes >= no_index) {
    throw BadValue("variables " + io::in_quotes(lon_bounds.name) + " and " +
                   io::in_quotes(lat_bounds.name) + " have not as many corners");
  }
  system::reserve_large(mesh.nodes, num_nodes);
  for (std::size_t i = 0; i < num_nodes; ++i) {
    mesh.nodes.push_back({lons.values[i], lats.values[i]});
  }
  mesh.names = io::in_quotes(lon_bounds.name) + " and " + io::in_quotes(lat_bounds.name);
  mesh.is_single = lon_bounds.type == io::NetcdfType::float32;
  system::reserve_large(mesh.centers, places.lon.size());
  for (std::size_t i = 0; i < places.lon.size(); ++i) {
    mesh.centers.push_back({places.lon[i], places.lat[i]});
  }
  if (corners_per_cell == 0) {
    corners_per_cell = 4;
    mesh.nodes = corners_of_grid(mesh.nodes, last_two_of(lon_bounds.shape), mesh.centers,
                                 last_two_of(places.shape));
  }
  end_cells_of_nodes(corners_per_cell, !has_rows(places.shape), mesh);
  if (places.shape.size() > 1) mesh.shape = places.shape;
  return mesh;
}

// Makes the cells of coordinates without bounds, with corners between the centers. Throws BadValue
// if the places are no grid of two dimensions.
MeshContent cells_around_centers(const NetcdfReader& file, const CfGrids& grids,
                                 const CoordinatePair& pair) {
  MeshContent mesh;
  const io::VariableInFile& lon = grids.variable(pair.lon);
  const io::VariableInFile& lat = grids.variable(pair.lat);
  const PlaceArrays places = places_of(file, lon, lat);
  const std::string names = io::in_quotes(lon.name) + " and " + io::in_quotes(lat.name);
  if (!is_grid_of_rows(places.shape) || 4 * places.lon.size() >= no_index) {
    throw BadValue(
        "corners of cells are made of grids with two rows and two columns or more, not of " +
        names);
  }
  for (std::size_t i = 0; i < places.lon.size(); ++i) {
    const LonLat center{places.lon[i], places.lat[i]};
    mesh.centers.push_back(is_missing_place(center) ? center : require_position(names, i, center));
  }
  const GridShape shape = last_two_of(places.shape);
  const std::vector<LonLat> nodes = nodes_between(mesh.centers, shape);
  mesh.nodes = corners_of_grid(nodes, {shape.rows + 1, shape.columns + 1}, mesh.centers, shape);
  // A place without longitude or latitude has no cell, though its neighbors give it corners.
  for (std::size_t i = 0; i < mesh.centers.size(); ++i) {
    if (!is_missing_place(mesh.centers[i])) continue;
    constexpr double missing = std::numeric_limits<double>::quiet_NaN();
    std::fill_n(mesh.nodes.begin() + static_cast<std::ptrdiff_t>(4 * i), 4,
                LonLat{missing, missing});
  }
  mesh.names = "made between " + names;
  mesh.are_corners_made = true;
  end_cells_of_nodes(4, false, mesh);
  mesh.shape = places.shape;
  mesh.remarks.push_back(names +
                         " have no bounds; the corners of cells are made half way between "
                         "the centers");
  return mesh;
}

// Makes the cells of axes: a grid between meridians and parallels, with its centers row by row from
// the first latitude on. Throws BadValue for a coordinate that is no place.
MeshContent cells_along_axes(const NetcdfReader& file, const CfGrids& grids,
                             const CoordinatePair& pair) {
  MeshContent mesh;
  const io::VariableInFile& lon = grids.variable(pair.lon);
  const io::VariableInFile& lat = grids.variable(pair.lat);
  const auto bounds = [&](std::size_t index) {
    return index == no_variable ? nullptr : &grids.variable(index);
  };
  const io::VariableInFile* const lon_bounds = bounds(pair.lon_bounds);
  const io::VariableInFile* const lat_bounds = bounds(pair.lat_bounds);
  mesh.grid = LonLatGrid{lines_of(file, lon, lat, lon_bounds, true),
                         lines_of(file, lat, lon, lat_bounds, false)};
  if (lon_bounds != nullptr) mesh.given_lines.lon_deg = mesh.grid->lon_deg;
  if (lat_bounds != nullptr) mesh.given_lines.lat_deg = mesh.grid->lat_deg;
  mesh.shape = {lat.num_values, lon.num_values};
  const std::vector<double> lons = degrees_of(file, lon, UsualUnits::of_name, {lon_bounds, &lat});
  const std::vector<double> lats = degrees_of(file, lat, UsualUnits::of_name, {lat_bounds, &lon});
  tell_of_outside(lon, lon_bounds, lons, mesh.grid->lon_deg, mesh.remarks);
  tell_of_outside(lat, lat_bounds, lats, mesh.grid->lat_deg, mesh.remarks);
  for (std::size_t j = 0; j < lats.size(); ++j) {
    mesh.axes.lat_deg.push_back(
        require_position(io::in_quotes(lat.name), j, {lons.front(), lats[j]}).lat_deg);
  }
  for (std::size_t i = 0; i < lons.size(); ++i) {
    mesh.axes.lon_deg.push_back(
        require_position(io::in_quotes(lon.name), i, {lons[i], lats.front()}).lon_deg);
  }
  return mesh;
}

}  // namespace

std::optional<MeshContent> read_cf_grid(const NetcdfReader& file, const std::string& name,
                                        MissingCorners corners) {
  if (!name.empty() && file.find(name) == nullptr) return std::nullopt;
  std::vector<std::string> remarks;
  CfGrids grids(file, name, corners, remarks);
  const CoordinatePair* const pair = grids.best();
  if (pair == nullptr) return std::nullopt;
  MeshContent mesh = pair->are_axes               ? cells_along_axes(file, grids, *pair)
                     : CfGrids::has_bounds(*pair) ? cells_with_corners(file, grids, *pair)
                                                  : cells_around_centers(file, grids, *pair);
  mesh.convention = "CF";
  for (std::string& remark : remarks) {
    if (remark.starts_with("there is no variable") && pair->are_axes) {
      remark += ", so cells end half way between the coordinates";
    }
  }
  mesh.remarks.insert(mesh.remarks.begin(), remarks.begin(), remarks.end());
  return mesh;
}

}  // namespace rondel::formats

namespace rondel {

LonLatGrid grid_around(std::span<const double> lon_deg, std::span<const double> lat_deg) {
  return {axis_lines(lon_deg, {}, true), axis_lines(lat_deg, {}, false)};
}

}  // namespace rondel
