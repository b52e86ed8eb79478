// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "constrained/constraints.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "exact/vector.h"
#include "proof/sites_by_place.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/prefetch.h"

namespace rondel::constrained {
namespace {

bool is_less(const Point& a, const Point& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

std::string text_of(std::size_t number) { return std::to_string(number); }

// True if doubles show that two points are not on one line with the center: |v x w| is off by less
// than 2^-50 |v||w|, the rounding of both differences included.
bool are_surely_independent(const Point& a, const Point& b, const Sphere& sphere) {
  const auto v = exact::to_vector(a) - exact::to_vector(sphere.center);
  const auto w = exact::to_vector(b) - exact::to_vector(sphere.center);
  const auto normal = cross(v, w);
  constexpr double bound = 0x1p-40;
  constexpr double least = 0x1p-500;  // below it products may underflow
  const double lengths = dot(v, v) * dot(w, w);
  return lengths > least && dot(normal, normal) > bound * lengths;
}

// Two vectors are on one line with the center iff each axis is in one plane with them.
bool are_dependent(const Point& a, const Point& b, const Sphere& sphere) {
  return std::ranges::all_of(std::array{0U, 1U, 2U}, [&](unsigned axis) {
    return orientation(a, b, proof::axis_point(sphere.center, axis), sphere) == Sign::zero;
  });
}

// The places of names along the ring of a triangulation, and which way around an arc goes.
class RingArcs {
 public:
  RingArcs(const Triangulation& triangulation, const NamedSites& sites)
      : ring_(triangulation.ring()),
        sites_(sites),
        sphere_(triangulation.sphere()),
        places_(triangulation.num_sites(), no_index) {
    for (std::size_t i = 0; i < ring_.size(); ++i) places_[ring_[i]] = static_cast<Index>(i);
  }

  // Appends the pieces of the arc between two vertices.
  void append(Index a, Index b, Index constraint, std::vector<ConstrainedPiece>& pieces) {
    axis_ = axis_beside(a, b);
    sense_ = sense(a, b);
    // The first vertex in the inside of the arc tells the direction. Without one the two are
    // neighbors, perhaps on both sides.
    const std::size_t back = ring_.size() - 1;
    const bool is_ahead = is_inside(a, b, next(a, 1));
    if (!is_ahead && !is_inside(a, b, next(a, back))) {
      pieces.push_back(piece_between(a, b, constraint));
      return;
    }
    const std::size_t step = is_ahead ? 1 : back;
    for (Index v = a; v != b;) {
      const Index w = next(v, step);
      pieces.push_back(piece_between(v, w, constraint));
      v = w;
    }
  }

 private:
  [[nodiscard]] Index next(Index v, std::size_t step) const {
    return ring_[(places_[v] + step) % ring_.size()];
  }
  [[nodiscard]] Sign sense(Index a, Index b) const {
    return orientation(sites_.point(a), sites_.point(b), axis_, sphere_);
  }
  // True if a vertex is in the inside of the arc ab.
  [[nodiscard]] bool is_inside(Index a, Index b, Index v) const {
    return sense(a, v) == sense_ && sense(v, b) == sense_;
  }
  // Returns a point that is not in one plane with the arc.
  [[nodiscard]] Point axis_beside(Index a, Index b) const {
    unsigned axis = 0;
    while (orientation(sites_.point(a), sites_.point(b), proof::axis_point(sphere_.center, axis),
                       sphere_) == Sign::zero) {
      ++axis;
    }
    return proof::axis_point(sphere_.center, axis);
  }

  std::span<const Index> ring_;
  const NamedSites& sites_;
  Sphere sphere_;
  std::vector<Index> places_;
  Point axis_;
  Sign sense_ = Sign::zero;
};

}  // namespace

NamedSites::NamedSites(std::span<const Point> sites, std::span<const Duplicate> duplicates)
    : sites_(sites) {
  if (duplicates.empty()) return;
  names_.resize(sites_.size());
  for (Index i = 0; i < sites_.size(); ++i) names_[i] = i;
  speakers_ = names_;
  for (const auto& [site, representative] : duplicates) {
    names_[site] = representative;
    Index& speaker = speakers_[representative];
    if (is_less(sites_[site], sites_[speaker])) speaker = site;
  }
}

void require_arc(std::span<const Point> sites, const std::array<Index, 2>& ends,
                 const Sphere& sphere, const std::string& what, std::size_t position) {
  const auto [a, b] = ends;
  if (a == b) throw InvalidInput(what + " begins and ends at site " + text_of(a), position);
  const auto both = [&, first = a, second = b] {
    return what + " joins sites " + text_of(first) + " and " + text_of(second);
  };
  if (is_same_site(sites[a], sites[b], Model::projected, sphere)) {
    throw InvalidInput(both() + ", which are in one place", position);
  }
  if (are_dependent(sites[a], sites[b], sphere)) {
    throw InvalidInput(both() + ", which are opposite to each other", position);
  }
}

void require_arcs(std::span<const Point> sites, std::span<const std::array<Index, 2>> constraints,
                  const Sphere& sphere) {
  if (constraints.size() >= no_index) throw InvalidInput("there are too many constraints");
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (i + system::prefetch_distance < constraints.size()) {
      for (const Index site : constraints[i + system::prefetch_distance]) {
        if (site < sites.size()) system::prefetch(&sites[site]);
      }
    }
    const auto [a, b] = constraints[i];
    const auto what = [i] { return "constraint " + text_of(i); };
    for (const Index site : constraints[i]) {
      if (site < sites.size()) continue;
      throw InvalidInput(what() + " ends at site " + text_of(site) + ", but there are " +
                             text_of(sites.size()) + " sites",
                         i);
    }
    if (a == b || !are_surely_independent(sites[a], sites[b], sphere)) {
      require_arc(sites, constraints[i], sphere, what(), i);
    }
  }
}

std::vector<ConstrainedPiece> pieces_on_ring(const Triangulation& triangulation,
                                             const NamedSites& sites,
                                             std::span<const std::array<Index, 2>> ends) {
  std::vector<ConstrainedPiece> pieces;
  RingArcs arcs(triangulation, sites);
  for (Index i = 0; i < ends.size(); ++i) arcs.append(ends[i][0], ends[i][1], i, pieces);
  return pieces;
}

}  // namespace rondel::constrained
