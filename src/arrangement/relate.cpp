// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// All points of both operands are numbered together, and each geometry is prepared once; then pairs
// are related (pair_relater.h, line_relater.h), in a join those whose extents overlap.
#include "rondel/relate.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrangement/arc_checks.h"
#include "arrangement/arc_contacts.h"
#include "arrangement/line_relater.h"
#include "arrangement/numbering.h"
#include "arrangement/pair_relater.h"
#include "arrangement/prepared_lines.h"
#include "arrangement/prepared_polygon.h"
#include "arrangement/ring_arrays.h"
#include "rondel/compressed_rows.h"
#include "rondel/error.h"
#include "rondel/geometries.h"
#include "system/job.h"

namespace rondel {
namespace {

using arrangement::BoxTree;
using arrangement::LineRelater;
using arrangement::PairRelater;
using arrangement::PointNodes;
using arrangement::PolygonFault;
using arrangement::PreparedLines;
using arrangement::PreparedPolygon;
using arrangement::SpaceBox;

// Geometries of an operand, or polygons alone.
struct Operand {
  const FeatureLines* lines;  // null: there are none
  const CellRings& polygons;

  [[nodiscard]] std::size_t size() const { return polygons.num_cells(); }
  friend bool operator==(const Operand& a, const Operand& b) {
    return a.lines == b.lines && &a.polygons == &b.polygons;
  }
};

Operand operand_of(const CellRings& polygons) { return {nullptr, polygons}; }
Operand operand_of(const Geometries& geometries) {
  return {&geometries.lines, geometries.polygons};
}

// Returns the first polygon that has a point, or no_index.
Index polygon_with(const CellRings& cells, std::size_t point) {
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    const std::uint64_t end = cells.rings[cells.cells[i + 1]];
    for (std::uint64_t k = cells.rings[cells.cells[i]]; k < end; ++k) {
      if (cells.corners[k] == point) return static_cast<Index>(i);
    }
  }
  return no_index;
}

// Throws InvalidInput with the polygon that has a bad point, or with the point if none has it.
void validate_corners(const CellRings& cells, const char* name) {
  try {
    arrangement::validate_points(cells.points);
  } catch (const InvalidInput& error) {
    const Index polygon = polygon_with(cells, error.index());
    if (polygon == no_index) throw;
    throw InvalidInput("polygon " + std::to_string(polygon) + " of the " + name +
                           " operand, point " + std::to_string(error.index()) + ": " + error.what(),
                       polygon);
  }
}

// Throws InvalidInput if an operand is not as relate() wants it: with a polygon or line.
void validate_operand(const Operand& operand, const char* name) {
  const CellRings& cells = operand.polygons;
  arrangement::validate_rings(cells);
  validate_corners(cells, name);
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    for (std::uint64_t r = cells.cells[i]; r < cells.cells[i + 1]; ++r) {
      const std::span<const Index> ring = cells.corners_of(r);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point& to = cells.points[ring[k + 1 == ring.size() ? 0 : k + 1]];
        if (!arrangement::are_opposite(cells.points[ring[k]], to)) continue;
        throw InvalidInput("polygon " + std::to_string(i) + " of the " + name +
                               " operand has a side that leads to the opposite point",
                           i);
      }
    }
  }
  if (operand.lines == nullptr) return;
  arrangement::validate_lines(*operand.lines, 0);
  if (operand.lines->size() != cells.num_cells()) {
    throw InvalidInput("there are not as many cells as groups of lines");
  }
}

const char* text_of(PolygonFault fault) {
  switch (fault) {
    case PolygonFault::crossing_sides:
      return "has sides that cross each other";
    case PolygonFault::disagreeing_sides:
      return "has sides that disagree on where its interior is";
    default:
      return "has rings, but no sides: it may be empty or the whole sphere";
  }
}

