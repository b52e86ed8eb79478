// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Pieces along the borders of a feature are united: some consecutive ones, then some of these unions,
// until one is left. So places deep inside of a buffer are left behind early, and the work grows with
// the length of a border, not with its square. The last step unites it with the polygon itself, or
// takes it away. Unions overlap, because each of them rounds crossings and bends its sides by that.
#include "rondel/buffer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/buffer_pieces.h"
#include "arrangement/combined_each.h"
#include "exact/vector.h"
#include "rondel/compressed_rows.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "rondel/set_operations.h"
#include "system/job.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using arrangement::BufferLoop;
using arrangement::BufferPieces;

// The borders of all features.
struct BufferLoops {
  CompressedRows<Point> points;
  std::vector<std::uint8_t> are_lines;
  std::vector<std::size_t> features;  // of each loop, never decreasing

  [[nodiscard]] BufferLoop operator[](std::size_t i) const {
    return {points[i], are_lines[i] != 0};
  }
  void end(bool is_line, std::size_t feature) {
    points.end_row();
    are_lines.push_back(is_line ? 1 : 0);
    features.push_back(feature);
  }
};

// Throws InvalidInput unless points of lines are unit vectors, and neighbors not opposite.
void validate_line(std::span<const Point> line, std::size_t feature) {
  constexpr double max_deviation = 1e-14;
  constexpr double least_distance = 0x1p-45;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (!(std::abs(norm(line[k]) - 1) <= max_deviation)) {
      throw InvalidInput("a point is no unit vector", feature);
    }
    if (k > 0 && norm(line[k - 1] + line[k]) < least_distance) {
      throw InvalidInput("neighbors in a line are opposite to each other", feature);
    }
  }
}

// Appends points to a loop, without those within a distance of the one before, and without
// coordinates that might be too small for arrange(). A line that leaves out such points is at most
// twice as far from the given one, as its sides are no longer than 120 degrees there.
void append_points(std::span<const Point> line, bool is_closed, double least_length,
                   std::vector<Point>& points) {
  constexpr double least = 0x1p-120;
  const auto flushed = [](double x) { return std::abs(x) < least ? 0 : x; };
  const auto is_near = [&](const Point& p, const Point& q) {
    return norm(p - q) < least_length || is_same_site(p, q);
  };
  const std::size_t first = points.size();
  for (std::size_t k = 0; k < line.size(); ++k) {
    const bool is_last = k + 1 == line.size();
    const Point& next = line[is_last ? 0 : k + 1];
    if (points.size() > first && is_near(points.back(), line[k])) {
      const bool has_next = !is_last || is_closed;
      if (!has_next || dot(points.back(), next) > -0.5) continue;
      if (is_same_site(points.back(), line[k])) continue;
    }
    points.push_back({flushed(line[k].x), flushed(line[k].y), flushed(line[k].z)});
  }
  while (is_closed && points.size() > first + 1 && is_near(points.back(), points[first]) &&
         dot(points[points.size() - 2], points[first]) > -0.5) {
    points.pop_back();
  }
}

// Appends a line as a loop there and back.
void append_line(std::span<const Point> line, double least_length, std::size_t feature,
                 BufferLoops& loops) {
  if (line.empty()) return;
  std::vector<Point>& points = loops.points.values;
  const std::size_t first = points.size();
  append_points(line, false, least_length, points);
  for (std::size_t k = points.size() - 1; k-- > first + 1;) {
    const Point back = points[k];
    points.push_back(back);
  }
  loops.end(points.size() > first + 1, feature);
}

// Appends the rings of a cell, with the side to which the buffer extends to the right.
void append_border(const CellRings& cells, std::size_t cell, bool is_inside, double least_length,
                   BufferLoops& loops) {
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    std::vector<Point> ring;
    for (const Index p : cells.corners_of(r)) ring.push_back(cells.points[p]);
    if (is_inside) std::ranges::reverse(ring);
    append_points(ring, true, least_length, loops.points.values);
    loops.end(false, cell);
  }
}

// Some consecutive pieces of a loop.
struct PieceRange {
  std::size_t loop;
  std::size_t begin;
  std::size_t end;
};

// Returns the union of the pieces of each feature that has any, and the features.
struct BorderBuffers {
  CellRings cells;
  std::vector<std::size_t> features;
};

BorderBuffers first_unions(const BufferLoops& loops, const BufferPieces& pieces,
                           const Execution& execution) {
  constexpr std::size_t max_pieces = 16;
  std::vector<PieceRange> ranges;
  BorderBuffers result;
  for (std::size_t i = 0; i < loops.features.size(); ++i) {
    const std::size_t count = pieces.count(loops[i]);
    for (std::size_t begin = 0; begin < count; begin += max_pieces) {
      const std::size_t end = std::min(count, begin + max_pieces);
      ranges.push_back({i, begin, count > max_pieces ? end + pieces.overlap(loops[i]) : end});
      result.features.push_back(loops.features[i]);
    }
  }
  const auto operands_of = [&](std::size_t i) {
    arrangement::Operands operands;
    for (std::size_t k = ranges[i].begin; k < ranges[i].end; ++k) {
      pieces.append(loops[ranges[i].loop], k, operands.first);
    }
    return operands;
  };
  result.cells =
      arrangement::combined_each(ranges.size(), operands_of, SetOperation::unite, execution);
  return result;
}

