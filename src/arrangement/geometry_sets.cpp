// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The set operations on points, lines and polygons: regions with their lines (set_regions.h).
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/arc_checks.h"
#include "arrangement/ring_arrays.h"
#include "arrangement/set_regions.h"
#include "exact/angles.h"
#include "exact/eft.h"
#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/geometries.h"
#include "system/job.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using arrangement::joined_region;
using arrangement::RegionParts;

// Throws InvalidInput if the arrays of lines do not fit, or a line has no point.
void validate_rows(const FeatureLines& lines) {
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

// Throws InvalidInput with the geometry, counted from `first`, if it is not as described.
void validate_geometry(const FeatureLines& lines, std::size_t f, std::size_t first) {
  for (std::uint64_t i = lines.offsets[f]; i < lines.offsets[f + 1]; ++i) {
    arrangement::validate_line_arcs(lines.rows[i], first + f);
  }
}

void validate_arrays(const Geometries& geometries) {
  validate_rows(geometries.lines);
  arrangement::validate_rings(geometries.polygons);
  if (geometries.lines.size() != geometries.polygons.num_cells()) {
    throw InvalidInput("there are not as many cells as groups of lines");
  }
}

void append_lines(const FeatureLines& lines, std::size_t f, Index feature,
                  arrangement::Sides& sides) {
  for (std::uint64_t i = lines.offsets[f]; i < lines.offsets[f + 1]; ++i) {
    sides.append_line(lines.rows[i], feature);
  }
}

// Returns the sides and lines of all geometries of two operands.
arrangement::Sides sides_of_all(const Geometries& first, const Geometries& second) {
  validate_arrays(first);
  validate_arrays(second);
  for (std::size_t f = 0; f < first.size(); ++f) validate_geometry(first.lines, f, 0);
  for (std::size_t f = 0; f < second.size(); ++f) validate_geometry(second.lines, f, first.size());
  arrangement::Sides sides;
  sides.append(first.polygons, 0);
  sides.append(second.polygons, 1);
  const auto num_first = static_cast<Index>(first.size());
  for (Index f = 0; f < first.size(); ++f) append_lines(first.lines, f, f, sides);
  for (Index f = 0; f < second.size(); ++f) append_lines(second.lines, f, num_first + f, sides);
  return sides;
}

Geometries geometries_of(std::span<const arrangement::Region> regions) {
  Geometries result{{}, arrangement::cells_of(regions)};
  for (const arrangement::Region& region : regions) {
    for (const std::vector<Point>& line : region.lines) result.lines.rows.append(line);
    result.lines.end_group();
  }
  return result;
}

}  // namespace

Geometries combine(const Geometries& first, const Geometries& second, SetOperation operation,
                   const Execution& execution) {
  const system::Call call(execution);
  const arrangement::Sides sides = sides_of_all(first, second);
  return geometries_of(std::vector{joined_region(sides, operation, RegionParts::all, execution)});
}

Geometries unite(const Geometries& geometries, const Execution& execution) {
  return combine(geometries, {}, SetOperation::unite, execution);
}

Geometries combine_pairs(const Geometries& first, const Geometries& second,
                         std::span<const std::array<Index, 2>> pairs, SetOperation operation,
                         const Execution& execution) {
  const system::Call call(execution);
  validate_arrays(first);
  validate_arrays(second);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [a, b] = pairs[k];
    if (a >= first.size() || b >= second.size()) {
      throw InvalidInput("a geometry of a pair does not exist", k);
    }
  }
  return geometries_of(arrangement::joined_each(pairs.size(), operation, RegionParts::all,
                                                execution, [&](std::size_t k) {
                                                  const auto [a, b] = pairs[k];
                                                  arrangement::Sides sides;
                                                  sides.append_cell(first.polygons, a, 0);
                                                  sides.append_cell(second.polygons, b, 1);
                                                  append_lines(first.lines, a, 0, sides);
                                                  append_lines(second.lines, b, 1, sides);
                                                  return sides;
                                                }));
}

GeometryPieces overlay_pieces(const Geometries& first, const Geometries& second,
                              SetOperation operation, const Execution& execution) {
  const system::Call call(execution);
  const arrangement::Sides sides = sides_of_all(first, second);
  const std::vector<arrangement::Region> regions = arrangement::regions_of(
      sides, arrangement::RegionRule(operation, false), RegionParts::all, execution);
  GeometryPieces result{geometries_of(regions), {}, {}};
  const auto num_first = static_cast<Index>(first.size());
  for (const auto& [key, rings, is_whole, lines] : regions) {
    result.first.push_back(key.first);
    result.second.push_back(key.second == no_index ? no_index : key.second - num_first);
  }
  return result;
}

std::vector<double> lengths(const FeatureLines& lines) {
  const system::ArithmeticScope arithmetic;
  validate_rows(lines);
  std::vector<double> result;
  result.reserve(lines.size());
  for (std::size_t f = 0; f < lines.size(); ++f) {
    exact::DoubleDouble sum = {0, 0};
    for (std::uint64_t i = lines.offsets[f]; i < lines.offsets[f + 1]; ++i) {
      const std::span<const Point> line = lines.rows[i];
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        const Point& p = line[k];
        const Point& q = line[k + 1];
        exact::add_term(exact::argument(norm(cross(p, q - p)), dot(p, q)), sum);
      }
    }
    result.push_back(sum.hi + sum.lo);
  }
  return result;
}

}  // namespace rondel
