// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The checks of points and arcs that come from outside.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/types.h"
#include "system/row_assembly.h"

namespace rondel::arrangement {

// Where coordinates are smaller, products of differences lose bits to underflow.
constexpr double least_coordinate = 0x1p-150;
// How far the lengths of unit vectors may be from 1.
constexpr double max_deviation = 1e-14;

// Returns a point near the sphere as arrange() wants it; most points are so already.
inline Point arrangeable(const Point& p) {
  const auto kept = [](double x) { return std::abs(x) < least_coordinate ? 0.0 : x; };
  const Point rounded = {kept(p.x), kept(p.y), kept(p.z)};
  return std::abs(norm(rounded) - 1) <= max_deviation ? rounded : exact::normalized(rounded);
}

// Throws InvalidInput with the first point that is not as arrange() wants it.
inline void validate_points(std::span<const Point> points) {
  const auto is_tiny = [](double x) { return x != 0 && std::abs(x) < least_coordinate; };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    if (!(std::abs(norm(p) - 1) <= max_deviation)) throw InvalidInput("no unit vector", i);
    if (is_tiny(p.x) || is_tiny(p.y) || is_tiny(p.z)) {
      throw InvalidInput("a coordinate is below 2^-150 and not 0", i);
    }
  }
}

// True if rounding may decide the direction of an arc.
inline bool are_opposite(const Point& p, const Point& q) {
  constexpr double least_distance = 0x1p-45;
  return norm(p + q) < least_distance;
}

// Throws InvalidInput with the position of an arc if rounding may decide its direction.
inline void validate_ends(const Point& p, const Point& q, std::size_t position) {
  if (are_opposite(p, q)) {
    throw InvalidInput("the ends of an arc are opposite to each other up to rounding", position);
  }
}

// Throws InvalidInput with the feature of a line if a point or an arc of it is not as described.
inline void validate_line_arcs(std::span<const Point> line, std::size_t feature) {
  try {
    validate_points(line);
    for (std::size_t k = 1; k < line.size(); ++k) validate_ends(line[k - 1], line[k], k);
  } catch (const InvalidInput& error) {
    throw InvalidInput(error.what(), feature);
  }
}

// Throws InvalidInput if the arrays of lines do not fit, or (the feature) a line has no point.
inline void validate_rows(const FeatureLines& lines) {
  if (!system::are_offsets(lines.rows.offsets, lines.rows.values.size()) ||
      !system::are_offsets(lines.offsets, lines.rows.size())) {
    throw InvalidInput("the arrays of the lines do not fit");
  }
  for (std::size_t f = 0; f < lines.size(); ++f) {
    for (std::uint64_t i = lines.offsets[f]; i < lines.offsets[f + 1]; ++i) {
      if (lines.rows[i].empty()) throw InvalidInput("a line has no point", f);
    }
  }
}

// Throws InvalidInput with the feature, counted from `first`, if lines are not as described.
inline void validate_lines(const FeatureLines& lines, std::size_t first) {
  validate_rows(lines);
  for (std::size_t f = 0; f < lines.size(); ++f) {
    for (std::uint64_t i = lines.offsets[f]; i < lines.offsets[f + 1]; ++i) {
      validate_line_arcs(lines.rows[i], first + f);
    }
  }
}

}  // namespace rondel::arrangement
