// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Named inputs for the tool, the tests and the benchmarks. The same recipe gives the same bits on
/// every platform, since only integer random numbers, + - * / and sqrt, and rondel::unit_vector for
/// angles are used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/types.h"

namespace rondel::inputs {

inline constexpr double degrees_per_radian = 180 / std::numbers::pi;

/// The parameters of an input, except for its kind.
struct Recipe {
  std::size_t n = 0;
  std::uint64_t seed = 1;
  std::size_t rows = 0;     ///< of a lonlat-grid; 0: chosen by n
  std::size_t columns = 0;  ///< of a lonlat-grid; 0: chosen by n
  double angle_deg = 0;     ///< 0: the default of the kind
};

/// Sites, and their longitudes and latitudes if they were made from those. If there are radii, the
/// sites are the polar points of circles.
struct Input {
  std::vector<Point> sites;
  std::vector<LonLat> positions;
  std::vector<double> radii_deg;
};

/// A kind of sites.
struct Kind {
  std::string_view name;
  std::string_view what;
  Input (*from_recipe)(const Recipe& recipe);
  double angle_deg = 0;   ///< used if the recipe has none; 0: the kind has no angle
  bool is_random = true;  ///< false: the seed changes nothing
};

/// Returns kinds that are ordinary, or hard for other programs.
std::span<const Kind> plain_kinds();
/// Returns kinds that cost an algorithm more time, or a predicate more digits, than usual.
std::span<const Kind> hostile_kinds();
/// Returns the kind of this name, or null.
const Kind* find_kind(std::string_view name);

/// Makes an input. \pre n > 0 or, for a lonlat-grid, rows > 0 and columns > 0
Input make(const Kind& kind, Recipe recipe);

}  // namespace rondel::inputs
