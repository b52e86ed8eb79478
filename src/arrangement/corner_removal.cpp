// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rounds remove nodes at once that come before both of their neighbors: those for which the arc
// between the neighbors is nearest to the line, relative to the tolerance. As no two of them are
// neighbors, and each of their triangles has no node, they could as well be removed one after the
// other (docs/theory/simplification.md).
#include "arrangement/corner_removal.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "arrangement/arc_distance.h"
#include "arrangement/node_triangle.h"
#include "arrangement/point_tree.h"
#include "exact/vector.h"
#include "system/hash.h"
#include "system/parallel.h"

namespace rondel::arrangement {
namespace {

constexpr std::size_t removal_grain = 1024;
constexpr double infinite = ArcDistance::farther;  // more than any ratio that is allowed

class CornerRemoval {
 public:
  CornerRemoval(const LineNetwork& network, std::vector<double> limits, double clearance,
                unsigned threads)
      : network_(network),
        points_(network.points),
        limits_(std::move(limits)),
        clearance_(clearance),
        threads_(threads),
        links_(network.neighbors),
        states_(points_.size(), NodeState::kept),
        ranks_(points_.size(), 0),
        blockers_(points_.size(), no_index),
        num_left_(points_.size()),
        tree_(points_, nodes_left(), threads) {
    shorten_limits();
    for (Index node = 0; node < points_.size(); ++node) look_again(node);
    for (std::size_t r = 0; r < network.rings.size(); ++r) add_arcs(network.rings[r], true);
    for (std::size_t i = 0; i < network.lines.size(); ++i) add_arcs(network.lines[i], false);
  }

  void remove_corners() {
    while (true) {
      look_again_at_freed();
      rank_changed();
      if (candidates_.empty()) return;
      renew_tree();
      remove_candidates(searched_blockers());
    }
  }
  // Returns false if no loop could be dropped.
  bool drop_loops();
  // Drops the loops that were dropped in other states of the network, with all of their nodes.
  void drop_loops_of(std::span<const NodeState> others) {
    for (std::size_t r = 0; r < network_.rings.size(); ++r) {
      const std::span<const Index> ring = network_.rings[r];
      const auto is_dropped = [&](Index node) { return others[node] == NodeState::dropped; };
      if (std::ranges::none_of(ring, is_dropped)) continue;
      for (const Index node : ring) {
        if (is_left(node)) --num_left_;
        states_[node] = NodeState::dropped;
      }
    }
    std::erase_if(changed_, [&](Index node) { return !is_left(node); });
  }

  std::vector<NodeState> take_states() { return std::move(states_); }

 private:
  [[nodiscard]] bool is_fixed(Index node) const { return network_.is_fixed(node); }
  [[nodiscard]] bool is_left(Index node) const { return states_[node] < NodeState::removed; }
  // Returns the neighbor of a node that is not fixed, on the side where `from` is not.
  [[nodiscard]] Index beyond(Index node, Index from) const {
    const auto [first, second] = links_[node];
    return first == from ? second : first;
  }
  [[nodiscard]] std::vector<Index> nodes_left() const {
    std::vector<Index> nodes;
    nodes.reserve(num_left_);
    for (Index node = 0; node < points_.size(); ++node) {
      if (is_left(node)) nodes.push_back(node);
    }
    return nodes;
  }
  static std::uint64_t arc_between(Index a, Index c) {
    return (std::uint64_t{std::min(a, c)} << 32U) | std::max(a, c);
  }
  // Adds the arcs between fixed nodes of a row.
  void add_arcs(std::span<const Index> row, bool is_closed) {
    for (std::size_t k = is_closed ? 0 : 1; k < row.size(); ++k) {
      const Index from = row[k == 0 ? row.size() - 1 : k - 1];
      if (is_fixed(from) && is_fixed(row[k])) fixed_arcs_.insert(arc_between(from, row[k]));
    }
  }
  void shorten_limits();
  void look_again(Index node) {
    if (is_fixed(node) || states_[node] == NodeState::changed || !(limits_[node] > 0)) return;
    states_[node] = NodeState::changed;
    changed_.push_back(node);
  }
  // True if the arc between the neighbors of a node is there already, on the other side of a loop.
  [[nodiscard]] bool is_of_triangle(Index node) const {
    const auto [a, c] = links_[node];
    return a == c || (!is_fixed(a) && beyond(a, node) == c) ||
           (!is_fixed(c) && beyond(c, node) == a);
  }
  // Returns the fourth corner if a node is in a loop of four.
  [[nodiscard]] Index opposite(Index node) const;
  [[nodiscard]] double ratio(Index node) const;
  [[nodiscard]] bool is_before(Index node, Index other) const {
    const auto key = [&](Index n) { return std::tuple(system::hash_of(points_[n]), n); };
    return ranks_[node] != ranks_[other] ? ranks_[node] < ranks_[other] : key(node) < key(other);
  }
  [[nodiscard]] bool is_first(Index node) const;
  // Returns a node in the triangle between a node and its neighbors, or no_index.
  [[nodiscard]] Index node_in_triangle(Index node) const {
    const auto [a, c] = links_[node];
    const NodeTriangle triangle(points_, a, node, c);
    return tree_.first_in(triangle.box(),
                          [&](Index other) { return is_left(other) && triangle.has(other); });
  }

