// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Four sites that are hard for a predicate.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "rondel/types.h"
#include "support/random.h"

namespace rondel::test {

using Four = std::array<Point, 4>;

struct FourGenerator {
  std::string_view name;
  Four (*make)(Random& random);
};

// Nearly or exactly cocircular or coplanar, at distances from 2 down to 1e-15, of mixed
// scales, mirrored, on integer grids, with coordinates moved by one ulp.
std::span<const FourGenerator> four_generators();

// Four points near one circle on the unit sphere, about `distance` apart.
Four near_one_circle(Random& random, double distance);

// 2^-e with e uniform, so that all orders of magnitude from 2 to `smallest` are met.
double random_distance(Random& random, double smallest);

inline int to_int(Sign sign) { return static_cast<int>(sign); }

}  // namespace rondel::test
