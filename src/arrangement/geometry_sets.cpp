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
#include "arrangement/pair_shortcuts.h"
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

void validate_arrays(const Geometries& geometries) {
  arrangement::validate_rows(geometries.lines);
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
  arrangement::validate_lines(first.lines, 0);
  arrangement::validate_lines(second.lines, first.size());
  arrangement::Sides sides;
  sides.append(first.polygons, 0);
  sides.append(second.polygons, 1);
  const auto num_first = static_cast<Index>(first.size());
  for (Index f = 0; f < first.size(); ++f) append_lines(first.lines, f, f, sides);
  for (Index f = 0; f < second.size(); ++f) append_lines(second.lines, f, num_first + f, sides);
  return sides;
}

// The dimension of a geometry without a place: more than that of any part.
constexpr int no_dimension = 3;

// Returns the dimension of the lowest part of a geometry.
int lowest_dimension(const Geometries& geometries, std::size_t g) {
  int lowest = no_dimension;
  for (std::uint64_t i = geometries.lines.offsets[g]; i < geometries.lines.offsets[g + 1]; ++i) {
    lowest = std::min(lowest, geometries.lines.rows[i].size() > 1 ? 1 : 0);
  }
  const CellRings& polygons = geometries.polygons;
  const bool has_polygon = polygons.cells[g] < polygons.cells[g + 1] || polygons.is_whole(g);
  return std::min(lowest, has_polygon ? 2 : no_dimension);
}

// Returns the dimension of the lowest part of all geometries.
int lowest_dimension(const Geometries& geometries) {
  int lowest = no_dimension;
  for (std::size_t g = 0; g < geometries.size(); ++g) {
    lowest = std::min(lowest, lowest_dimension(geometries, g));
  }
  return lowest;
}

// Appends the parts of a geometry that have a dimension or more. Returns whether there are any.
bool append_from(const Geometries& from, std::size_t g, int dimension, Geometries& to) {
  const std::size_t num_lines = to.lines.rows.size();
  for (std::uint64_t i = from.lines.offsets[g]; i < from.lines.offsets[g + 1]; ++i) {
    const std::span<const Point> line = from.lines.rows[i];
    if ((line.size() > 1 ? 1 : 0) >= dimension) to.lines.rows.append(line);
  }
  const CellRings& polygons = from.polygons;
  const bool is_whole = polygons.is_whole(g);
  const bool has_polygon = is_whole || polygons.cells[g] < polygons.cells[g + 1];
  if (!has_polygon && to.lines.rows.size() == num_lines) return false;
  for (std::uint64_t r = polygons.cells[g]; r < polygons.cells[g + 1]; ++r) {
    for (const Index corner : polygons.corners_of(r)) to.polygons.corners.push_back(corner);
    to.polygons.end_ring();
  }
  if (is_whole) to.polygons.whole.push_back(static_cast<Index>(to.polygons.num_cells()));
  to.polygons.end_cell();
  to.lines.end_group();
  return true;
}

Geometries geometries_of(std::span<const arrangement::Region> regions, unsigned threads) {
  Geometries result{{}, arrangement::cells_of(regions, threads)};
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
  return geometries_of(std::vector{joined_region(sides, operation, RegionParts::all, execution)},
                       execution.threads);
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
  const arrangement::PairShortcuts shortcuts(first.polygons, second.polygons, pairs, operation,
                                             execution.threads);
  const auto has_lines = [](const Geometries& geometries, std::size_t g) {
    return geometries.lines.offsets[g] < geometries.lines.offsets[g + 1];
  };
  return geometries_of(
      arrangement::joined_each(pairs.size(), operation, RegionParts::all, execution,
                               [&](std::size_t k) {
                                 const auto [a, b] = pairs[k];
                                 if (!has_lines(first, a) && !has_lines(second, b)) {
                                   return shortcuts.sides(k);
                                 }
                                 arrangement::Sides sides;
                                 sides.append_cell(first.polygons, a, 0);
                                 sides.append_cell(second.polygons, b, 1);
                                 append_lines(first.lines, a, 0, sides);
                                 append_lines(second.lines, b, 1, sides);
                                 return sides;
                               }),
      execution.threads);
}

GeometryPieces overlay_pieces(const Geometries& first, const Geometries& second,
                              SetOperation operation, const Execution& execution) {
  const system::Call call(execution);
  const arrangement::Sides sides = sides_of_all(first, second);
  const std::vector<arrangement::Region> regions = arrangement::regions_of(
      sides, arrangement::RegionRule(operation, false), RegionParts::all, execution);
  GeometryPieces result{geometries_of(regions, execution.threads), {}, {}};
  const auto num_first = static_cast<Index>(first.size());
  for (const auto& [key, rings, is_whole, lines] : regions) {
    result.first.push_back(key.first);
    result.second.push_back(key.second == no_index ? no_index : key.second - num_first);
  }
  return result;
}

GeometryPieces without_touching_parts(const GeometryPieces& pieces, const Geometries& first,
                                      const Geometries& second) {
  validate_arrays(pieces.pieces);
  validate_arrays(first);
  validate_arrays(second);
  const auto dimension_of = [](const Geometries& set, Index g) {
    if (g != no_index && g >= set.size()) throw InvalidInput("a geometry does not exist", g);
    return g == no_index ? no_dimension : lowest_dimension(set, g);
  };
  if (pieces.first.size() != pieces.pieces.size() || pieces.second.size() != pieces.first.size()) {
    throw InvalidInput("there are not as many geometries as pieces");
  }
  GeometryPieces result;
  result.pieces.polygons.points = pieces.pieces.polygons.points;
  for (std::size_t k = 0; k < pieces.first.size(); ++k) {
    const int dimension =
        std::min(dimension_of(first, pieces.first[k]), dimension_of(second, pieces.second[k]));
    if (!append_from(pieces.pieces, k, dimension, result.pieces)) continue;
    result.first.push_back(pieces.first[k]);
    result.second.push_back(pieces.second[k]);
  }
  return result;
}

Geometries without_touching_parts(const Geometries& combined, const Geometries& first,
                                  const Geometries& second) {
  validate_arrays(combined);
  validate_arrays(first);
  validate_arrays(second);
  Geometries result;
  result.polygons.points = combined.polygons.points;
  const int dimension = std::min(lowest_dimension(first), lowest_dimension(second));
  for (std::size_t g = 0; g < combined.size(); ++g) {
    if (append_from(combined, g, dimension, result)) continue;
    result.lines.end_group();
    result.polygons.end_cell();
  }
  return result;
}

std::vector<double> lengths(const FeatureLines& lines) {
  const system::ArithmeticScope arithmetic;
  arrangement::validate_rows(lines);
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
