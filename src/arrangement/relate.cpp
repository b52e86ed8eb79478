// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// All points of both operands are numbered together, and each polygon is prepared once; then pairs
// are related (pair_relater.h), in a join those whose extents overlap.
#include "rondel/relate.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrangement/arc_checks.h"
#include "arrangement/pair_relater.h"
#include "arrangement/prepared_polygon.h"
#include "arrangement/ring_arrays.h"
#include "arrangement/snapping.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel {
namespace {

using arrangement::BoxTree;
using arrangement::PairRelater;
using arrangement::PolygonFault;
using arrangement::PreparedPolygon;

// Throws InvalidInput if the polygons of an operand are not as relate() wants them.
void validate_operand(const CellRings& cells) {
  arrangement::validate_rings(cells);
  arrangement::validate_points(cells.points);
  for (std::size_t r = 0; r + 1 < cells.rings.size(); ++r) {
    const std::span<const Index> ring = cells.corners_of(r);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      arrangement::validate_ends(cells.points[ring[k]],
                                 cells.points[ring[k + 1 == ring.size() ? 0 : k + 1]],
                                 cells.rings[r] + k);
    }
  }
}

std::vector<PreparedPolygon> prepared(const CellRings& cells, std::span<const Point> points,
                                      std::span<const Index> numbers, unsigned threads) {
  std::vector<PreparedPolygon> polygons(cells.num_cells());
  constexpr std::size_t grain = 16;
  system::parallel_for(threads, polygons.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) polygons[c] = {cells, c, points, numbers};
  });
  return polygons;
}

void throw_fault(std::span<const PreparedPolygon> polygons, const char* operand) {
  const auto text_of = [](PolygonFault fault) {
    switch (fault) {
      case PolygonFault::crossing_sides:
        return "has sides that cross each other";
      case PolygonFault::disagreeing_sides:
        return "has sides that disagree on where its interior is";
      default:
        return "has rings, but no sides: it may be empty or the whole sphere";
    }
  };
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (polygons[i].fault() == PolygonFault::none) continue;
    throw InvalidInput("polygon " + std::to_string(i) + " of the " + operand + " operand " +
                           text_of(polygons[i].fault()),
                       i);
  }
}

// The polygons of both operands.
class PreparedOperands {
 public:
  PreparedOperands(const CellRings& first, const CellRings& second, unsigned threads) {
    validate_operand(first);
    is_same_ = &first == &second;
    std::vector<Point> all = first.points;
    if (!is_same_) {
      validate_operand(second);
      all.insert(all.end(), second.points.begin(), second.points.end());
    }
    arrangement::NumberedPoints nodes = arrangement::numbered(all, 0, threads);
    points_ = std::move(nodes.points);
    const std::span<const Index> numbers = nodes.numbers;
    first_ = prepared(first, points_, numbers, threads);
    throw_fault(first_, "first");
    if (is_same_) return;
    second_ = prepared(second, points_, numbers.subspan(first.points.size()), threads);
    throw_fault(second_, "second");
  }
  [[nodiscard]] std::span<const Point> points() const { return points_; }
  [[nodiscard]] std::span<const PreparedPolygon> first() const { return first_; }
  [[nodiscard]] std::span<const PreparedPolygon> second() const {
    return is_same_ ? first_ : second_;
  }
  // True if both operands are one object.
  [[nodiscard]] bool are_same() const { return is_same_; }

 private:
  std::vector<Point> points_;
  std::vector<PreparedPolygon> first_;
  std::vector<PreparedPolygon> second_;
  bool is_same_ = false;
};

