// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A polygon whose sides hang together is connected, and so is in one face of another polygon if no
// side of that has a box that overlaps a box around the interior of the first one. Boxes of sides
// contain what is near to them, so that the sides of the two polygons do not bend each other.
#include "arrangement/pair_shortcuts.h"

#include <utility>

#include "arrangement/arc_checks.h"
#include "arrangement/combined_each.h"
#include "arrangement/numbering.h"
#include "arrangement/prepared_polygon.h"
#include "rondel/error.h"
#include "system/parallel.h"

namespace rondel::arrangement {
namespace {

std::size_t num_corners(const CellRings& cells, std::size_t cell) {
  return cells.rings[cells.cells[cell + 1]] - cells.rings[cells.cells[cell]];
}

// True if arrange() takes the sides of a polygon.
bool are_sides_valid(const CellRings& polygon) {
  try {
    validate_points(polygon.points);
    for (std::size_t r = 0; r + 1 < polygon.rings.size(); ++r) {
      const std::span<const Index> corners = polygon.corners_of(r);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const Index next = corners[k + 1 < corners.size() ? k + 1 : 0];
        validate_ends(polygon.points[corners[k]], polygon.points[next], k);
      }
    }
  } catch (const InvalidInput&) {
    return false;
  }
  return true;
}

}  // namespace

// A prepared polygon with nodes of its own.
class LonePolygon {
 public:
  LonePolygon(const CellRings& cells, std::size_t cell)
      : corners_(extracted(cells, cell, cell + 1)), is_valid_(are_sides_valid(corners_)) {
    if (!is_valid_) return;
    nodes_ = numbered(corners_.points, 0, 1);
    polygon_ = PreparedPolygon(corners_, 0, nodes_.points, nodes_.numbers);
  }

  // True if set operations take the polygon as it is.
  [[nodiscard]] bool is_valid() const {
    return is_valid_ && polygon_.fault() == PolygonFault::none;
  }
  [[nodiscard]] const PreparedPolygon& polygon() const { return polygon_; }
  // Returns a point on the border.
  [[nodiscard]] const Point& border_point() const {
    return nodes_.points[polygon_.sides().front().from];
  }

 private:
  CellRings corners_;
  bool is_valid_;
  NumberedPoints nodes_;
  PreparedPolygon polygon_;
};

PairShortcuts::PairShortcuts(const CellRings& first, const CellRings& second,
                             std::span<const std::array<Index, 2>> pairs, SetOperation operation,
                             unsigned threads)
    : operands_{&first, &second}, pairs_(pairs), operation_(operation) {
  // Other operations return the sides of the large polygon, or what is left of it.
  if (operation == SetOperation::intersection) prepare(0, threads);
  if (operation == SetOperation::intersection || operation == SetOperation::difference) {
    prepare(1, threads);
  }
}

PairShortcuts::~PairShortcuts() = default;

void PairShortcuts::prepare(std::size_t operand, unsigned threads) {
  // To prepare a polygon takes as long as a few arrangements of it.
  constexpr std::size_t least_corners = 64;
  constexpr std::size_t least_pairs = 8;
  const CellRings& cells = *operands_[operand];
  LargePolygons& large = large_[operand];
  large.resize(cells.num_cells());
  std::vector<std::size_t> counts(cells.num_cells(), 0);
  std::vector<Index> wanted;
  for (const std::array<Index, 2>& pair : pairs_) {
    const Index cell = pair[operand];
    if (++counts[cell] == least_pairs && num_corners(cells, cell) >= least_corners) {
      wanted.push_back(cell);
    }
  }
  system::parallel_for(threads, wanted.size(), 1, [&](std::size_t k, std::size_t /*end*/) {
    auto polygon = std::make_unique<LonePolygon>(cells, wanted[k]);
    // A polygon with a fault is left to the operation.
    if (polygon->is_valid()) large[wanted[k]] = std::move(polygon);
  });
}

Sides PairShortcuts::sides(std::size_t pair) const {
  for (const std::size_t operand : {std::size_t{0}, std::size_t{1}}) {
    if (std::optional<Sides> fewer = sides_of_small(pair, operand)) return *std::move(fewer);
  }
  Sides sides;
  sides.append_cell(*operands_[0], pairs_[pair][0], 0);
  sides.append_cell(*operands_[1], pairs_[pair][1], 1);
  return sides;
}

std::optional<Sides> PairShortcuts::sides_of_small(std::size_t pair, std::size_t operand) const {
  const LargePolygons& others = large_[1 - operand];
  const LonePolygon* const other =
      others.empty() ? nullptr : others[pairs_[pair][1 - operand]].get();
  if (other == nullptr) return std::nullopt;
  const CellRings& cells = *operands_[operand];
  const Index cell = pairs_[pair][operand];
  // It takes longer to prepare a polygon than to arrange a few times as many sides.
  constexpr std::size_t least_ratio = 8;
  const std::size_t size = num_corners(cells, cell);
  if (size * least_ratio > num_corners(*operands_[1 - operand], pairs_[pair][1 - operand])) {
    return std::nullopt;
  }
  const LonePolygon small(cells, cell);
  if (!small.is_valid() || small.polygon().num_components() != 1) return std::nullopt;
  bool is_far = true;
  other->polygon().boxes().visit(small.polygon().extent(), [&](Index) { is_far = false; });
  if (!is_far) return std::nullopt;
  const bool is_inside = other->polygon().has(small.border_point());
  Sides sides;
  if (is_inside != (operation_ == SetOperation::intersection)) return sides;
  sides.append_cell(cells, cell, 0);
  // The intersection with the large polygon is that with itself.
  if (operation_ == SetOperation::intersection) sides.append_cell(cells, cell, 1);
  return sides;
}

}  // namespace rondel::arrangement
