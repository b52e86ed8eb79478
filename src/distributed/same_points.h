// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which sites are copies of others bit by bit, as far as a quick look tells: of many copies of one place
// a few are left, so that no rank is sent all of them. The others are found where places are compared
// exactly.
//
// in    points
// out   copies, each with a site of a lower index that is none
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

struct PointCopy {
  std::uint64_t site = 0;
  std::uint64_t same = 0;  // as this one
};

// In increasing order of site. Looks at some points at a time, and sees no copies of what is elsewhere; and at
// samples alone where these have none.
std::vector<PointCopy> find_copies(std::span<const Point> points, unsigned threads);

}  // namespace rondel::distributed
