// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds sites that are copies of others bit by bit, as far as a quick search tells: of many copies
// of one place a few are left, so that no rank receives all of them. The remaining ones are found
// later, where places are compared exactly.
//
// in    points
// out   copies, each with a site of a lower index that is not a copy
// index points, from 0 on
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::distributed {

using PointBits = std::array<std::uint64_t, 3>;
inline PointBits bits_of(const Point& p) { return std::bit_cast<PointBits>(p); }

// A site that has the same coordinates as another one, bit by bit.
struct PointCopy {
  std::uint64_t site = 0;
  std::uint64_t same = 0;  // the site with the same coordinates
};

// Returns copies in increasing order of site. Searches pieces of the points separately, so that it
// does not find copies across pieces; if samples of the pieces have no copies, it searches no
// further.
std::vector<PointCopy> find_copies(std::span<const Point> points, unsigned threads);

}  // namespace rondel::distributed
