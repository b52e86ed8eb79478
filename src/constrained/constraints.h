// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The constraints as they are given, and the edges that they become.
//
// in    pairs of sites, in the order of the input
// out   InvalidInput for those that have no arc; pieces in dimension 0 and 1
// index names: a site, of duplicates the lowest one; constraints in the order of the input
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::constrained {

// An edge of the result, and one constraint that it is a part of.
struct ConstrainedPiece {
  Index low;
  Index high;
  Index constraint;
  friend auto operator<=>(const ConstrainedPiece&, const ConstrainedPiece&) = default;
};

inline ConstrainedPiece piece_between(Index a, Index b, Index constraint) {
  return a < b ? ConstrainedPiece{a, b, constraint} : ConstrainedPiece{b, a, constraint};
}

// The vertices under their names, and whose coordinates count for each: of duplicates those of the
// lexicographically smallest one.
class NamedSites {
 public:
  NamedSites(std::span<const Point> sites, std::span<const Duplicate> duplicates);

  [[nodiscard]] std::size_t size() const { return sites_.size(); }
  [[nodiscard]] Index name(Index site) const { return names_.empty() ? site : names_[site]; }
  [[nodiscard]] const Point& point(Index name) const {
    return sites_[speakers_.empty() ? name : speakers_[name]];
  }

 private:
  std::span<const Point> sites_;
  std::vector<Index> names_;     // by site; empty: there are no duplicates
  std::vector<Index> speakers_;  // by name; empty: there are no duplicates
};

// Throws InvalidInput with this position if two sites have no arc. `what` begins the message.
void require_arc(std::span<const Point> sites, const std::array<Index, 2>& ends,
                 const Sphere& sphere, const std::string& what, std::size_t position);

// Throws InvalidInput with the position of the first constraint that has no arc. The sites are
// valid.
void require_arcs(std::span<const Point> sites, std::span<const std::array<Index, 2>> constraints,
                  const Sphere& sphere);

// Returns the pieces of constraints between the vertices of a ring, in dimension 0 and 1.
std::vector<ConstrainedPiece> pieces_on_ring(const Triangulation& triangulation,
                                             const NamedSites& sites,
                                             std::span<const std::array<Index, 2>> ends);

}  // namespace rondel::constrained
