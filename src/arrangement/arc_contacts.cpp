// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Pairs of arcs whose boxes overlap are looked at once. Where the ends of an arc are farther from the
// great circle of the other one than the radius, doubles show on which side they are, and that
// nothing is near. All other pairs are decided exactly, as to crossings, and in double-double, as to
// distances.
#include "arrangement/arc_contacts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "arrangement/sided_arc.h"
#include "exact/ball.h"
#include "exact/eft.h"
#include "exact/exact_sign.h"
#include "rondel/arrangement.h"
#include "rondel/predicates.h"
#include "system/row_assembly.h"

namespace rondel::arrangement {
namespace {

using exact::to_vector;

// How far beyond an arc its box reaches: more than the radius, and the lengths of two points on one
// ray may differ by 2e-14.
constexpr double margin = 0x1p-43;

// Collects the contacts of pairs of arcs whose boxes overlap.
class ContactFinder {
 public:
  ContactFinder(const NodedArcs& input, Contacts& found) : input_(input), found_(found) {}

  // Takes a block of the tree, of whose arcs each is the first one of several pairs.
  void begin_block(std::size_t block) {
    first_of_block_ = block * BoxTree::fan_out;
    sided_.clear();
    const std::size_t end = std::min(input_.arcs.size(), first_of_block_ + BoxTree::fan_out);
    for (std::size_t i = first_of_block_; i < end; ++i) {
      sided_.emplace_back(point(input_.arcs[i].from), point(input_.arcs[i].to));
    }
  }
  void add(Index i, Index j) {
    const NodedArc s = input_.arcs[i];
    const NodedArc t = input_.arcs[j];
    const SidedArc& first = sided_[i - first_of_block_];
    if (t.from == t.to) {
      if (first.side(point(t.from)) == 0) add_if_near(i, t.from);
      return;
    }
    if (s.from == s.to) {
      if (SidedArc(point(t.from), point(t.to)).side(point(s.from)) == 0) add_if_near(j, s.from);
      return;
    }
    const bool is_from_shared = t.from == s.from || t.from == s.to;
    const bool is_to_shared = t.to == s.from || t.to == s.to;
    const int from = is_from_shared ? 0 : first.side(point(t.from));
    const int to = is_to_shared ? 0 : first.side(point(t.to));
    if (from * to > 0) return;
    const SidedArc second(point(t.from), point(t.to));
    const int of_from = s.from == t.from || s.from == t.to ? 0 : second.side(point(s.from));
    const int of_to = s.to == t.from || s.to == t.to ? 0 : second.side(point(s.to));
    if (of_from * of_to > 0) return;
    if (from * to < 0 && of_from * of_to < 0) {
      if (from * of_from < 0) found_.crossings.push_back({i, j});
      return;
    }
    if (from == 0) add_if_near(i, t.from);
    if (to == 0 && t.to != t.from) add_if_near(i, t.to);
    if (of_from == 0) add_if_near(j, s.from);
    if (of_to == 0 && s.to != s.from) add_if_near(j, s.to);
    if (!is_from_shared && !is_to_shared &&
        do_arcs_cross(point(s.from), point(s.to), point(t.from), point(t.to))) {
      found_.crossings.push_back({i, j});
    }
  }

 private:
  [[nodiscard]] const Point& point(Index node) const { return input_.nodes[node]; }
  void add_if_near(Index arc, Index node) {
    const NodedArc ends = input_.arcs[arc];
    // An arc in one place has no inside.
    if (node == ends.from || node == ends.to || ends.from == ends.to) return;
    if (is_near(point(ends.from), point(ends.to), point(node))) found_.near.push_back({arc, node});
  }