  [[nodiscard]] Index blocker_of(Index node) const;

  void look_again_at_freed();
  void rank_changed();
  void renew_tree();
  std::vector<Index> searched_blockers() const;
  void remove_candidates(const std::vector<Index>& blockers);
  void remove(Index node);

  const LineNetwork& network_;
  std::span<const Point> points_;
  std::vector<double> limits_;
  double clearance_;
  unsigned threads_;
  std::vector<std::array<Index, 2>> links_;  // neighbors that are left, on the sides of those given
  std::vector<NodeState> states_;
  std::vector<std::uint16_t> ranks_;  // of candidates
  std::vector<Index> blockers_;       // of blocked nodes
  std::size_t num_left_;
  PointTree tree_;  // of the nodes that were left once
  std::unordered_set<std::uint64_t> fixed_arcs_;
  std::vector<Index> changed_;
  std::vector<Index> candidates_;
  std::vector<Index> blocked_;
};

// The sine of the distance from a great circle is at most 1 / cos(l / 2) times as large between two
// places at a distance l as at the farther one of them.
void CornerRemoval::shorten_limits() {
  system::parallel_for(threads_, points_.size(), removal_grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t node = begin; node < end; ++node) {
                           if (is_fixed(static_cast<Index>(node))) continue;
                           double longest = 0;
                           for (const Index next : network_.neighbors[node]) {
                             const Point step = points_[next] - points_[node];
                             longest = std::max(longest, dot(step, step));
                           }
                           limits_[node] *= std::max(0.0, 1 - longest / 4 - 0x1p-45);
                         }
                       });
}

Index CornerRemoval::opposite(Index node) const {
  for (const std::size_t side : {0U, 1U}) {
    const Index a = links_[node][side];
    const Index c = links_[node][1 - side];
    if (is_fixed(a)) continue;
    const Index d = beyond(a, node);
    if (d == c) return no_index;
    if (!is_fixed(d) ? beyond(d, a) == c : !is_fixed(c) && beyond(c, node) == d) return d;
  }
  return no_index;
}

// Returns the greatest ratio of squared sines of distances, from the arc that would replace a node,
// to what is allowed. It is at most 1 if the node may be removed.
double CornerRemoval::ratio(Index node) const {
  const auto [low, high] = std::minmax(links_[node][0], links_[node][1]);
  if (low == high || dot(points_[low], points_[high]) < 0) return infinite;
  const ArcDistance distance(points_[low], points_[high]);
  const auto ratio_at = [&](Index n) { return distance.squared_sine(points_[n]) / limits_[n]; };
  double greatest = ratio_at(node);
  for (const std::size_t side : {0U, 1U}) {
    Index before = node;
    Index at = network_.neighbors[node][side];
    while (at != links_[node][side] && greatest <= 1) {
      greatest = std::max(greatest, ratio_at(at));
      const auto [first, second] = network_.neighbors[at];
      const Index next = first == before ? second : first;
      before = std::exchange(at, next);
    }
  }
  return greatest;
}

