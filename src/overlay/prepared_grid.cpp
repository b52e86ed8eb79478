// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/prepared_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "exact/angles.h"
#include "overlay/arc_bulge.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/arithmetic.h"
#include "system/message_text.h"

namespace rondel::overlay {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

// True if the meridians span 360 degrees.
bool goes_around(const std::vector<double>& lon) {
  return std::abs(std::abs(lon.back() - lon.front()) - 360) <= same_line_degrees;
}

// Throws InvalidInput, with the line, unless the lines are in order and in range and bound cells.
void validate(const LonLatGrid& grid) {
  const std::vector<double>& lon = grid.lon_deg;
  const std::vector<double>& lat = grid.lat_deg;
  if (lon.size() < 2 || lat.size() < 2) {
    throw InvalidInput("a grid of " + std::to_string(lon.size()) + " meridians and " +
                       std::to_string(lat.size()) + " parallels has no cell");
  }
  const auto refuse = [](const char* what, std::size_t k, double value, const char* why) {
    throw InvalidInput(std::string(what) + " " + std::to_string(k) + ", " +
                           system::shortest_text(value) + ", " + why,
                       k);
  };
  constexpr double max_degrees = 1080;
  const bool is_westward = lon[1] < lon[0];
  for (std::size_t k = 0; k < lon.size(); ++k) {
    if (!(std::abs(lon[k]) <= max_degrees)) refuse("meridian", k, lon[k], "is no longitude");
    if (k > 0 && !(is_westward ? lon[k] < lon[k - 1] : lon[k] > lon[k - 1])) {
      refuse("meridian", k, lon[k],
             is_westward ? "is not west of the last" : "is not east of the last");
    }
    if (!(std::abs(lon[k] - lon[0]) <= 360 + same_line_degrees)) {
      refuse("meridian", k, lon[k], "is more than once around the globe");
    }
  }
  const bool is_southward = lat[1] < lat[0];
  for (std::size_t k = 0; k < lat.size(); ++k) {
    if (!(std::abs(lat[k]) <= 90)) refuse("parallel", k, lat[k], "is no latitude");
    if (k > 0 && !(is_southward ? lat[k] < lat[k - 1] : lat[k] > lat[k - 1])) {
      refuse("parallel", k, lat[k], "is not in order");
    }
  }
  if ((lon.size() - 1) >= no_index / (lat.size() - 1)) {
    throw InvalidInput("the grid has too many cells");
  }
}

// Returns the point of the equator at a longitude.
Point on_equator(double lon_deg) {
  const exact::SineCosine angle = exact::sine_cosine_of_degrees(lon_deg);
  return {angle.cosine, angle.sine, 0};
}

}  // namespace

PreparedGrid::PreparedGrid(const LonLatGrid& grid) {
  validate(grid);
  num_columns_of_grid_ = static_cast<Index>(grid.lon_deg.size() - 1);
  num_rows_of_grid_ = static_cast<Index>(grid.lat_deg.size() - 1);
  take_columns(grid.lon_deg);
  take_rows(grid.lat_deg);
}

void PreparedGrid::take_columns(std::vector<double> lon) {
  is_around_ = goes_around(lon);
  is_westward_ = lon.front() > lon.back();
  if (is_westward_) std::ranges::reverse(lon);
  if (is_around_) lon.back() = lon.front() + 360;
  for (std::size_t k = 0; k + 1 < lon.size(); ++k) {
    const std::size_t of_grid = is_westward_ ? lon.size() - 2 - k : k;
    columns_.push_back({on_equator(lon[k]), (lon[k] - lon[0]) * radians_per_degree,
                        (lon[k + 1] - lon[k]) * radians_per_degree, static_cast<Index>(of_grid),
                        lon[k], lon[k + 1]});
  }
  if (is_around_) return;
  const double gap = 360 - (lon.back() - lon.front());
  columns_.push_back({on_equator(lon.back()), (lon.back() - lon[0]) * radians_per_degree,
                      gap * radians_per_degree, no_index, lon.back(), lon.front() + 360});
}

void PreparedGrid::take_rows(std::vector<double> lat) {
  is_southward_ = lat.front() > lat.back();
  if (is_southward_) std::ranges::reverse(lat);
  latitudes_ = lat;
  first_row_ = lat.front() > -90 ? 1 : 0;
  if (lat.front() > -90) lat.insert(lat.begin(), -90);
  if (lat.back() < 90) lat.push_back(90);
  for (const double latitude : lat) {
    const exact::SineCosine angle = exact::sine_cosine_of_degrees(latitude);
    const double gap = height_of(angle.sine, angle.cosine).gap;
    parallels_.push_back({angle.sine, angle.cosine, latitude, gap});
  }
  for (std::size_t r = 0; r + 1 < parallels_.size(); ++r) {
    heights_.push_back(height_between(parallels_[r], parallels_[r + 1]));
    const double rise = parallels_[r + 1].sine - parallels_[r].sine;
    const double run = parallels_[r + 1].cosine - parallels_[r].cosine;
    chords_.push_back(std::sqrt(rise * rise + run * run));
  }
}

