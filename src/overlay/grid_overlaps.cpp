// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the intersections of two grids of meridians and parallels: the intersections of their
// columns times those of their rows.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "overlay/grid_pieces.h"

namespace rondel::overlay {
namespace {

// Returns `to` if the value is within rounding of it, or the value.
double snapped(double to, double value) {
  return std::abs(value - to) <= same_line_degrees ? to : value;
}

}  // namespace

// Adds an overlap unless it is narrower than the distance of lines that are one.
void GridOverlay::add_overlap(const LineOverlap& overlap, std::vector<LineOverlap>& overlaps) {
  if (overlap.high - overlap.low > same_line_degrees) overlaps.push_back(overlap);
}

// Returns the ranges of longitude that columns of the two grids share. `first` is a column of a.
std::vector<GridOverlay::LineOverlap> GridOverlay::shared_columns(const PreparedGrid& a,
                                                                  const PreparedGrid& b) {
  std::vector<LineOverlap> overlaps;
  for (Index i = 0; i < a.num_columns_of_grid(); ++i) {
    const double west = a.columns()[i].west_deg;
    const double east = a.columns()[i].east_deg;
    // Columns of b are visited from the one with the western meridian on, once around the globe.
    const Index n = b.num_columns_of_grid();
    const double first = b.columns()[0].west_deg;
    double shift = std::floor((west - first) / 360) * 360;
    const auto after = std::upper_bound(
        b.columns().begin(), b.columns().begin() + n, west - shift,
        [](double lon, const PreparedGrid::Lune& column) { return lon < column.west_deg; });
    auto j = static_cast<Index>(std::max<std::ptrdiff_t>(after - b.columns().begin(), 1) - 1);
    for (Index step = 0; step <= n; ++step) {
      const double low = snapped(west, b.columns()[j].west_deg + shift);
      const double high = snapped(east, b.columns()[j].east_deg + shift);
      if (low >= east) break;
      add_overlap({i, j, std::max(low, west), std::min(high, east)}, overlaps);
      if (++j == n) {
        j = 0;
        shift += 360;
      }
    }
  }
  return overlaps;
}

// Returns the ranges of latitude that rows of the two grids share. `first` is a row of a.
std::vector<GridOverlay::LineOverlap> GridOverlay::shared_rows(const PreparedGrid& a,
                                                               const PreparedGrid& b) {
  std::vector<LineOverlap> overlaps;
  Index j = 0;
  for (Index i = 0; i < a.num_rows_of_grid(); ++i) {
    const double south = a.latitudes()[i];
    const double north = a.latitudes()[i + 1];
    while (j > 0 && b.latitudes()[j] > south) --j;
    for (; j < b.num_rows_of_grid(); ++j) {
      const double low = snapped(south, b.latitudes()[j]);
      const double high = snapped(north, b.latitudes()[j + 1]);
      add_overlap({i, j, std::max(low, south), std::min(high, north)}, overlaps);
      if (high > north) break;
    }
    if (j == b.num_rows_of_grid()) j = b.num_rows_of_grid() - 1;
  }
  return overlaps;
}

// Converts a range of longitude into what the moments of boxes need.
GridOverlay::LonRange GridOverlay::range_of(const LineOverlap& overlap, const PreparedGrid& grid) {
  constexpr double one_degree = std::numbers::pi / 180;
  const PreparedGrid::Lune& column = grid.columns()[overlap.first];
  const auto meridian = [&](double lon) {
    return lon == column.east_deg
               ? grid.eastern_meridian(overlap.first)
               : grid.meridian(overlap.first, (lon - column.west_deg) * one_degree);
  };
  return {overlap.second, (overlap.high - overlap.low) * one_degree,
          meridian(overlap.high) - meridian(overlap.low)};
}

// Converts a range of latitude into parallels; those that are lines of a grid are taken from it.
GridOverlay::LatRange GridOverlay::range_of(const LineOverlap& overlap, const PreparedGrid& grid,
                                            const PreparedGrid& other) {
  const auto parallel = [&](double latitude) {
    const Index row = grid.first_row() + overlap.first;
    if (latitude == grid.latitudes()[overlap.first]) return grid.parallel(row);
    if (latitude == grid.latitudes()[overlap.first + std::size_t{1}]) return grid.parallel(row + 1);
    const Index of_other = other.first_row() + overlap.second;
    return other.parallel(latitude == other.latitudes()[overlap.second] ? of_other : of_other + 1);
  };
  const PreparedGrid::Parallel south = parallel(overlap.low);
  const PreparedGrid::Parallel north = parallel(overlap.high);
  return {other.first_row() + overlap.second, south, north, height_between(south, north)};
}

// Appends the pieces of a cell. A column may share two ranges with a column of a grid around the
// globe, which make one piece.
void GridOverlay::append_row(const std::vector<BoxPiece>& row, bool has_moments,
                             PieceRows& result) {
  for (const BoxPiece& piece : row) {
    if (!(piece.area > 0)) continue;  // a row at a pole can be thinner than rounding
    const bool is_same =
        result.columns.size() > result.offsets.back() && result.columns.back() == piece.cell;
    if (is_same) {
      result.areas.back() += piece.area;
      if (has_moments) result.moments.back() = result.moments.back() + piece.moment;
      continue;
    }
    result.columns.push_back(piece.cell);
    result.areas.push_back(piece.area);
    if (has_moments) result.moments.push_back(piece.moment);
  }
  result.end_row();
}

GridOverlay::GridOverlay(const PreparedGrid& rows, const PreparedGrid& columns)
    : columns_(columns), along_(rows.num_columns_of_grid()), across_(rows.num_rows_of_grid()) {
  const Index row_length = rows.num_columns_of_grid();
  for (const LineOverlap& overlap : shared_columns(rows, columns)) {
    const Index given = rows.cell(overlap.first, rows.first_row()) % row_length;
    along_[given].push_back(range_of(overlap, rows));
  }
  for (const LineOverlap& overlap : shared_rows(rows, columns)) {
    const Index given = rows.cell(0, rows.first_row() + overlap.first) / row_length;
    across_[given].push_back(range_of(overlap, rows, columns));
  }
}

PieceRows GridOverlay::pieces(Index first, Index end, bool has_moments) const {
  PieceRows result;
  std::vector<BoxPiece> row;
  const auto row_length = static_cast<Index>(along_.size());
  for (Index cell = first; cell < end; ++cell) {
    row.clear();
    for (const LatRange& lat : across_[cell / row_length]) {
      for (const LonRange& lon : along_[cell % row_length]) {
        const Point moment =
            has_moments ? moment_of_row(lat.south, lat.north, lat.height, lon.width, lon.run)
                        : Point{};
        row.push_back({columns_.cell(lon.column, lat.row), lon.width * lat.height, moment});
      }
    }
    if (!std::ranges::is_sorted(row, {}, &BoxPiece::cell)) {
      std::ranges::stable_sort(row, {}, &BoxPiece::cell);
    }
    append_row(row, has_moments, result);
  }
  return result;
}

}  // namespace rondel::overlay