  const NodedArcs& input_;
  Contacts& found_;
  std::size_t first_of_block_ = 0;
  std::vector<SidedArc> sided_;  // the arcs of the block
};

// Returns the entries of all parts, one part after the other.
template <class T>
std::vector<T> joined(const std::vector<std::vector<T>>& parts, unsigned threads) {
  const std::vector<std::uint64_t> offsets =
      system::offsets_of(parts.size(), [&](std::size_t i) { return parts[i].size(); });
  std::vector<T> all(offsets.back());
  system::parallel_for(threads, parts.size(), 1, [&](std::size_t i, std::size_t /*end*/) {
    std::ranges::copy(parts[i], all.begin() + static_cast<std::ptrdiff_t>(offsets[i]));
  });
  return all;
}

// Sorts pairs and leaves each once. If there are many, those of an arc are few.
void sort_pairs(std::vector<NearNode>& pairs, std::size_t num_arcs, unsigned threads) {
  constexpr std::size_t arcs_per_pair = 16;
  if (pairs.size() < num_arcs / arcs_per_pair) {
    std::ranges::sort(pairs);
  } else {
    system::RowPlaces<std::uint64_t> places(num_arcs);
    for (const NearNode& pair : pairs) places.count(pair.arc);
    std::vector<NearNode> all(places.sum());
    for (const NearNode& pair : pairs) all[places.place(pair.arc)] = pair;
    const std::vector<std::uint64_t> offsets = std::move(places).offsets();
    constexpr std::size_t grain = 4096;
    system::parallel_for(threads, num_arcs, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t arc = begin; arc < end; ++arc) {
        std::sort(all.begin() + static_cast<std::ptrdiff_t>(offsets[arc]),
                  all.begin() + static_cast<std::ptrdiff_t>(offsets[arc + 1]));
      }
    });
    pairs = std::move(all);
  }
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

// True if the angle from p to q about a unit vector is positive beyond doubt: the product is off by
// less than 20 u |q - p|.
bool is_surely_ahead(const Vec& direction, const Point& p, const Point& q) {
  const Vec step = to_vector(q) - to_vector(p);
  constexpr double min_step = 0x1p-400;  // products of shorter steps may underflow
  constexpr double sure = 0x1p-40;
  const double size = std::abs(step.x) + std::abs(step.y) + std::abs(step.z);
  return size > min_step && dot(direction, cross(to_vector(p), step)) > sure * size;
}

bool is_ahead(const Vec& direction, const Point& p, const Point& q) {
  return is_surely_ahead(direction, p, q) || dot(direction, normal_of(p, q)) > 0;
}

// Collects the arcs near to points, a batch of points at a time.
class NearArcFinder {
 public:
  NearArcFinder(const NodedArcs& input, const SoughtPoints& sought, std::vector<NearNode>& found)
      : input_(input), sought_(sought), found_(found) {}

  void begin_batch(std::size_t first, std::size_t size) {
    first_ = first;
    box_ = empty_box;
    for (std::size_t k = 0; k < PointBatch::size; ++k) {
      // The first point fills the places that are left.
      const Point& p = sought_.points[sought_.which[first + (k < size ? k : 0)]];
      batch_.x[k] = p.x;
      batch_.y[k] = p.y;
      batch_.z[k] = p.z;
      box_.include({{p.x, p.y, p.z}, {p.x, p.y, p.z}});
    }
    in_use_ = (1U << size) - 1;
  }
  [[nodiscard]] const SpaceBox& box() const { return box_; }

  void add(Index arc) {
    const Point& a = input_.from(arc);
    const Point& b = input_.to(arc);
    unsigned left = SidedArc(a, b).may_be_near(batch_) & in_use_;
    for (; left != 0; left &= left - 1) {
      const std::size_t k = first_ + static_cast<unsigned>(std::countr_zero(left));
      if (sought_.known[k].first == arc || sought_.known[k].second == arc) continue;
      const Index point = sought_.which[k];
      if (is_near(a, b, sought_.points[point])) found_.push_back({arc, point});
    }
  }

 private:
  const NodedArcs& input_;
  const SoughtPoints& sought_;
  std::vector<NearNode>& found_;
  std::size_t first_ = 0;
  unsigned in_use_ = 0;
  PointBatch batch_{};
  SpaceBox box_{};
};

constexpr std::size_t blocks_per_task = 128;
constexpr std::size_t points_per_task = 1024;
}  // namespace

// Where each great circle separates the ends of the other arc, an arc crosses the other one or the
// antipodes of the other one; it crosses the other one if c is on one side of ab and a on the other
// side of cd.
bool do_arcs_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Sign first = orientation(a, b, c);
  return first != Sign::zero && orientation(a, b, d) == -first && orientation(c, d, a) == -first &&
         orientation(c, d, b) == first;
}