Index PreparedGrid::cell(Index column, Index row) const {
  const Index lon = columns_[column].of_grid;
  if (lon == no_index || row < first_row_ || row >= first_row_ + num_rows_of_grid_) return no_index;
  const Index northward = row - first_row_;
  const Index lat = is_southward_ ? num_rows_of_grid_ - 1 - northward : northward;
  return lat * num_columns_of_grid_ + lon;
}

Point PreparedGrid::meridian(Index column, double offset) const {
  if (offset == 0) return columns_[column].west;
  if (offset == columns_[column].width) return eastern_meridian(column);
  const Point& west = columns_[column].west;
  const exact::SineCosine turn = exact::sine_cosine_of_degrees(offset / radians_per_degree);
  return {west.x * turn.cosine - west.y * turn.sine, west.x * turn.sine + west.y * turn.cosine, 0};
}

std::vector<double> PreparedGrid::areas() const {
  std::vector<double> result(num_cells());
  for (Index c = 0; c < num_columns_of_grid_; ++c) {
    for (Index r = first_row_; r < first_row_ + num_rows_of_grid_; ++r) {
      result[cell(c, r)] = area(c, r);
    }
  }
  return result;
}

std::vector<Point> PreparedGrid::moments() const {
  std::vector<Point> result(num_cells());
  for (Index c = 0; c < num_columns_of_grid_; ++c) {
    const Point run = meridian(c, columns_[c].width) - columns_[c].west;
    for (Index r = first_row_; r < first_row_ + num_rows_of_grid_; ++r) {
      result[cell(c, r)] =
          moment_of_row(parallels_[r], parallels_[r + 1], heights_[r], columns_[c].width, run);
    }
  }
  return result;
}

PreparedGrid::CellSize PreparedGrid::size_of(Index column, Index row) const {
  const Index r = row - first_row_;
  const double height = (latitudes_[r + std::size_t{1}] - latitudes_[r]) * radians_per_degree;
  const double cosines = parallels_[row].cosine + parallels_[row + 1].cosine;
  return {area(column, row), columns_[column].width * cosines + 2 * height};
}

PreparedGrid::ColumnAndRow PreparedGrid::place_of(Index cell) const {
  const Index lat = cell / num_columns_of_grid_;
  const Index lon = cell % num_columns_of_grid_;
  return {is_westward_ ? num_columns_of_grid_ - 1 - lon : lon,
          first_row_ + (is_southward_ ? num_rows_of_grid_ - 1 - lat : lat)};
}

PreparedGrid::CellSize PreparedGrid::size_of(Index cell) const {
  const auto [column, row] = place_of(cell);
  return size_of(column, row);
}

std::vector<double> PreparedGrid::lengths() const {
  std::vector<double> result(num_cells());
  for (Index c = 0; c < num_columns_of_grid_; ++c) {
    for (Index r = first_row_; r < first_row_ + num_rows_of_grid_; ++r) {
      result[cell(c, r)] = size_of(c, r).length;
    }
  }
  return result;
}

void PreparedGrid::append_neighbors(Index cell, std::vector<Index>& neighbors) const {
  const Index n = num_columns_of_grid_;
  const Index column = cell % n;
  const auto append = [&](Index neighbor) { neighbors.push_back(neighbor); };
  if (cell >= n) append(cell - n);
  if (column > 0 || is_around_) append(column > 0 ? cell - 1 : cell + n - 1);
  if (column + 1 < n || is_around_) append(column + 1 < n ? cell + 1 : cell + 1 - n);
  if (num_cells() - cell > n) append(cell + n);
}

// Differences of latitudes and of distances from a pole are exact where they are small.
double rise_between(double low_deg, double high_deg) {
  constexpr double half_way = 45;
  const double middle = low_deg / 2 + high_deg / 2;
  const double from_pole = (90 - std::abs(low_deg)) / 2 + (90 - std::abs(high_deg)) / 2;
  const double cosine = std::abs(middle) > half_way ? exact::sine_cosine_of_degrees(from_pole).sine
                                                    : exact::sine_cosine_of_degrees(middle).cosine;
  const double half = high_deg / 2 - low_deg / 2;
  return 2 * cosine * exact::sine_cosine_of_degrees(half).sine;
}

double height_between(const PreparedGrid::Parallel& south, const PreparedGrid::Parallel& north) {
  return rise_between(south.lat_deg, north.lat_deg);
}

