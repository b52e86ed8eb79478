// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Pairs of arcs whose boxes overlap are looked at once. Where the ends of an arc are farther from the
// great circle of the other one than the radius, doubles show on which side they are, and that
// nothing is near. All other pairs are decided exactly, as to crossings, and in double-double, as to
// distances.
#include "arrangement/arc_contacts.h"

#include <algorithm>
#include <array>
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

  void add(Index i, Index j) {
    const NodedArc s = input_.arcs[i];
    const NodedArc t = input_.arcs[j];
    const SidedArc first(point(s.from), point(s.to));
    const SidedArc second(point(t.from), point(t.to));
    const bool is_from_shared = t.from == s.from || t.from == s.to;
    const bool is_to_shared = t.to == s.from || t.to == s.to;
    const int from = is_from_shared ? 0 : first.side(point(t.from));
    const int to = is_to_shared ? 0 : first.side(point(t.to));
    if (from * to > 0) return;
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
    if (node == ends.from || node == ends.to) return;
    if (is_near(point(ends.from), point(ends.to), point(node))) found_.near.push_back({arc, node});
  }

  const NodedArcs& input_;
  Contacts& found_;
};

// Returns the pairs of all parts, ascending, each once. The pairs of an arc are few.
std::vector<NearNode> sorted_pairs(const std::vector<std::vector<NearNode>>& parts,
                                   std::size_t num_arcs, unsigned threads) {
  system::RowPlaces<std::uint64_t> places(num_arcs);
  for (const auto& part : parts) {
    for (const NearNode& pair : part) places.count(pair.arc);
  }
  std::vector<NearNode> all(places.sum());
  for (const auto& part : parts) {
    for (const NearNode& pair : part) all[places.place(pair.arc)] = pair;
  }
  const std::vector<std::uint64_t> offsets = std::move(places).offsets();
  constexpr std::size_t grain = 4096;
  system::parallel_for(threads, num_arcs, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t arc = begin; arc < end; ++arc) {
      std::sort(all.begin() + static_cast<std::ptrdiff_t>(offsets[arc]),
                all.begin() + static_cast<std::ptrdiff_t>(offsets[arc + 1]));
    }
  });
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
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

constexpr std::size_t blocks_per_task = 128;
constexpr std::size_t points_per_task = 1024;
constexpr std::size_t points_per_query = 16;

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
  std::vector<SpaceBox> boxes(input.arcs.size());
  constexpr std::size_t grain = 4096;
  system::parallel_for(threads, boxes.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      boxes[i] = box_of(input.from(static_cast<Index>(i)), input.to(static_cast<Index>(i)));
    }
  });
  return {std::move(boxes), threads};
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
                           boxes.visit_pairs(block, [&](Index i, Index j) { finder.add(i, j); });
                         }
                         std::ranges::sort(found.crossings);
                         crossings[begin / blocks_per_task] = std::move(found.crossings);
                         near[begin / blocks_per_task] = std::move(found.near);
                       });
  Contacts result;
  // The tasks have the first arcs of their crossings in ascending order.
  for (const auto& part : crossings) {
    result.crossings.insert(result.crossings.end(), part.begin(), part.end());
  }
  result.near = sorted_pairs(near, input.arcs.size(), threads);
  return result;
}

// Points that follow each other along the spatial order are close to each other, so that the tree is
// asked for the arcs near to some of them at once.
std::vector<NearNode> arcs_near(const NodedArcs& input, const BoxTree& boxes,
                                std::span<const Point> points, unsigned threads) {
  std::vector<std::vector<NearNode>> parts(system::num_pieces(points.size(), points_per_task));
  system::parallel_for(
      threads, points.size(), points_per_task, [&](std::size_t begin, std::size_t end) {
        std::vector<NearNode>& part = parts[begin / points_per_task];
        std::vector<SpaceBox> places;
        for (std::size_t first = begin; first < end; first += points_per_query) {
          places.clear();
          for (std::size_t k = first; k < std::min(end, first + points_per_query); ++k) {
            const std::array<double, 3> place = {points[k].x, points[k].y, points[k].z};
            places.push_back({place, place});
          }
          SpaceBox all = places[0];
          for (const SpaceBox& place : places) all.include(place);
          boxes.visit(all, [&](Index arc) {
            for (std::size_t k = 0; k < places.size(); ++k) {
              if (places[k].overlaps(boxes.box(arc)) &&
                  SidedArc(input.from(arc), input.to(arc)).side(points[first + k]) == 0 &&
                  is_near(input.from(arc), input.to(arc), points[first + k])) {
                part.push_back({arc, static_cast<Index>(first + k)});
              }
            }
          });
        }
      });
  return sorted_pairs(parts, input.arcs.size(), threads);
}

}  // namespace rondel::arrangement
