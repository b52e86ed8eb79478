// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Targets of interpolation: points of a file, or the centers of a grid that "grid:DEG" or
// "grid:NLONxNLAT" names. Cell (i, j) of a grid has the index j * num_lon + i; i counts eastward
// from -180 degrees, j northward from the south pole.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "netcdf_part.h"
#include "remap.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/mesh_files.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// A grid has at most this many cells along a meridian, and twice as many along a parallel.
constexpr std::uint64_t most_parallels = 1'000'000;

// The numbers of cells along a parallel and along a meridian.
struct GridSize {
  std::uint64_t num_lon = 0;
  std::uint64_t num_lat = 0;
};

// Throws UsageError with what a grid is.
[[noreturn]] void refuse(const std::string& text) {
  throw UsageError("'" + text +
                   "' is no grid; grid:DEG divides 180 degrees into equal parts, grid:NLONxNLAT "
                   "has so many cells");
}

// Returns the numbers of cells that the name of a grid says.
GridSize grid_size(const std::string& text) {
  const std::string numbers = text.substr(text.find(':') + 1);
  const std::size_t cross = numbers.find('x');
  if (cross != std::string::npos) {
    const std::string lon = numbers.substr(0, cross);
    const std::string lat = numbers.substr(cross + 1);
    if (!whole_error(lon, 1, 2 * most_parallels).empty() ||
        !whole_error(lat, 1, most_parallels).empty()) {
      refuse(text);
    }
    return {std::stoull(lon), std::stoull(lat)};
  }
  if (!positive_error(numbers).empty()) refuse(text);
  const double count = 180 / std::stod(numbers);
  const double whole = std::round(count);
  // The quotient may be off by one ulp of the step, such as 0.1, and by the rounding of the
  // division.
  if (!(std::abs(count - whole) <= count * 0x1p-50) || whole < 1 ||
      whole > static_cast<double>(most_parallels)) {
    refuse(text);
  }
  const auto num_lat = static_cast<std::uint64_t>(whole);
  return {2 * num_lat, num_lat};
}

// Returns the position after `halves` of the 2 n half cells that divide [-half, half]. Numerator
// and denominator are integers, so that only one division rounds.
double place(std::uint64_t halves, std::uint64_t n, std::int64_t half) {
  const auto count = static_cast<std::int64_t>(n);
  const std::int64_t numerator = (static_cast<std::int64_t>(halves) - count) * half;
  return static_cast<double>(numerator) / static_cast<double>(count);
}

// Returns the centers of the cells in degrees.
std::vector<LonLat> grid_points(const GridSize& size) {
  std::vector<LonLat> points;
  points.reserve(size.num_lon * size.num_lat);
  for (std::uint64_t j = 0; j < size.num_lat; ++j) {
    for (std::uint64_t i = 0; i < size.num_lon; ++i) {
      points.push_back({place(2 * i + 1, size.num_lon, 180), place(2 * j + 1, size.num_lat, 90)});
    }
  }
  return points;
}

// Returns the meridians and parallels between the cells in degrees, one more than cells.
LonLatGrid lines_of(const GridSize& size) {
  LonLatGrid grid;
  for (std::uint64_t i = 0; i <= size.num_lon; ++i) {
    grid.lon_deg.push_back(place(2 * i, size.num_lon, 180));
  }
  for (std::uint64_t j = 0; j <= size.num_lat; ++j) {
    grid.lat_deg.push_back(place(2 * j, size.num_lat, 90));
  }
  return grid;
}

// Returns the areas of cells between the parallels at b - h and b + h: the difference of their
// sines is 2 cos b sin h, which is twice the y of the place at longitude h and latitude b.
std::vector<double> grid_areas(const GridSize& size) {
  std::vector<LonLat> places;
  for (std::uint64_t j = 0; j < size.num_lat; ++j) {
    places.push_back(
        {place(size.num_lat + 1, size.num_lat, 90), place(2 * j + 1, size.num_lat, 90)});
  }
  std::vector<double> areas;
  areas.reserve(size.num_lon * size.num_lat);
  const double width = 2 * std::numbers::pi / static_cast<double>(size.num_lon);
  for (const Point& point : unit_vectors(places)) {
    areas.insert(areas.end(), size.num_lon, width * 2 * point.y);
  }
  return areas;
}

}  // namespace

WeightSide grid_side(const std::string& name) {
  const GridSize size = grid_size(name);
  WeightSide side;
  side.points = grid_points(size);
  side.shape = {size.num_lat, size.num_lon};
  return side;
}

Targets read_targets(const FileName& target, const ReadOptions& read) {
  Targets targets;
  const std::string& name = target.path;
  if (name.starts_with("grid:")) {
    targets.side = grid_side(name);
    targets.table.name = name;
    targets.table.first_line = 0;
    targets.table.sites = unit_vectors(targets.side.points);
    return targets;
  }
  if (const auto [file, variable] = netcdf_part(target); is_netcdf_file(file)) {
    std::vector<std::string> names;
    if (!variable.empty()) names.push_back(variable);
    NetcdfSites sites = read_netcdf_sites(file, names, false);
    tell(file.path, sites.remarks);
    tell_of_columns(file.path, read);
    targets.table = std::move(sites.table);
    targets.side.points = targets.table.positions;
    if (sites.shape.size() > 1) targets.side.shape = std::move(sites.shape);
    return targets;
  }
  ReadOptions options = read;
  options.radius.clear();
  options.keep_columns = false;
  targets.table = read_sites(target, options);
  const SiteTable& table = targets.table;
  targets.side.points = table.is_lonlat() ? table.positions : lonlats(table.sites);
  return targets;
}

LonLatGrid lonlat_grid(const std::string& name) { return lines_of(grid_size(name)); }

std::vector<LonLat> corners_of(const LonLatGrid& grid) {
  std::vector<LonLat> corners;
  for (std::size_t j = 0; j + 1 < grid.lat_deg.size(); ++j) {
    const auto [south, north] = std::minmax(grid.lat_deg[j], grid.lat_deg[j + 1]);
    for (std::size_t i = 0; i + 1 < grid.lon_deg.size(); ++i) {
      const auto [west, east] = std::minmax(grid.lon_deg[i], grid.lon_deg[i + 1]);
      corners.insert(corners.end(), {{west, south}, {east, south}, {east, north}, {west, north}});
    }
  }
  return corners;
}

void add_grid_cells(WeightSide& side) {
  if (side.shape.size() != 2) return;
  const GridSize size = {side.shape[1], side.shape[0]};
  side.corners = corners_of(lines_of(size));
  side.areas = grid_areas(size);
}

}  // namespace rondel::cli
