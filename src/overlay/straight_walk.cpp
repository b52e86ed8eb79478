// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/straight_walk.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "exact/eft.h"
#include "overlay/plane.h"
#include "overlay/straight_sides.h"

namespace rondel::overlay {
namespace {

// Lines that are farther from the equator are measured from the pole.
constexpr double polar_degrees = 88;

// Returns the value at `x` of the line through (x0, y0) and (x1, y1), not beyond these ends.
double on_line(double x0, double y0, double x1, double y1, double x) {
  const double y = y0 + (x - x0) / (x1 - x0) * (y1 - y0);
  return std::clamp(y, std::min(y0, y1), std::max(y0, y1));
}

}  // namespace

double StraightWalk::width_deg(Index column) const {
  return grid_.columns()[column].east_deg - grid_.columns()[column].west_deg;
}

double StraightWalk::lon_of(const PlaceOnMap& place) const {
  return 360 * place.turn + grid_.columns()[place.column].west_deg + place.offset_deg;
}

Index StraightWalk::row_of(double lat_deg) const {
  Index low = 0;
  Index high = grid_.num_rows();
  while (high - low > 1) {
    const Index middle = low + (high - low) / 2;
    (lat_deg < grid_.parallel(middle).lat_deg ? high : low) = middle;
  }
  return low;
}

double StraightWalk::on_parallels(double lat_deg) const {
  const Index row = row_of(lat_deg);
  const double south = grid_.parallel(row).lat_deg;
  const double north = grid_.parallel(row + 1).lat_deg;
  const double near = lat_deg - south < north - lat_deg ? south : north;
  return std::abs(lat_deg - near) <= on_side_deg ? near : lat_deg;
}

StraightWalk::PlaceOnMap StraightWalk::place_of(const LonLat& position) const {
  const auto& columns = grid_.columns();
  PlaceOnMap place{0, 0, 0, on_parallels(position.lat_deg)};
  place.turn = std::floor((position.lon_deg - columns.front().west_deg) / 360);
  const double lon = position.lon_deg - 360 * place.turn;
  const auto next = std::ranges::upper_bound(columns, lon, {},
                                             [](const auto& column) { return column.west_deg; });
  place.column = static_cast<Index>(std::max<std::ptrdiff_t>(next - columns.begin(), 1) - 1);
  place.offset_deg = std::max(lon - columns[place.column].west_deg, 0.0);
  if (place.offset_deg <= on_side_deg) place.offset_deg = 0;
  if (width_deg(place.column) - place.offset_deg > on_side_deg) return place;
  place.offset_deg = 0;
  if (++place.column == columns.size()) {
    place.column = 0;
    ++place.turn;
  }
  return place;
}

void StraightWalk::append(const LonLatSide& side, std::vector<Strip>& strips) const {
  const EastwardSide given = eastward(side);
  PlaceOnMap last = place_of(given.west);
  const PlaceOnMap end = place_of(given.east);
  const double west = lon_of(last);
  const double east = lon_of(end);
  const double first_lat = last.lat_deg;
  const auto column_of = [](const PlaceOnMap& p) { return std::tuple(p.turn, p.column); };
  while (column_of(last) < column_of(end)) {
    PlaceOnMap next = last;
    next.offset_deg = width_deg(last.column);
    next.lat_deg = on_line(west, first_lat, east, end.lat_deg, lon_of(next));
    append_rows(last, next, given.sign, strips);
    last = next;
    last.offset_deg = 0;
    if (++last.column == grid_.columns().size()) {
      last.column = 0;
      ++last.turn;
    }
  }
  append_rows(last, end, given.sign, strips);
}

void StraightWalk::append_rows(const PlaceOnMap& west, const PlaceOnMap& east, double sign,
                               std::vector<Strip>& strips) const {
  if (!(west.offset_deg < east.offset_deg)) return;
  PlaceOnMap last = west;
  Index row = row_of(west.lat_deg);
  const Index last_row = row_of(east.lat_deg);
  while (row != last_row) {
    const bool is_north = last_row > row;
    PlaceOnMap next = last;
    next.lat_deg = grid_.parallel(is_north ? row + 1 : row).lat_deg;
    next.offset_deg = std::max(last.offset_deg, on_line(west.lat_deg, west.offset_deg, east.lat_deg,
                                                        east.offset_deg, next.lat_deg));
    append_strip(last, next, row, sign, strips);
    last = next;
    row = is_north ? row + 1 : row - 1;
  }
  append_strip(last, east, row, sign, strips);
}

void StraightWalk::append_strip(const PlaceOnMap& west, const PlaceOnMap& east, Index row,
                                double sign, std::vector<Strip>& strips) const {
  const PreparedGrid::Lune& column = grid_.columns()[west.column];
  const auto turned = [&](double offset_deg) {
    return offset_deg == width_deg(west.column) ? column.width : offset_deg * radians_of_degree;
  };
  const exact::DoubleDouble width =
      exact::two_diff(turned(east.offset_deg), turned(west.offset_deg));
  if (!(width.hi > 0)) return;
  const PreparedGrid::Parallel& south = grid_.parallel(row);
  Strip& strip = strips.emplace_back();
  strip.column = west.column;
  strip.row = row;
  strip.width = sign * width.hi;
  strip.width_rest = sign * width.lo;
  strip.length = std::abs(east.lat_deg - west.lat_deg) * radians_of_degree +
                 width.hi * std::max(south.cosine, grid_.parallel(row + 1).cosine);
  const double nearest = std::min(std::abs(west.lat_deg), std::abs(east.lat_deg));
  if (nearest > polar_degrees && west.lat_deg * east.lat_deg > 0) {
    strip.pole = west.lat_deg > 0 ? 1 : -1;
    strip.area = -strip.width * strip.pole * mean_gap(west.lat_deg, east.lat_deg);
  } else {
    strip.area = strip.width * mean_rise(south.lat_deg, west.lat_deg, east.lat_deg);
  }
  if (!has_moments_) return;
  const double from = turned(west.offset_deg);
  strip.run = sign * (grid_.meridian(west.column, turned(east.offset_deg)) -
                      grid_.meridian(west.column, from));
  strip.moment =
      sign * moment_above({south.lat_deg, west.lat_deg, east.lat_deg, width.hi}, [&](double share) {
        return grid_.meridian(west.column, from + share * width.hi);
      });
}

}  // namespace rondel::overlay