// Returns all pairs of polygons whose extents overlap, sorted; of one operand those of which the
// first is lower.
std::vector<std::array<Index, 2>> near_pairs(const PreparedOperands& operands, unsigned threads) {
  const std::span<const PreparedPolygon> second = operands.second();
  std::vector<Index> order;
  for (Index k = 0; k < second.size(); ++k) {
    if (!second[k].is_empty()) order.push_back(k);
  }
  // Nodes are numbered along the spatial order.
  std::ranges::sort(order, {}, [&](Index k) {
    const auto sides = second[k].sides();
    return std::tuple(sides.empty() ? Index{0} : sides[0].from, k);
  });
  std::vector<arrangement::SpaceBox> boxes;
  boxes.reserve(order.size());
  for (const Index k : order) boxes.push_back(second[k].extent());
  const BoxTree tree(std::move(boxes), threads);
  constexpr std::size_t grain = 64;
  const std::size_t num_first = operands.first().size();
  std::vector<std::vector<std::array<Index, 2>>> parts(system::num_pieces(num_first, grain));
  system::parallel_for(threads, num_first, grain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::array<Index, 2>>& part = parts[begin / grain];
    for (std::size_t i = begin; i < end; ++i) {
      tree.visit(operands.first()[i].extent(), [&](Index k) {
        if (operands.are_same() && order[k] <= i) return;
        part.push_back({static_cast<Index>(i), order[k]});
      });
    }
    std::ranges::sort(part);
  });
  std::vector<std::array<Index, 2>> pairs;
  for (const auto& part : parts) pairs.insert(pairs.end(), part.begin(), part.end());
  return pairs;
}

}  // namespace

std::vector<Relation> relate(const CellRings& first, const CellRings& second,
                             const Execution& execution) {
  const std::size_t num_first = first.num_cells();
  const std::size_t num_second = second.num_cells();
  if (num_first != num_second && num_first != 1 && num_second != 1) {
    throw InvalidInput("there are " + std::to_string(num_first) + " and " +
                       std::to_string(num_second) + " polygons, neither equally many nor one");
  }
  std::vector<std::array<Index, 2>> pairs(num_first == 1 ? num_second : num_first);
  for (Index i = 0; i < pairs.size(); ++i) {
    pairs[i] = {num_first == 1 ? 0 : i, num_second == 1 ? 0 : i};
  }
  return relate_pairs(first, second, pairs, execution);
}

std::vector<Relation> relate_pairs(const CellRings& first, const CellRings& second,
                                   std::span<const std::array<Index, 2>> pairs,
                                   const Execution& execution) {
  const system::Call call(execution);
  const PreparedOperands operands(first, second, execution.threads);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (pairs[p][0] >= first.num_cells() || pairs[p][1] >= second.num_cells()) {
      throw InvalidInput("a polygon of a pair does not exist", p);
    }
  }
  std::vector<Relation> result(pairs.size());
  constexpr std::size_t grain = 16;
  system::parallel_for(execution.threads, result.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         PairRelater relater(operands.points());
                         for (std::size_t p = begin; p < end; ++p) {
                           const auto [i, k] = pairs[p];
                           result[p] = relater(operands.first()[i], operands.second()[k]);
                         }
                       });
  return result;
}

std::vector<RelatedPair> related_pairs(const CellRings& first, const CellRings& second,
                                       SpatialPredicate predicate, const Execution& execution) {
  const system::Call call(execution);
  if (predicate == SpatialPredicate::disjoint) {
    throw InvalidInput("pairs of disjoint polygons are not listed");
  }
  const PreparedOperands operands(first, second, execution.threads);
  const auto pairs = near_pairs(operands, execution.threads);
  constexpr std::size_t grain = 64;
  std::vector<std::vector<RelatedPair>> parts(system::num_pieces(pairs.size(), grain));
  const auto append = [&](std::vector<RelatedPair>& part, const RelatedPair& pair) {
    if (pair.relation.is(predicate)) part.push_back(pair);
  };
  system::parallel_for(
      execution.threads, pairs.size(), grain, [&](std::size_t begin, std::size_t end) {
        PairRelater relater(operands.points());
        for (std::size_t p = begin; p < end; ++p) {
          const auto [i, k] = pairs[p];
          const Relation relation = relater(operands.first()[i], operands.second()[k]);
          append(parts[begin / grain], {i, k, relation});
          if (operands.are_same()) append(parts[begin / grain], {k, i, relation.transposed()});
        }
      });
  std::vector<RelatedPair> result;
  for (const auto& part : parts) result.insert(result.end(), part.begin(), part.end());
  if (!operands.are_same()) return result;
  for (Index i = 0; i < operands.first().size(); ++i) {
    const PreparedPolygon& polygon = operands.first()[i];
    if (!polygon.is_empty()) append(result, {i, i, PairRelater::of_itself(polygon)});
  }
  std::ranges::sort(result, {},
                    [](const RelatedPair& pair) { return std::pair(pair.first, pair.second); });
  return result;
}

}  // namespace rondel
