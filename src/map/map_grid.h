// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The grid of positions of a map, with steps of 2^-44 degrees (6 nanometers on the earth), and
// exact signs for its positions.
//
// Coordinates count half steps of the grid, so that the borders of its pixels are integers too.
// They are at most 180 * 2^45 < 2^53, which doubles represent. Differences are below 2^54, products
// of two of them below 2^108, and sums of two products below 2^109, so integers of 128 bits
// suffice.
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

// Returns the position of the grid that is nearest to a position.
GridPlace on_grid(const LonLat& position);

// Returns the position in degrees, without rounding.
LonLat off_grid(const GridPlace& place);

// The sign of the turn from the line ab to c, positive to the left.
// Returns 1 if c is to the left of the line from a to b, -1 if it is to the right, and 0 if it is
// on the line.
int turn_on_grid(const GridPlace& a, const GridPlace& b, const GridPlace& c);

// True if the foot of p on the line ab comes before the foot of q.
bool is_before_along(const GridPlace& a, const GridPlace& b, const GridPlace& p,
                     const GridPlace& q);

// True if the line ab, with a != b, meets the pixel of the position c: the square [c.x - 1, c.x +
// 1) x [c.y - 1, c.y + 1).
bool meets_pixel(const GridPlace& a, const GridPlace& b, const GridPlace& c);

// Returns the position in whose pixel the lines ab and cd cross. Precondition: they cross, in a
// point inside of both.
GridPlace crossing_pixel(const GridPlace& a, const GridPlace& b, const GridPlace& c,
                         const GridPlace& d);

}  // namespace rondel::map