bool CornerRemoval::is_first(Index node) const {
  const auto comes_before = [&](Index other) {
    return states_[other] == NodeState::candidate && is_before(other, node);
  };
  const auto [a, c] = links_[node];
  if (comes_before(a) || comes_before(c)) return false;
  const Index other = opposite(node);
  return other == no_index || !comes_before(other);
}

void CornerRemoval::look_again_at_freed() {
  std::erase_if(blocked_, [&](Index node) {
    if (states_[node] == NodeState::blocked && !is_left(blockers_[node])) look_again(node);
    return states_[node] != NodeState::blocked;
  });
}

void CornerRemoval::rank_changed() {
  system::parallel_for(
      threads_, changed_.size(), removal_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Index node = changed_[i];
          const double greatest = is_of_triangle(node) ? infinite : ratio(node);
          // The exponent and three bits of the mantissa: so a line has few different ranks, and
          // rounds are few.
          ranks_[node] = static_cast<std::uint16_t>(std::bit_cast<std::uint64_t>(greatest) >> 49U);
          blockers_[node] = greatest <= 1 ? no_index : node;
        }
      });
  for (const Index node : changed_) {
    const bool is_near = blockers_[node] == no_index;
    states_[node] = is_near ? NodeState::candidate : NodeState::far;
    if (is_near) candidates_.push_back(node);
  }
  changed_.clear();
}

void CornerRemoval::renew_tree() {
  if (num_left_ < tree_.size() / 4 * 3) tree_ = PointTree(points_, nodes_left(), threads_);
}

// The arc that would take the place of a node, and the two arcs to that node.
class Clearance {
 public:
  // `limit`: the squared sine of the distance that the arc keeps from other nodes.
  Clearance(std::span<const Point> points, Index a, Index node, Index c, double limit)
      : a_(points[std::min(a, c)]),
        c_(points[std::max(a, c)]),
        arc_(a_, c_),
        first_(points[std::min(a, node)], points[std::max(a, node)]),
        second_(points[std::min(node, c)], points[std::max(node, c)]),
        limit_(limit) {}

  // Returns a distance within which all nodes are that the arc may be too near to: half of that to an
  // end of it, and so 0.6 of its length. Chords are less than 1.1 times the sines of tolerances.
  [[nodiscard]] double reach() const {
    return 1.1 * std::sqrt(std::min(limit_, 0.36 * dot(a_ - c_, a_ - c_)));
  }
  // True if the arc would come too near to a place that was farther from the line. Places near an
  // end, such as the next nodes of the line, were as near to it before.
  [[nodiscard]] bool is_lost_at(const Point& p) const {
    const double distance = arc_.squared_sine(p);
    return distance < limit_ && 4 * distance < std::min(dot(p - a_, p - a_), dot(p - c_, p - c_)) &&
           distance < std::min(first_.squared_sine(p), second_.squared_sine(p));
  }

 private:
  Point a_;
  Point c_;
  ArcDistance arc_;
  ArcDistance first_;
  ArcDistance second_;
  double limit_;
};

// Returns a node in the triangle between a node and its neighbors, or one that the arc between these
// would come too near to; or no_index.
Index CornerRemoval::blocker_of(Index node) const {
  const double limit = clearance_ * clearance_ * limits_[node];
  if (!(limit > 0)) return node_in_triangle(node);
  const Index a = links_[node][0];
  const Index c = links_[node][1];
  const NodeTriangle triangle(points_, a, node, c);
  const Clearance clearance(points_, a, node, c, limit);
  SpaceBox box = triangle.box();
  box.widen(clearance.reach());
  return tree_.first_in(box, [&](Index other) {
    if (!is_left(other) || other == a || other == c || other == node) return false;
    return clearance.is_lost_at(points_[other]) || triangle.has(other);
  });
}

// Returns for each candidate that comes before its neighbors a node in its triangle or too near, or
// no_index; for others themselves.
std::vector<Index> CornerRemoval::searched_blockers() const {
  std::vector<Index> blockers(candidates_.size());
  system::parallel_for(threads_, blockers.size(), removal_grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           const Index node = candidates_[i];
                           blockers[i] = is_first(node) ? blocker_of(node) : node;
                         }
                       });
  return blockers;
}