// The geometries of an operand, each of one dimension.
class PreparedGeometries {
 public:
  PreparedGeometries() = default;
  // `numbers` has the nodes of the points of polygons, and then of lines.
  PreparedGeometries(const Operand& operand, const char* name, std::span<const Point> points,
                     std::span<const Index> numbers, unsigned threads)
      : points_(points) {
    find_kinds(operand, name);
    prepare(operand, numbers, threads);
    throw_fault(name);
  }

  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] bool is_empty(std::size_t i) const {
    return items_[i].kind == GeometryKind::polygon && polygons_[items_[i].slot].is_empty();
  }
  [[nodiscard]] SpaceBox extent(std::size_t i) const {
    const Item& item = items_[i];
    if (item.kind == GeometryKind::polygon) return polygons_[item.slot].extent();
    if (item.kind == GeometryKind::line) return lines_[item.slot].extent();
    SpaceBox box = arrangement::empty_box;
    for (const Index node : nodes(item)) {
      box.include(arrangement::box_of(points_[node], points_[node]));
    }
    return box;
  }
  // Returns the first node of a geometry along the spatial order, or one near to it.
  [[nodiscard]] Index first_node(std::size_t i) const {
    const Item& item = items_[i];
    if (item.kind == GeometryKind::points) return nodes(item).front();
    const auto sides =
        item.kind == GeometryKind::line ? lines_[item.slot].sides() : polygons_[item.slot].sides();
    return sides.empty() ? 0 : sides[0].from;
  }

  // Returns the relation of geometry i to geometry k of another operand.
  [[nodiscard]] Relation relation(std::size_t i, const PreparedGeometries& others, std::size_t k,
                                  PairRelater& polygons, LineRelater& lines) const {
    const Item& a = items_[i];
    const Item& b = others.items_[k];
    if (a.kind > b.kind) return others.relation(k, *this, i, polygons, lines).transposed();
    if (a.kind == GeometryKind::polygon) {
      return this == &others && i == k ? PairRelater::of_itself(polygons_[a.slot])
                                       : polygons(polygons_[a.slot], others.polygons_[b.slot]);
    }
    const auto with = [&](const auto& one) {
      if (b.kind == GeometryKind::polygon) return lines.relate(one, others.polygons_[b.slot]);
      return lines.relate(one, others.lines_[b.slot]);
    };
    if (a.kind == GeometryKind::line) return with(lines_[a.slot]);
    return b.kind == GeometryKind::points ? LineRelater::relate(nodes(a), others.nodes(b))
                                          : with(nodes(a));
  }

 private:
  enum class GeometryKind : std::uint8_t { points, line, polygon };
  struct Item {
    GeometryKind kind = GeometryKind::polygon;
    Index slot = 0;  // among the geometries of this kind
  };

  [[nodiscard]] PointNodes nodes(const Item& item) const { return nodes_[item.slot]; }

  // Throws InvalidInput for a geometry of several dimensions.
  void find_kinds(const Operand& operand, const char* name) {
    items_.resize(operand.size());
    for (std::size_t i = 0; i < items_.size(); ++i) {
      std::array<bool, 3> has = {};
      if (operand.lines != nullptr) {
        const FeatureLines& lines = *operand.lines;
        for (std::uint64_t k = lines.offsets[i]; k < lines.offsets[i + 1]; ++k) {
          has[lines.rows[k].size() > 1 ? 1 : 0] = true;
        }
      }
      const CellRings& cells = operand.polygons;
      has[2] = cells.rings[cells.cells[i]] < cells.rings[cells.cells[i + 1]] || cells.is_whole(i);
      if (has[0] + has[1] + has[2] > 1) {
        throw InvalidInput("geometry " + std::to_string(i) + " of the " + name +
                               " operand has parts of several dimensions, each of which has "
                               "relations of its own",
                           i);
      }
      items_[i].kind = has[0]   ? GeometryKind::points
                       : has[1] ? GeometryKind::line
                                : GeometryKind::polygon;
    }
  }

  void prepare(const Operand& operand, std::span<const Index> numbers, unsigned threads) {
    const std::span<const Index> of_lines = numbers.subspan(operand.polygons.points.size());
    std::array<Index, 3> counts = {};
    for (std::size_t i = 0; i < items_.size(); ++i) {
      items_[i].slot = counts[static_cast<std::size_t>(items_[i].kind)]++;
      if (items_[i].kind != GeometryKind::points) continue;
      const FeatureLines& lines = *operand.lines;
      const auto begin = lines.rows.offsets[lines.offsets[i]];
      const auto end = lines.rows.offsets[lines.offsets[i + 1]];
      std::vector<Index> places(of_lines.begin() + static_cast<std::ptrdiff_t>(begin),
                                of_lines.begin() + static_cast<std::ptrdiff_t>(end));
      std::ranges::sort(places);
      places.erase(std::unique(places.begin(), places.end()), places.end());
      nodes_.append(places);
    }
    lines_.resize(counts[1]);
    polygons_.resize(counts[2]);
    constexpr std::size_t grain = 16;
    system::parallel_for(threads, items_.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto [kind, slot] = items_[i];
        if (kind == GeometryKind::line) lines_[slot] = {*operand.lines, i, points_, of_lines};
        if (kind == GeometryKind::polygon)
          polygons_[slot] = {operand.polygons, i, points_, numbers};
      }
    });
  }

  void throw_fault(const char* name) const {
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (items_[i].kind != GeometryKind::polygon) continue;
      const PolygonFault fault = polygons_[items_[i].slot].fault();
      if (fault == PolygonFault::none) continue;
      throw InvalidInput(
          "polygon " + std::to_string(i) + " of the " + name + " operand " + text_of(fault), i);
    }
  }

  std::span<const Point> points_;
  std::vector<Item> items_;
  std::vector<PreparedPolygon> polygons_;
  std::vector<PreparedLines> lines_;
  CompressedRows<Index> nodes_;  // of geometries of points
};

