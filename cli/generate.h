// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Generators of sites. The same recipe gives the same bits on every platform: integer random
/// numbers, + - * / and sqrt, and rondel::unit_vector for angles.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/types.h"

namespace rondel::cli {

/// What to generate, apart from the kind.
struct Recipe {
  std::size_t n = 0;
  std::uint64_t seed = 1;
  std::size_t rows = 0;     ///< of a lonlat-grid; 0: from n
  std::size_t columns = 0;  ///< of a lonlat-grid; 0: from n
  double angle_deg = 0;     ///< angular radius; 0: the kind's own
};

/// Sites, and their longitudes and latitudes if they were made from those. Where there are radii,
/// the sites are the polar points of circles.
struct Generated {
  std::vector<Point> sites;
  std::vector<LonLat> positions;
  std::vector<double> radii_deg;
};

/// A kind of sites.
struct Kind {
  std::string_view name;
  std::string_view what;
  /// \pre n > 0 or, for a lonlat-grid, rows > 0 and columns > 0
  Generated (*make)(const Recipe& recipe);
  bool takes_angle;
};

std::span<const Kind> kinds();
/// Null if there is none of this name.
const Kind* find_kind(std::string_view name);

}  // namespace rondel::cli
