// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/map_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "exact/long_integer.h"

namespace rondel::map {
namespace {

using exact::LongInteger;

constexpr double half_steps_per_degree = 0x1p45;

LongInteger doubled_area_of(const GridPlace& a, const GridPlace& b, const GridPlace& c) {
  return LongInteger::product(b.x - a.x, c.y - a.y) - LongInteger::product(b.y - a.y, c.x - a.x);
}

// Returns the floor of length * part / whole, with 0 <= part <= whole < 2^110. It is computed digit
// by digit, so that no intermediate number reaches 3 * 2^110.
std::int64_t floor_of_share(std::int64_t length, const LongInteger& part,
                            const LongInteger& whole) {
  const auto size = static_cast<std::uint64_t>(length < 0 ? -length : length);
  std::int64_t quotient = 0;
  LongInteger rest;
  for (auto bit = static_cast<int>(std::bit_width(size)); bit-- > 0;) {
    rest = rest + rest;
    if (((size >> bit) & 1U) != 0) rest = rest + part;
    quotient *= 2;
    for (; rest >= whole; rest = rest - whole) ++quotient;
  }
  if (length >= 0) return quotient;
  return rest.sign() == 0 ? -quotient : -quotient - 1;
}

// Returns the even number c whose interval [c - 1, c + 1) contains all numbers with the given
// floor.
std::int64_t pixel_of(std::int64_t floor) { return 2 * ((floor + 1) >> 1); }

}  // namespace

GridPlace on_grid(const LonLat& position) {
  constexpr double steps_per_degree = half_steps_per_degree / 2;
  return {2 * std::llrint(position.lon_deg * steps_per_degree),
          2 * std::llrint(position.lat_deg * steps_per_degree)};
}

LonLat off_grid(const GridPlace& place) {
  return {static_cast<double>(place.x) / half_steps_per_degree,
          static_cast<double>(place.y) / half_steps_per_degree};
}

int turn_on_grid(const GridPlace& a, const GridPlace& b, const GridPlace& c) {
  return doubled_area_of(a, b, c).sign();
}

bool is_before_along(const GridPlace& a, const GridPlace& b, const GridPlace& p,
                     const GridPlace& q) {
  const LongInteger along =
      LongInteger::product(b.x - a.x, q.x - p.x) + LongInteger::product(b.y - a.y, q.y - p.y);
  return along.sign() > 0;
}

// A line whose rectangle does not meet the square does not meet it either. Otherwise the line meets
// the square if the square has corners on both sides of it. If not, the line touches at most the
// border of the square: a side that belongs to it (with the corner in the south west), or that
// corner alone, or a part that does not belong to it.
bool meets_pixel(const GridPlace& a, const GridPlace& b, const GridPlace& c) {
  const auto [west, east] = std::minmax(a.x, b.x);
  const auto [south, north] = std::minmax(a.y, b.y);
  if (east < c.x - 1 || west >= c.x + 1 || north < c.y - 1 || south >= c.y + 1) return false;
  const int south_west = turn_on_grid(a, b, {c.x - 1, c.y - 1});
  if (south_west == 0) return true;
  const std::array<int, 3> others = {turn_on_grid(a, b, {c.x + 1, c.y - 1}),
                                     turn_on_grid(a, b, {c.x + 1, c.y + 1}),
                                     turn_on_grid(a, b, {c.x - 1, c.y + 1})};
  return std::ranges::any_of(others, [&](int sign) { return sign == -south_west; });
}

GridPlace crossing_pixel(const GridPlace& a, const GridPlace& b, const GridPlace& c,
                         const GridPlace& d) {
  LongInteger at_a = doubled_area_of(c, d, a);
  LongInteger at_b = doubled_area_of(c, d, b);
  if (at_a.sign() < 0) {
    at_a = -at_a;
    at_b = -at_b;
  }
  const LongInteger whole = at_a - at_b;
  return {pixel_of(a.x + floor_of_share(b.x - a.x, at_a, whole)),
          pixel_of(a.y + floor_of_share(b.y - a.y, at_a, whole))};
}

}  // namespace rondel::map