// The geometries of both operands.
class PreparedOperands {
 public:
  PreparedOperands(const Operand& first, const Operand& second, unsigned threads)
      : is_same_(first == second) {
    std::vector<Point> all;
    const auto append = [&](const Operand& operand, const char* name) {
      validate_operand(operand, name);
      all.insert(all.end(), operand.polygons.points.begin(), operand.polygons.points.end());
      if (operand.lines == nullptr) return;
      const std::vector<Point>& points = operand.lines->rows.values;
      all.insert(all.end(), points.begin(), points.end());
    };
    append(first, "first");
    const std::size_t num_first = all.size();
    if (!is_same_) append(second, "second");
    arrangement::NumberedPoints nodes = arrangement::numbered(all, 0, threads);
    points_ = std::move(nodes.points);
    const std::span<const Index> numbers = nodes.numbers;
    first_ = {first, "first", points_, numbers, threads};
    if (!is_same_) second_ = {second, "second", points_, numbers.subspan(num_first), threads};
  }
  [[nodiscard]] std::span<const Point> points() const { return points_; }
  [[nodiscard]] const PreparedGeometries& first() const { return first_; }
  [[nodiscard]] const PreparedGeometries& second() const { return is_same_ ? first_ : second_; }
  // True if both operands are one object.
  [[nodiscard]] bool are_same() const { return is_same_; }

 private:
  std::vector<Point> points_;
  PreparedGeometries first_;
  PreparedGeometries second_;
  bool is_same_;
};

// Relates geometries of two operands, for one thread.
class Relater {
 public:
  explicit Relater(const PreparedOperands& operands)
      : operands_(operands), polygons_(operands.points()), lines_(operands.points()) {}
  Relation operator()(std::size_t i, std::size_t k) {
    return operands_.first().relation(i, operands_.second(), k, polygons_, lines_);
  }

 private:
  const PreparedOperands& operands_;
  PairRelater polygons_;
  LineRelater lines_;
};

