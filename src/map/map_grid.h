// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Positions of a map on a grid of 2^-44 degrees (6 nanometers on the earth), and exact signs of them.
//
// Coordinates count half steps of the grid, so that the borders of its pixels are integers, too: at most 180 * 2^45 < 2^53,
// which doubles hold. Differences are below 2^54, products of two of them below 2^108, and sums of two products below 2^109:
// words of 128 bits hold them.
#pragma once

#include <compare>
#include <cstdint>

#include "rondel/types.h"

namespace rondel::map {

struct GridPlace {
  std::int64_t x = 0;  // half steps; even for a position of the grid
  std::int64_t y = 0;
  friend auto operator<=>(const GridPlace&, const GridPlace&) = default;
};

// The position of the grid nearest to a position.
GridPlace on_grid(const LonLat& position);

// Exact.
LonLat off_grid(const GridPlace& place);

// The sign of the turn from the line ab to c, positive to the left.
int turn_on_grid(const GridPlace& a, const GridPlace& b, const GridPlace& c);

// Whether the places p and q lie along the line ab in this order, by their feet on it.
bool is_before_along(const GridPlace& a, const GridPlace& b, const GridPlace& p,
                     const GridPlace& q);

// The pixel of a position c of the grid is the square [c.x - 1, c.x + 1) x [c.y - 1, c.y + 1).
// Whether a line, which is no point, meets it.
bool meets_pixel(const GridPlace& a, const GridPlace& b, const GridPlace& c);

// The position in whose pixel two lines cross. Precondition: they do, inside of both.
GridPlace crossing_pixel(const GridPlace& a, const GridPlace& b, const GridPlace& c,
                         const GridPlace& d);

}  // namespace rondel::map