namespace {

// Returns the integral of cos^2 over the latitudes between two parallels: (phi + s sqrt(1 - s^2)) /
// 2 with s = sin(phi), and near a pole (c - sin(2 c) / 2) / 2 with the distances c from it.
double inward_between(const PreparedGrid::Parallel& south, const PreparedGrid::Parallel& north) {
  if (is_polar(south.height(), north.height())) {
    const auto from_pole = [](const PreparedGrid::Parallel& parallel) {
      const double c = (90 - std::abs(parallel.lat_deg)) * radians_per_degree;
      return -c / 2 * sine_ratio_less_one(2 * c);
    };
    return std::abs(from_pole(south) - from_pole(north));
  }
  const double angle = exact::argument(north.sine * south.cosine - north.cosine * south.sine,
                                       north.cosine * south.cosine + north.sine * south.sine);
  return (angle + (north.sine * north.cosine - south.sine * south.cosine)) / 2;
}

}  // namespace

Point moment_of_row(const PreparedGrid::Parallel& south, const PreparedGrid::Parallel& north,
                    double height, double width, const Point& run) {
  const double inward = inward_between(south, north);
  return {inward * run.y, -inward * run.x, width * height * (north.sine + south.sine) / 2};
}

CellRings rings_of(const LonLatGrid& grid) {
  validate(grid);
  const std::size_t num_columns = grid.lon_deg.size() - 1;
  // The shorter arc between corners that are so far apart runs over a pole, or around the other way.
  for (std::size_t k = 0; k < num_columns; ++k) {
    const double width = std::abs(grid.lon_deg[k + 1] - grid.lon_deg[k]);
    if (width < 180) continue;
    throw InvalidInput("cell " + std::to_string(k) + " is " + system::shortest_text(width) +
                           " degrees wide: sides along great circles need less than 180 degrees",
                       k);
  }
  const bool is_around = goes_around(grid.lon_deg);
  const bool is_southward = grid.lat_deg[1] < grid.lat_deg[0];
  const bool is_westward = grid.lon_deg[1] < grid.lon_deg[0];
  const std::size_t num_meridians = is_around ? num_columns : num_columns + 1;
  CellRings rings;
  std::vector<Index> firsts;  // the first point on each parallel
  for (const double lat : grid.lat_deg) {
    firsts.push_back(static_cast<Index>(rings.points.size()));
    for (std::size_t k = 0; k < (std::abs(lat) == 90 ? 1 : num_meridians); ++k) {
      rings.points.push_back(unit_vector({grid.lon_deg[k], lat}));
    }
  }
  const auto corner = [&](std::size_t row, std::size_t k) {
    const bool is_pole = std::abs(grid.lat_deg[row]) == 90;
    return firsts[row] + (is_pole ? 0 : static_cast<Index>(k % num_meridians));
  };
  for (std::size_t row = 0; row + 1 < grid.lat_deg.size(); ++row) {
    const std::size_t south = is_southward ? row + 1 : row;
    const std::size_t north = is_southward ? row : row + 1;
    for (std::size_t k = 0; k < num_columns; ++k) {
      const std::size_t west = is_westward ? k + 1 : k;
      const std::size_t east = is_westward ? k : k + 1;
      std::vector<Index> ring = {corner(south, west), corner(south, east), corner(north, east),
                                 corner(north, west)};
      ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
      if (ring.front() == ring.back()) ring.pop_back();
      rings.append_ring(ring);
      rings.end_cell();
    }
  }
  return rings;
}

}  // namespace rondel::overlay

namespace rondel {
namespace {

// Returns the position after `halves` of the 2 n half cells that divide [-half, half]. Numerator
// and denominator are integers, so that only one division rounds.
double place(std::uint64_t halves, std::uint64_t n, std::int64_t half) {
  const auto count = static_cast<std::int64_t>(n);
  const std::int64_t numerator = (static_cast<std::int64_t>(halves) - count) * half;
  return static_cast<double>(numerator) / static_cast<double>(count);
}

// Returns the places after each second of the half cells.
std::vector<double> places(std::uint64_t first, std::uint64_t n, std::int64_t half) {
  std::vector<double> result;
  result.reserve(n + 1);
  for (std::uint64_t k = first; k <= 2 * n; k += 2) result.push_back(place(k, n, half));
  return result;
}

}  // namespace

LonLatGrid GlobalGrid::lines() const {
  const system::ArithmeticScope arithmetic;
  return {places(0, num_lon, 180), places(0, num_lat, 90)};
}

LonLatAxes GlobalGrid::centers() const {
  const system::ArithmeticScope arithmetic;
  return {places(1, num_lon, 180), places(1, num_lat, 90)};
}

// Cells between the parallels at b - h and b + h have as a difference of sines 2 cos b sin h, which
// is twice the y of the place at longitude h and latitude b.
std::vector<double> GlobalGrid::areas() const {
  const system::ArithmeticScope arithmetic;
  std::vector<LonLat> middles;
  for (const double lat : centers().lat_deg) {
    middles.push_back({place(num_lat + 1, num_lat, 90), lat});
  }
  std::vector<double> areas;
  areas.reserve(num_lon * num_lat);
  const double width = 2 * std::numbers::pi / static_cast<double>(num_lon);
  for (const Point& point : unit_vectors(middles)) {
    areas.insert(areas.end(), num_lon, width * 2 * point.y);
  }
  return areas;
}

}  // namespace rondel