// Returns all pairs of geometries whose extents overlap, sorted; of one operand those of which the
// first is lower.
std::vector<std::array<Index, 2>> near_pairs(const PreparedOperands& operands, unsigned threads) {
  const PreparedGeometries& second = operands.second();
  std::vector<Index> order;
  for (Index k = 0; k < second.size(); ++k) {
    if (!second.is_empty(k)) order.push_back(k);
  }
  // Nodes are numbered along the spatial order.
  std::ranges::sort(order, {}, [&](Index k) { return std::tuple(second.first_node(k), k); });
  std::vector<SpaceBox> boxes;
  boxes.reserve(order.size());
  for (const Index k : order) boxes.push_back(second.extent(k));
  const BoxTree tree(boxes, threads);
  constexpr std::size_t grain = 64;
  const std::size_t num_first = operands.first().size();
  std::vector<std::vector<std::array<Index, 2>>> parts(system::num_pieces(num_first, grain));
  system::parallel_for(threads, num_first, grain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::array<Index, 2>>& part = parts[begin / grain];
    for (std::size_t i = begin; i < end; ++i) {
      tree.visit(operands.first().extent(i), [&](Index k) {
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

// Returns the pairs of relate(): geometry i of both, or one of them with all of the other operand.
std::vector<std::array<Index, 2>> rows_of(std::size_t num_first, std::size_t num_second) {
  if (num_first != num_second && num_first != 1 && num_second != 1) {
    throw InvalidInput("there are " + std::to_string(num_first) + " and " +
                       std::to_string(num_second) + " polygons, neither equally many nor one");
  }
  std::vector<std::array<Index, 2>> pairs(num_first == 1 ? num_second : num_first);
  for (Index i = 0; i < pairs.size(); ++i) {
    pairs[i] = {num_first == 1 ? 0 : i, num_second == 1 ? 0 : i};
  }
  return pairs;
}

std::vector<Relation> relations_of(const Operand& first, const Operand& second,
                                   std::span<const std::array<Index, 2>> pairs,
                                   const Execution& execution) {
  const system::Call call(execution);
  const PreparedOperands operands(first, second, execution.threads);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (pairs[p][0] >= first.size() || pairs[p][1] >= second.size()) {
      throw InvalidInput("a polygon of a pair does not exist", p);
    }
  }
  std::vector<Relation> result(pairs.size());
  constexpr std::size_t grain = 16;
  system::parallel_for(execution.threads, result.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         Relater relation(operands);
                         for (std::size_t p = begin; p < end; ++p) {
                           result[p] = relation(pairs[p][0], pairs[p][1]);
                         }
                       });
  return result;
}

std::vector<RelatedPair> pairs_of(const Operand& first, const Operand& second,
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
  system::parallel_for(execution.threads, pairs.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         Relater related(operands);
                         for (std::size_t p = begin; p < end; ++p) {
                           const auto [i, k] = pairs[p];
                           const Relation relation = related(i, k);
                           append(parts[begin / grain], {i, k, relation});
                           if (operands.are_same())
                             append(parts[begin / grain], {k, i, relation.transposed()});
                         }
                       });
  std::vector<RelatedPair> result;
  for (const auto& part : parts) result.insert(result.end(), part.begin(), part.end());
  if (!operands.are_same()) return result;
  Relater related(operands);
  for (Index i = 0; i < operands.first().size(); ++i) {
    if (!operands.first().is_empty(i)) append(result, {i, i, related(i, i)});
  }
  std::ranges::sort(result, {},
                    [](const RelatedPair& pair) { return std::pair(pair.first, pair.second); });
  return result;
}

}  // namespace

std::vector<Relation> relate(const CellRings& first, const CellRings& second,
                             const Execution& execution) {
  return relations_of(operand_of(first), operand_of(second),
                      rows_of(first.num_cells(), second.num_cells()), execution);
}

std::vector<Relation> relate(const Geometries& first, const Geometries& second,
                             const Execution& execution) {
  return relations_of(operand_of(first), operand_of(second), rows_of(first.size(), second.size()),
                      execution);
}

std::vector<Relation> relate_pairs(const CellRings& first, const CellRings& second,
                                   std::span<const std::array<Index, 2>> pairs,
                                   const Execution& execution) {
  return relations_of(operand_of(first), operand_of(second), pairs, execution);
}

std::vector<Relation> relate_pairs(const Geometries& first, const Geometries& second,
                                   std::span<const std::array<Index, 2>> pairs,
                                   const Execution& execution) {
  return relations_of(operand_of(first), operand_of(second), pairs, execution);
}

std::vector<RelatedPair> related_pairs(const CellRings& first, const CellRings& second,
                                       SpatialPredicate predicate, const Execution& execution) {
  return pairs_of(operand_of(first), operand_of(second), predicate, execution);
}

std::vector<RelatedPair> related_pairs(const Geometries& first, const Geometries& second,
                                       SpatialPredicate predicate, const Execution& execution) {
  return pairs_of(operand_of(first), operand_of(second), predicate, execution);
}

}  // namespace rondel