bool is_near(const Point& a, const Point& b, const Point& p) {
  // The conditions below do not tell the antipodes of an end. All points of an arc are less than
  // 90 degrees from one of its ends.
  if (!(dot(a, p) > 0) && !(dot(b, p) > 0)) return false;
  // The foot is within the arc if p is ahead of a and behind b. Cross products show that for points
  // that differ far less than their lengths do.
  const Vec normal = normal_of(a, b);
  const Vec direction = normalized(normal);
  if (!is_ahead(direction, a, p) || !is_ahead(direction, p, b)) return false;
  const exact::Vector3<exact::DoubleDouble> from_center = {{a.x, 0}, {a.y, 0}, {a.z, 0}};
  const double volume = det(from_center, exact::difference(b, a), exact::difference(p, a)).hi;
  // The volume is off by 2^-101 or less, and the normal is longer than 2^-46.
  return std::abs(volume) <= arrangement_radius * exact::length_of(normal);
}

double exact_height(const Point& a, const Point& b, const Point& p) {
  const exact::BallStep<104> step;  // exact, see exact::sign_of_cubic()
  const auto volume = det(step(Point{}, a), step(a, b), step(a, p));
  return exact::leading_double(volume) / exact::length_of(normal_of(a, b));
}

bool is_on_near_arc(const Point& a, const Point& b, const Point& p) {
  return orientation(a, b, p) == Sign::zero;
}

SpaceBox box_of(const Point& a, const Point& b) {
  // A point of the arc is a point of the chord, moved away from the center by the sagitta or less
  // along the direction to the middle.
  const Vec chord = to_vector(b) - to_vector(a);
  // The direction to the middle of a longer arc is not known well enough.
  constexpr double max_squared_chord = 3.5;
  if (dot(chord, chord) > max_squared_chord) return whole_box;
  const double sagitta = 1 - std::sqrt(std::max(0.0, 1 - dot(chord, chord) / 4));
  const Vec bulge = sagitta * normalized(to_vector(a) + to_vector(b));
  const auto range = [](double from, double to, double beyond) {
    return std::array{std::min(from, to) + std::min(beyond, 0.0) - margin,
                      std::max(from, to) + std::max(beyond, 0.0) + margin};
  };
  const auto [low_x, high_x] = range(a.x, b.x, bulge.x);
  const auto [low_y, high_y] = range(a.y, b.y, bulge.y);
  const auto [low_z, high_z] = range(a.z, b.z, bulge.z);
  return {{low_x, low_y, low_z}, {high_x, high_y, high_z}};
}

BoxTree boxes_of(const NodedArcs& input, unsigned threads) {
  const auto box = [&](std::size_t i) {
    return box_of(input.from(static_cast<Index>(i)), input.to(static_cast<Index>(i)));
  };
  return {input.arcs.size(), box, threads};
}

Contacts find_contacts(const NodedArcs& input, const BoxTree& boxes, unsigned threads) {
  const std::size_t num_blocks = boxes.num_blocks();
  const std::size_t num_tasks = system::num_pieces(num_blocks, blocks_per_task);
  std::vector<std::vector<CrossingArcs>> crossings(num_tasks);
  std::vector<std::vector<NearNode>> near(num_tasks);
  system::parallel_for(threads, num_blocks, blocks_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         Contacts found;
                         ContactFinder finder(input, found);
                         for (std::size_t block = begin; block < end; ++block) {
                           finder.begin_block(block);
                           boxes.visit_pairs(block, [&](Index i, Index j) { finder.add(i, j); });
                         }
                         std::ranges::sort(found.crossings);
                         crossings[begin / blocks_per_task] = std::move(found.crossings);
                         near[begin / blocks_per_task] = std::move(found.near);
                       });
  // The tasks have the first arcs of their crossings in ascending order.
  Contacts result = {joined(crossings, threads), joined(near, threads)};
  sort_pairs(result.near, input.arcs.size(), threads);
  return result;
}

// Points that follow each other along the spatial order are close to each other, so that the tree is
// asked for the arcs near to some of them at once.
std::vector<NearNode> arcs_near(const NodedArcs& input, const BoxTree& boxes,
                                const SoughtPoints& sought, unsigned threads) {
  std::vector<std::vector<NearNode>> parts(
      system::num_pieces(sought.which.size(), points_per_task));
  system::parallel_for(threads, sought.which.size(), points_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         NearArcFinder finder(input, sought, parts[begin / points_per_task]);
                         for (std::size_t first = begin; first < end; first += PointBatch::size) {
                           finder.begin_batch(first, std::min(end - first, PointBatch::size));
                           boxes.visit(finder.box(), [&](Index arc) { finder.add(arc); });
                         }
                       });
  return joined(parts, threads);
}

}  // namespace rondel::arrangement
