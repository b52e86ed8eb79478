// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sides of two polygons that do not cross run inside, outside or along each other between the nodes
// where they meet. Which of these occur gives the matrix. At a node the directions of the sides show
// it; components that meet no side of the other polygon are inside or outside as one of their nodes
// is.
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
#include "arrangement/directions.h"
#include "arrangement/prepared_polygon.h"
#include "arrangement/ring_arrays.h"
#include "arrangement/side_meeting.h"
#include "arrangement/snapping.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel {
namespace {

using arrangement::BoxTree;
using arrangement::PolygonFault;
using arrangement::PolygonSide;
using arrangement::PreparedPolygon;
using arrangement::SideDirection;

// What occurs of two polygons A and B.
struct SideFacts {
  std::array<bool, 2> are_inside{};   // sides of A in the interior of B; of B in that of A
  std::array<bool, 2> are_outside{};  // sides of A in the exterior of B; of B in that of A
  bool are_along = false;             // sides of both along each other, interiors on the same side
  bool are_against = false;           // the same, interiors on different sides
  bool do_meet = false;               // places on the sides of both
};

// Each region that two polygons divide the sphere into is to the left or the right of a side, if
// there is one.
Relation relation_of(const PreparedPolygon& a, const PreparedPolygon& b, const SideFacts& facts) {
  const auto entry = [](bool exists, char dimension) { return exists ? dimension : 'F'; };
  const auto [a_in, b_in] = facts.are_inside;
  const auto [a_out, b_out] = facts.are_outside;
  const bool are_shared = facts.are_along || facts.are_against;
  return {{entry(a_in || b_in || facts.are_along || (a.is_whole() && b.is_whole()), '2'),
           entry(b_in, '1'),
           entry(a_out || b_in || facts.are_against || (a.is_whole() && b.is_empty()), '2'),
           entry(a_in, '1'), entry(facts.do_meet || are_shared, are_shared ? '1' : '0'),
           entry(a_out, '1'),
           entry(b_out || a_in || facts.are_against || (b.is_whole() && a.is_empty()), '2'),
           entry(b_out, '1'),
           entry(a_out || b_out || facts.are_along || (a.is_empty() && b.is_empty()), '2')}};
}

// Relates polygons, one pair after the other.
class PairRelater {
 public:
  explicit PairRelater(std::span<const Point> points) : points_(points) {}

  Relation operator()(const PreparedPolygon& a, const PreparedPolygon& b) {
    polygons_ = {&a, &b};
    facts_ = {};
    incidences_.clear();
    if (a.extent().overlaps(b.extent())) {
      find_meetings();
      look_around_nodes();
    }
    for (const std::size_t k : {0U, 1U}) locate_components(k);
    return relation_of(a, b, facts_);
  }

 private:
  // A side that has a node where sides of both polygons meet, at an end or in its inside.
  struct Incidence {
    Index node;
    Index polygon;  // 0: of A; 1: of B
    Index side;
    friend auto operator<=>(const Incidence&, const Incidence&) = default;
  };

  [[nodiscard]] const PolygonSide& side(const Incidence& i) const {
    return polygons_[i.polygon]->sides()[i.side];
  }

  // Asks the polygon with more sides for the sides near to those of the other one.
  void find_meetings() {
    const Index few = polygons_[0]->sides().size() <= polygons_[1]->sides().size() ? 0 : 1;
    const PreparedPolygon& one = *polygons_[few];
    const PreparedPolygon& other = *polygons_[1 - few];
    one.boxes().visit(other.extent(), [&](Index s) {
      other.boxes().visit(one.boxes().box(s), [&](Index t) { meet(few, s, t); });
    });
    std::ranges::sort(incidences_);
    incidences_.erase(std::unique(incidences_.begin(), incidences_.end()), incidences_.end());
  }

  // Looks at side s of polygon k and side t of the other one.
  void meet(Index k, Index s, Index t) {
    const PolygonSide& one = polygons_[k]->sides()[s];
    const PolygonSide& other = polygons_[1 - k]->sides()[t];
    const arrangement::SideMeeting meeting =
        arrangement::meeting_of(points_, one.from, one.to, other.from, other.to);
    if (meeting.is_crossing) {
      facts_.are_inside = facts_.are_outside = {true, true};
      facts_.do_meet = true;
    }
    for (std::size_t m = 0; m < meeting.num_nodes; ++m) {
      incidences_.push_back({meeting.nodes[m], k, s});
      incidences_.push_back({meeting.nodes[m], 1 - k, t});
    }
  }

