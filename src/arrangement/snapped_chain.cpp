// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Within the radius of a node the sphere is a plane up to a relative 2^-52: the squared distance of
// the place t along the arc from a node at (x, y) is (t - x)^2 + y^2. The nearest nodes are those of
// the lower envelope of these parabolas, where it is below the squared radius. Nodes may be much
// closer to each other than the radius, and some of them much closer than others. So x and y are
// differences in double-double, and parabolas are compared by the differences of their nodes.
#include "arrangement/snapped_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

#include "arrangement/arc_contacts.h"
#include "exact/vector.h"
#include "rondel/arrangement.h"
#include "rondel/predicates.h"

namespace rondel::arrangement {
namespace {

using exact::to_vector;

// A node in coordinates along the arc (x) and across (y), relative to the first node of its group.
struct PlaceAlong {
  exact::DoubleDouble x;
  exact::DoubleDouble y;
  double height;  // the distance from the arc, with a small relative error
  Index node;
};

// The nodes of an arc in groups: nodes of different groups are farther apart than both radii.
class NodesAlong {
 public:
  NodesAlong(std::span<const Point> nodes, NodedArc arc)
      : nodes_(nodes),
        arc_(arc),
        a_(to_vector(nodes[arc.from])),
        normal_(normalized(normal_of(nodes[arc.from], nodes[arc.to]))),
        forward_(cross(normal_, a_)) {}

  // Returns a number from 0 to 2 that grows along the arc, at least half as fast as the angle. It is
  // off by a few units in the last place of 1.
  [[nodiscard]] double rough_place(Index node) const {
    const Vec p = to_vector(nodes_[node]);
    const double sine = dot(forward_, p);
    const double cosine = dot(a_, p);
    const double quarter = sine / (std::abs(sine) + std::abs(cosine));
    return cosine > 0 ? quarter : 2 - quarter;
  }
  // Returns the place of a node relative to another one near to it.
  [[nodiscard]] PlaceAlong place(Index node, Index first) const {
    // The cross product is as long as the step along the sphere, and perpendicular to it.
    const auto across = precise_normal_of(nodes_[first], nodes_[node]);
    const auto along = [&](const Vec& direction) {
      return across.x * direction.x + across.y * direction.y + across.z * direction.z;
    };
    return {along(normal_), along(cross(to_vector(nodes_[first]), normal_)), height(node), node};
  }

 private:
  // Returns the distance of a node from the arc, positive to the left, with a small relative error.
  [[nodiscard]] double height(Index node) const {
    if (node == arc_.from || node == arc_.to) return 0;
    return exact_height(nodes_[arc_.from], nodes_[arc_.to], nodes_[node]);
  }

  std::span<const Point> nodes_;
  NodedArc arc_;
  Vec a_;
  Vec normal_;
  Vec forward_;
};

struct RoughPlace {
  double at;
  Index node;
};

// The order of nodes along an arc, and of nodes above each other.
auto order_along(const PlaceAlong& place) {
  return std::tuple(place.x.hi, place.x.lo, std::abs(place.height), place.node);
}

// The nodes of a group that are nearest to some place of the arc.
class Envelope {
 public:
  explicit Envelope(std::span<const PlaceAlong> sorted) {
    for (const PlaceAlong& place : sorted) add(place);
  }

  // Returns the nodes of which such a place is within the radius, in order.
  [[nodiscard]] std::vector<PlaceAlong> nearest() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<PlaceAlong> found;
    for (std::size_t i = 0; i < nearest_.size(); ++i) {
      const PlaceAlong& place = nearest_[i];
      const double begin = i == 0 ? -infinity : middle_after(place, nearest_[i - 1]);
      const double end = i + 1 == nearest_.size() ? infinity : middle_after(place, nearest_[i + 1]);
      const double x = std::clamp(0.0, begin, end);
      const double y = place.height;
      if (x * x + y * y <= arrangement_radius * arrangement_radius) found.push_back(place);
    }
    return found;
  }

 private:
  // Returns the place along the arc that is equally far from two nodes, as far as it is after the
  // first of them. Precondition: they have different x.
  [[nodiscard]] static double middle_after(const PlaceAlong& first, const PlaceAlong& second) {
    const double x = (second.x - first.x).hi;
    const double y = (second.y - first.y).hi;
    return (x + y / x * (first.height + second.height)) / 2;
  }
  // True if two nodes are above each other, up to rounding. Precondition: second.x >= first.x
  static bool is_above(const PlaceAlong& first, const PlaceAlong& second) {
    return (second.x - first.x).hi <= equality * (std::abs(first.height) + std::abs(second.height));
  }
  // True if a node is farther from the arc than another one, or as far, with a higher number.
  static bool is_farther(const PlaceAlong& place, const PlaceAlong& other) {
    const double away = std::abs(place.height) - std::abs(other.height);
    if (std::abs(away) > equality * std::abs(other.height)) return away > 0;
    return place.node > other.node;
  }
  void add(const PlaceAlong& place) {
    // One of two nodes above each other is nowhere nearer than the other.
    while (!nearest_.empty() && is_above(nearest_.back(), place)) {
      if (is_farther(place, nearest_.back())) return;
      nearest_.pop_back();
    }
    while (nearest_.size() > 1 &&
           middle_after(nearest_.back(), place) <=
               middle_after(nearest_.back(), nearest_[nearest_.size() - 2])) {
      nearest_.pop_back();
    }
    nearest_.push_back(place);
  }