// Unites some consecutive cells of each feature. Returns false if each feature has one cell.
bool unite_neighbors(BorderBuffers& buffers, const Execution& execution) {
  constexpr std::size_t max_cells = 8;
  const std::vector<std::size_t>& features = buffers.features;
  std::vector<std::size_t> begins;
  std::vector<std::size_t> next_features;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (i > 0 && features[i] == features[i - 1] && i - begins.back() < max_cells) continue;
    begins.push_back(i);
    next_features.push_back(features[i]);
  }
  if (begins.size() == features.size()) return false;
  begins.push_back(features.size());
  const auto operands_of = [&](std::size_t i) {
    return arrangement::Operands{arrangement::extracted(buffers.cells, begins[i], begins[i + 1]),
                                 {}};
  };
  buffers.cells =
      arrangement::combined_each(next_features.size(), operands_of, SetOperation::unite, execution);
  buffers.features = std::move(next_features);
  return true;
}

double tolerance_of(const BufferOptions& options) {
  const double distance = std::abs(options.distance);
  const double wanted = options.tolerance == 0 ? distance / 1000 : options.tolerance;
  return std::min(std::max({wanted, 0x1p-48, 0x1p-30 * distance}), distance / 2);
}

void validate_buffer(const FeatureLines& lines, const CellRings& polygons,
                     const BufferOptions& options) {
  if (!system::are_offsets(lines.offsets, lines.rows.size()) ||
      !system::are_offsets(lines.rows.offsets, lines.rows.values.size())) {
    throw InvalidInput("the arrays of the lines do not fit");
  }
  if (polygons.cells.empty() ||
      (polygons.num_cells() != 0 && polygons.num_cells() != lines.size())) {
    throw InvalidInput("there is not one polygon for each feature");
  }
  if (!std::isfinite(options.distance)) throw InvalidInput("the distance is not a finite number");
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance)) {
    throw InvalidInput("the tolerance is negative or not a finite number");
  }
  for (std::size_t f = 0; f < lines.size(); ++f) {
    for (std::uint64_t i = lines.offsets[f]; i < lines.offsets[f + 1]; ++i) {
      validate_line(lines.rows[i], f);
    }
  }
}

// Returns the borders of the features to which a buffer extends.
BufferLoops loops_of(const FeatureLines& lines, const CellRings& polygons, bool is_inside,
                     double least_length) {
  BufferLoops loops;
  for (std::size_t f = 0; f < lines.size(); ++f) {
    append_border(polygons, f, is_inside, least_length, loops);
    if (is_inside) continue;
    for (std::uint64_t i = lines.offsets[f]; i < lines.offsets[f + 1]; ++i) {
      append_line(lines.rows[i], least_length, f, loops);
    }
  }
  return loops;
}

}  // namespace

CellRings buffered(const FeatureLines& lines, const CellRings& polygons,
                   const BufferOptions& options, const Execution& execution) {
  const system::Call call(execution);
  validate_buffer(lines, polygons, options);
  CellRings sound = repaired(polygons, execution);
  while (sound.num_cells() < lines.size()) sound.end_cell();
  constexpr double least_distance = 0x1p-44;
  if (std::abs(options.distance) < least_distance) return sound;
  const bool is_inside = options.distance < 0;
  // A 16th of the tolerance is for points of borders that are near to each other, and 2^-49 for what
  // rounding of corners and repeated arrangements may add.
  const double tolerance = tolerance_of(options);
  const BufferLoops loops = loops_of(lines, sound, is_inside, tolerance / 32);
  const BufferPieces pieces(std::abs(options.distance), tolerance * (15.0 / 16) - 0x1p-49);
  BorderBuffers buffers = first_unions(loops, pieces, execution);
  while (unite_neighbors(buffers, execution)) {
  }
  const auto operands_of = [&](std::size_t f) {
    arrangement::Operands operands = {arrangement::extracted(sound, f, f + 1), {}};
    const auto place = std::ranges::lower_bound(buffers.features, f);
    if (place != buffers.features.end() && *place == f) {
      const auto i = static_cast<std::size_t>(place - buffers.features.begin());
      operands.second = arrangement::extracted(buffers.cells, i, i + 1);
    }
    return operands;
  };
  return arrangement::combined_each(lines.size(), operands_of,
                                    is_inside ? SetOperation::difference : SetOperation::unite,
                                    execution);
}

CellRings buffered(const CellRings& polygons, const BufferOptions& options,
                   const Execution& execution) {
  FeatureLines lines;
  lines.offsets.resize(std::max<std::size_t>(1, polygons.cells.size()), 0);
  return buffered(lines, polygons, options, execution);
}

CellRings buffered(std::span<const Point> points, const BufferOptions& options,
                   const Execution& execution) {
  FeatureLines lines;
  for (const Point& p : points) {
    lines.rows.append(std::span(&p, 1));
    lines.end_group();
  }
  return buffered(lines, {}, options, execution);
}

}  // namespace rondel