  void look_around_nodes() {
    for (std::size_t begin = 0; begin < incidences_.size();) {
      facts_.do_meet = true;
      const Index node = incidences_[begin].node;
      std::size_t end = begin;
      for (auto& directions : directions_) directions.clear();
      for (; end < incidences_.size() && incidences_[end].node == node; ++end) {
        const PolygonSide& at_node = side(incidences_[end]);
        std::vector<SideDirection>& directions = directions_[incidences_[end].polygon];
        if (at_node.from != node) directions.push_back({at_node.from, false});
        if (at_node.to != node) directions.push_back({at_node.to, true});
      }
      for (const std::size_t k : {0U, 1U}) {
        for (const SideDirection& direction : directions_[k]) look_along(node, direction, k);
      }
      begin = end;
    }
  }

  // Looks where a side of polygon k runs.
  void look_along(Index node, const SideDirection& direction, std::size_t k) {
    const std::vector<SideDirection>& others = directions_[1 - k];
    const auto same = std::ranges::find(others, direction.target, &SideDirection::target);
    const Point& target = points_[direction.target];
    const SideDirection& before =
        same != others.end() ? *same
                             : arrangement::direction_before(points_, node, target, others, true);
    if (same != others.end() ||
        arrangement::part_of_turn(points_[node], target, points_[before.target]) == 0) {
      (before.is_out == direction.is_out ? facts_.are_along : facts_.are_against) = true;
    } else {
      (before.is_out ? facts_.are_inside : facts_.are_outside)[k] = true;
    }
  }

  // Finds where the components of polygon k are that meet no side of the other one.
  void locate_components(std::size_t k) {
    const PreparedPolygon& one = *polygons_[k];
    const PreparedPolygon& other = *polygons_[1 - k];
    bool& is_inside = facts_.are_inside[k];
    bool& is_outside = facts_.are_outside[k];
    if (is_inside && is_outside) return;
    met_.clear();
    for (const Incidence& i : incidences_) {
      if (i.polygon == k) met_.push_back(one.component(i.side));
    }
    std::ranges::sort(met_);
    met_.erase(std::unique(met_.begin(), met_.end()), met_.end());
    // Components far from the other polygon are outside.
    std::size_t num_near = 0;
    one.component_boxes().visit(other.extent(), [&](Index c) {
      ++num_near;
      if ((is_inside && is_outside) || std::ranges::binary_search(met_, c)) return;
      (other.has(points_[one.side_of(c).from]) ? is_inside : is_outside) = true;
    });
    if (num_near < one.num_components()) is_outside = true;
  }

  std::span<const Point> points_;
  std::array<const PreparedPolygon*, 2> polygons_{};
  SideFacts facts_;
  std::vector<Incidence> incidences_;
  std::array<std::vector<SideDirection>, 2> directions_;
  std::vector<Index> met_;
};

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

 private:
  std::vector<Point> points_;
  std::vector<PreparedPolygon> first_;
  std::vector<PreparedPolygon> second_;
  bool is_same_ = false;
};

// Returns all pairs of polygons whose extents overlap, sorted.
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
  const system::Call call(execution);
  const PreparedOperands operands(first, second, execution.threads);
  const std::size_t num_first = first.num_cells();
  const std::size_t num_second = second.num_cells();
  if (num_first != num_second && num_first != 1 && num_second != 1) {
    throw InvalidInput("there are " + std::to_string(num_first) + " and " +
                       std::to_string(num_second) + " polygons, neither equally many nor one");
  }
  std::vector<Relation> result(num_first == 1 ? num_second : num_first);
  constexpr std::size_t grain = 16;
  system::parallel_for(execution.threads, result.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         PairRelater relater(operands.points());
                         for (std::size_t i = begin; i < end; ++i) {
                           result[i] = relater(operands.first()[num_first == 1 ? 0 : i],
                                               operands.second()[num_second == 1 ? 0 : i]);
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
  system::parallel_for(
      execution.threads, pairs.size(), grain, [&](std::size_t begin, std::size_t end) {
        PairRelater relater(operands.points());
        for (std::size_t p = begin; p < end; ++p) {
          const auto [i, k] = pairs[p];
          const Relation relation = relater(operands.first()[i], operands.second()[k]);
          if (relation.is(predicate)) parts[begin / grain].push_back({i, k, relation});
        }
      });
  std::vector<RelatedPair> result;
  for (const auto& part : parts) result.insert(result.end(), part.begin(), part.end());
  return result;
}

}  // namespace rondel