  // The largest relative error of steps and heights, with room to spare.
  static constexpr double equality = 0x1p-40;
  std::vector<PlaceAlong> nearest_;
};

// Appends a few nodes near to an arc if they are far apart, from each other and from its ends, which
// doubles show. So each of them has a cell that the arc enters.
bool append_nodes_far_apart(std::span<const Point> nodes, NodedArc arc, std::span<const Index> near,
                            std::vector<Index>& chain) {
  constexpr std::size_t most = 14;
  if (near.size() > most) return false;
  const Point& a = nodes[arc.from];
  const Point step = nodes[arc.to] - a;
  // Places along the chord grow with the places along an arc of less than a right angle, and differ
  // by less. They are off by a few units in the last place of the length of the chord.
  if (!(dot(a, nodes[arc.to]) > 0)) return false;
  std::array<RoughPlace, most + 2> order;
  std::size_t size = 0;
  order[size++] = {0, arc.from};
  for (const Index node : near) {
    const RoughPlace place = {dot(nodes[node] - a, step), node};
    std::size_t k = size++;
    for (; k > 0 && order[k - 1].at > place.at; --k) order[k] = order[k - 1];
    order[k] = place;
  }
  order[size++] = {dot(step, step), arc.to};
  constexpr double far = 0x1p-40;
  const double least = far * (std::abs(step.x) + std::abs(step.y) + std::abs(step.z));
  for (std::size_t k = 1; k < size; ++k) {
    if (!(order[k].at - order[k - 1].at > least)) return false;
  }
  for (std::size_t k = 1; k + 1 < size; ++k) chain.push_back(order[k].node);
  return true;
}

}  // namespace

bool append_nearest_nodes(std::span<const Point> nodes, NodedArc arc, std::span<const Index> near,
                          std::span<const Index> required, std::vector<Index>& chain) {
  if (append_nodes_far_apart(nodes, arc, near, chain)) return false;
  const NodesAlong along(nodes, arc);
  std::vector<RoughPlace> order;
  order.reserve(near.size() + 2);
  for (const Index node : near) order.push_back({along.rough_place(node), node});
  for (const Index node : {arc.from, arc.to}) order.push_back({along.rough_place(node), node});
  std::ranges::sort(order, {}, [](const RoughPlace& p) { return std::pair(p.at, p.node); });
  // Rough places of nodes whose disks may meet differ by less: both radii, and errors.
  constexpr double group_width = 16 * arrangement_radius;
  bool is_crowded = false;
  std::vector<PlaceAlong> places;
  for (std::size_t i = 0; i < order.size();) {
    std::size_t k = i + 1;
    while (k < order.size() && order[k].at - order[k - 1].at <= group_width) ++k;
    if (k == i + 1) {
      if (order[i].node != arc.from && order[i].node != arc.to) chain.push_back(order[i].node);
    } else {
      is_crowded = true;
      places.clear();
      for (std::size_t m = i; m < k; ++m) {
        places.push_back(along.place(order[m].node, order[i].node));
      }
      std::ranges::sort(places, {}, order_along);
      std::vector<PlaceAlong> through = Envelope(places).nearest();
      const std::size_t num_nearest = through.size();
      std::ranges::copy_if(places, std::back_inserter(through), [&](const PlaceAlong& place) {
        return std::ranges::find(required, place.node) != required.end();
      });
      if (through.size() > num_nearest) {
        std::ranges::sort(through, {}, order_along);
        const auto is_same = [](const PlaceAlong& p, const PlaceAlong& q) {
          return p.node == q.node;
        };
        through.erase(std::unique(through.begin(), through.end(), is_same), through.end());
      }
      for (const PlaceAlong& place : through) {
        if (place.node != arc.from && place.node != arc.to) chain.push_back(place.node);
      }
    }
    i = k;
  }
  return is_crowded;
}

void append_nodes_on_arc(std::span<const Point> nodes, NodedArc arc, std::span<const Index> on,
                         std::vector<Index>& chain) {
  const auto begin = static_cast<std::ptrdiff_t>(chain.size());
  chain.insert(chain.end(), on.begin(), on.end());
  // The cross product of two nodes on the arc is a multiple of the exact normal, and so its product
  // with the rounded one has the sign of the multiple.
  const Point normal = exact::to_point(normalized(normal_of(nodes[arc.from], nodes[arc.to])));
  std::sort(chain.begin() + begin, chain.end(), [&](Index p, Index q) {
    return orientation(nodes[p], nodes[q], normal) == Sign::positive;
  });
}

}  // namespace rondel::arrangement
