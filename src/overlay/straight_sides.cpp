// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Along a straight line over d radians of longitude, with f the latitude of its middle and h half of
// its height, the sine of latitude has the mean sin f sin h / h. The region between the line and a
// parallel is d wide and as high in the mean as this exceeds the sine of the parallel.
#include "overlay/straight_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "exact/angles.h"
#include "exact/eft.h"
#include "exact/vector.h"
#include "overlay/arc_bulge.h"
#include "overlay/plane.h"
#include "overlay/prepared_grid.h"
#include "system/parallel.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t measured_per_block = 64;

double sine_at(double degrees) { return exact::sine_cosine_of_degrees(degrees).sine; }

// Gauss-Legendre quadrature with 8 points on (-1, 1): for an integrand of frequency 1 on steps of
// quadrature_step, the error (1/8)^16 / 16! is far below rounding.
struct QuadraturePoint {
  double place;
  double weight;
};
constexpr double quadrature_step = 0.25;
constexpr std::array<QuadraturePoint, 4> half_of_quadrature = {{
    {0.1834346424956498, 0.3626837833783620},
    {0.5255324099163290, 0.3137066458778873},
    {0.7966664774136267, 0.2223810344533745},
    {0.9602898564975363, 0.1012285362903763},
}};

double lowest_latitude(std::span<const LonLatSide> sides) {
  double lowest = 90;
  for (const LonLatSide& side : sides) {
    lowest = std::min({lowest, side.from.lat_deg, side.to.lat_deg});
  }
  return lowest;
}

// Returns the area of a cell above its lowest parallel.
double area_between(std::span<const LonLatSide> sides) {
  const double lowest = lowest_latitude(sides);
  exact::DoubleDouble sum{};
  for (const LonLatSide& side : sides) {
    const auto [west, east, sign] = eastward(side);
    const double width = (east.lon_deg - west.lon_deg) * radians_of_degree;
    if (width > 0) add_term(sign * width * mean_rise(lowest, west.lat_deg, east.lat_deg), sum);
  }
  return std::max(sum.hi + sum.lo, 0.0);
}

// Returns a bound for the length of a border. Cosines are largest next to the equator.
double length_of(std::span<const LonLatSide> sides) {
  double length = 0;
  for (const LonLatSide& side : sides) {
    const double width = std::abs(side.to.lon_deg - side.from.lon_deg) * radians_of_degree;
    const bool meets_equator = side.from.lat_deg * side.to.lat_deg <= 0;
    const double nearest = std::min(std::abs(side.from.lat_deg), std::abs(side.to.lat_deg));
    length += std::abs(side.to.lat_deg - side.from.lat_deg) * radians_of_degree +
              width * (meets_equator ? 1 : sine_at(90 - nearest));
  }
  return length;
}

}  // namespace

EastwardSide eastward(const LonLatSide& side) {
  if (is_west_of(side.from, side.to)) return {side.from, side.to, -1};
  return {side.to, side.from, 1};
}

double mean_rise(double low_deg, double from_deg, double to_deg) {
  const double middle = (from_deg + to_deg) / 2;
  const double rise = rise_between(low_deg, middle);
  if (from_deg == to_deg) return rise;
  return rise + sine_at(middle) * sine_ratio_less_one((to_deg - from_deg) / 2 * radians_of_degree);
}

double mean_gap(double from_deg, double to_deg) {
  const double from_pole = ((90 - std::abs(from_deg)) + (90 - std::abs(to_deg))) / 2;
  const double half = sine_at(from_pole / 2);
  return 2 * half * half - exact::sine_cosine_of_degrees(from_pole).cosine *
                               sine_ratio_less_one((to_deg - from_deg) / 2 * radians_of_degree);
}

// The integrals over latitude from s to f are ((f - s) + cos(f + s) sin(f - s)) / 2 for the square of
// the cosine, and sin(f + s) sin(f - s) / 2 for the product of sine and cosine.
Point moment_above(const LineAbove& line, const std::function<Point(double)>& meridian) {
  const double height = line.east_deg - line.west_deg;
  const double extent = std::max(line.width, std::abs(height) * radians_of_degree);
  const auto steps = static_cast<unsigned>(std::ceil(2 * extent / quadrature_step));
  Point sum{};
  const auto add = [&](double share, double weight) {
    const double lat = line.west_deg + share * height;
    const double above = lat - line.low_deg;
    const double rise = sine_at(above);
    const exact::SineCosine both = exact::sine_cosine_of_degrees(lat + line.low_deg);
    const double outward = (above * radians_of_degree + both.cosine * rise) / 2;
    const Point along = meridian(share);
    sum = sum + weight * Point{outward * along.x, outward * along.y, both.sine * rise / 2};
  };
  for (unsigned step = 0; step < steps; ++step) {
    for (const auto& [place, weight] : half_of_quadrature) {
      const double scaled = weight * line.width / (2 * steps);
      add((step + (1 - place) / 2) / steps, scaled);
      add((step + (1 + place) / 2) / steps, scaled);
    }
  }
  return sum;
}

StraightSides::StraightSides(CompressedRows<LonLatSide> rows, std::vector<double> areas,
                             std::vector<double> lengths, unsigned threads)
    : rows_(std::move(rows)), areas_(std::move(areas)), lengths_(std::move(lengths)) {
  system::parallel_for(threads, rows_.size(), measured_per_block,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           if (rows_[i].empty()) continue;
                           areas_[i] = area_between(rows_[i]);
                           lengths_[i] = length_of(rows_[i]);
                         }
                       });
}

Point StraightSides::moment(Index cell) const {
  const double lowest = lowest_latitude(rows_[cell]);
  Point sum{};
  for (const LonLatSide& side : rows_[cell]) {
    const auto [west, east, sign] = eastward(side);
    const double width = east.lon_deg - west.lon_deg;
    if (!(width > 0)) continue;
    const LineAbove line{lowest, west.lat_deg, east.lat_deg, width * radians_of_degree};
    const auto meridian = [start = west.lon_deg, width](double share) {
      const exact::SineCosine turn = exact::sine_cosine_of_degrees(start + share * width);
      return Point{turn.cosine, turn.sine, 0};
    };
    sum = sum + sign * moment_above(line, meridian);
  }
  return sum;
}

}  // namespace rondel::overlay
