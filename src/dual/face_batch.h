// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What is computed for every face, for many at once in loops that become vector
// code. The formulas are those of docs/theory/areas.md.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "dual/split_sites.h"

namespace rondel::dual {

// The kites of a projected face. For each corner it is the area between the corner, the middles of
// its two edges and the circumcenter, negative where the circumcenter lies beyond. The kites around
// a site add up to its cell. The first one is nan if the face needs more care (is_careful()).
using Kites = std::array<double, 3>;
inline constexpr Kites careful_kites = {std::numeric_limits<double>::quiet_NaN(),
                                        std::numeric_limits<double>::quiet_NaN(),
                                        std::numeric_limits<double>::quiet_NaN()};
inline bool is_careful(const Kites& kites) { return kites[0] != kites[0]; }

// A little less than 60 degrees: two faces with a common corner whose circumcenters are that near
// to their corners have less than 120 degrees between them.
inline constexpr double near_cosine = 0.501;

// points[k] = the circumcenter of face begin + k, at most 4u from the exact unit normal. Where
// `kites` is not null, those of the faces are written, too (the model is projected then). Returns whether one
// of them is careful.
bool unit_normals(const SplitSites& sites, std::size_t begin, std::span<Point> points,
                  Kites* kites);

}  // namespace rondel::dual