void CornerRemoval::remove_candidates(const std::vector<Index>& blockers) {
  std::vector<Index> last;  // nodes between fixed nodes
  for (std::size_t i = 0; i < blockers.size(); ++i) {
    const Index node = candidates_[i];
    if (blockers[i] == node) continue;
    const auto [a, c] = links_[node];
    if (blockers[i] != no_index) {
      states_[node] = NodeState::blocked;
      blockers_[node] = blockers[i];
      blocked_.push_back(node);
    } else if (is_fixed(a) && is_fixed(c)) {
      last.push_back(node);
    } else {
      remove(node);
    }
  }
  std::ranges::sort(last, [&](Index node, Index other) { return is_before(node, other); });
  for (const Index node : last) {
    if (fixed_arcs_.insert(arc_between(links_[node][0], links_[node][1])).second) {
      remove(node);
    } else {
      states_[node] = NodeState::kept;
    }
  }
  std::erase_if(candidates_, [&](Index node) { return states_[node] != NodeState::candidate; });
}

void CornerRemoval::remove(Index node) {
  const auto [a, c] = links_[node];
  const Index other = opposite(node);
  states_[node] = NodeState::removed;
  --num_left_;
  for (const auto& [end, next] : {std::pair(a, c), std::pair(c, a)}) {
    if (is_fixed(end)) continue;
    std::ranges::replace(links_[end], node, next);
    look_again(end);
  }
  if (other != no_index) look_again(other);
}

// A loop of three corners is dropped if its third corner could be removed but for the topology, and
// nothing is in its triangle.
bool CornerRemoval::drop_loops() {
  std::vector<std::uint8_t> is_dropped(points_.size(), 0);
  renew_tree();
  system::parallel_for(
      threads_, points_.size(), removal_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto node = static_cast<Index>(i);
          if (is_fixed(node) || !is_left(node)) continue;
          const auto [a, c] = links_[node];
          if (is_fixed(a) || is_fixed(c) || beyond(a, node) != c || node > std::min(a, c)) continue;
          const double least = std::min({ratio(node), ratio(a), ratio(c)});
          is_dropped[i] = least <= 1 && node_in_triangle(node) == no_index ? 1 : 0;
        }
      });
  bool any = false;
  for (Index node = 0; node < points_.size(); ++node) {
    if (is_dropped[node] == 0) continue;
    any = true;
    for (const Index corner : {node, links_[node][0], links_[node][1]}) {
      states_[corner] = NodeState::dropped;
      --num_left_;
    }
  }
  return any;
}

}  // namespace

// Coordinates are those of unit vectors up to 1e-14, which changes sines by this share of theirs.
// The normal of an arc of at most 90 degrees is off by 6 u of its length (sided_arc.h: (1 + 2
// sqrt(2)) u of the step, which is at most sqrt(2) times as long), the product with a step of at
// most 2 by 4 u more: 16 u in all. A place that is taken to be beside the inside of the arc though
// it is beyond an end, by 4 u, is farther away by 4 u. So 2^-47 is more than all of that, and 2^-40
// more than all that is relative.
double squared_sine_below(double tolerance) {
  constexpr double least = 0x1p-44;
  constexpr double greatest = 0.78539816339744828;  // pi / 4
  if (tolerance < least) return 0;
  const double t = std::min(tolerance, greatest);
  // The sine, from its series up to t^11, which is below it.
  double sine = 0;
  double term = t;
  for (int k = 1; k <= 11; k += 2) {
    sine += term;
    term *= -t * t / ((k + 1) * (k + 2));
  }
  sine = (sine - 0x1p-47) * (1 - 0x1p-40);
  return sine * sine;
}

std::vector<NodeState> removed_nodes(const LineNetwork& network, std::vector<double> limits,
                                     const RemovalRules& rules, unsigned threads) {
  std::vector<NodeState> without_clearance;
  if (rules.drops_loops && rules.clearance > 0) {
    // A thin loop would keep the clearance between its own sides.
    without_clearance = removed_nodes(network, limits, {.drops_loops = true}, threads);
  }
  CornerRemoval removal(network, std::move(limits), rules.clearance, threads);
  if (!without_clearance.empty()) removal.drop_loops_of(without_clearance);
  do {
    removal.remove_corners();
  } while (rules.drops_loops && removal.drop_loops());
  return removal.take_states();
}

}  // namespace rondel::arrangement
