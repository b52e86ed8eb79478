// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations of few sites, some of them at a time: where divide and conquer ends. Each lane of a
// vector has sites of its own, so that no decision waits for another one and none is a branch.
//
// All triples of the sites are tested against all other sites. A triple is a face if none of them is
// in conflict with it. The volume of four sites a < b < c < d, N.(d - a) with the normal N of (a, b,
// c), tells for each of the four whether it is in conflict with the triple of the others.
//
// in    coordinates of a square (SquareSites), and what filters of a merge step allow there
// out   faces, as bits of triples, and whether all signs are certain; edges in a graph
// index sites of a leaf: 0, 1, ...; local sites in the graph
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bulk/plane_graph.h"
#include "bulk/square_sites.h"
#include "system/wide_vectors.h"

namespace rondel::bulk {

inline constexpr Index max_leaf_sites = 8;
inline constexpr std::size_t num_leaf_lanes = 8;

// How many tests of four sites there are in a leaf of so many.
constexpr std::size_t num_volumes(std::size_t n) { return n * (n - 1) * (n - 2) * (n - 3) / 24; }

// Leaves with equally many sites, one in each lane. Not initialized.
struct alignas(64) LeafGroup {
  template <class T>
  using Lanes = system::PlainArray<T, num_leaf_lanes>;
  template <class T>
  using BySite = system::PlainArray<Lanes<T>, max_leaf_sites>;

  void set(std::size_t lane, const SquarePoint* points, const SquareLimits& limits) {
    for (std::size_t i = 0; i < num_sites; ++i) {
      u[i][lane] = points[i].u;
      v[i][lane] = points[i].v;
      w[i][lane] = points[i].w;
    }
    orientation_limit[lane] = limits.orientation;
    conflict_limit[lane] = limits.conflict;
  }

  // Gives a lane what the first one has.
  void repeat(std::size_t lane) {
    for (std::size_t i = 0; i < num_sites; ++i) {
      u[i][lane] = u[i][0];
      v[i][lane] = v[i][0];
      w[i][lane] = w[i][0];
    }
    orientation_limit[lane] = orientation_limit[0];
    conflict_limit[lane] = conflict_limit[0];
  }

  BySite<double> u;
  BySite<double> v;
  BySite<double> w;
  Lanes<double> orientation_limit;
  Lanes<double> conflict_limit;
  // Bits of triples that are faces, and of those that are clockwise.
  Lanes<std::uint64_t> faces;
  Lanes<std::uint64_t> clockwise;
  // All bits, or none if a filter is not certain; then the others say nothing.
  Lanes<std::uint64_t> certain;
  std::size_t num_sites;
};

// Finds the faces of all leaves of a group of three sites or more.
void find_leaf_faces(LeafGroup& group);

// Draws the faces that the leaf in this lane has, of which `first` is the first site. Precondition: all
// signs are certain.
Part draw_leaf(PlaneGraph& graph, const LeafGroup& group, std::size_t lane, Index first);

}  // namespace rondel::bulk
