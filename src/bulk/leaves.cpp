// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/leaves.h"

#include <bit>

namespace rondel::bulk {
namespace {

template <class T>
using Lanes = LeafGroup::Lanes<T>;

// The bit of sites a < b < c: by c, then by b, then by a.
constexpr std::uint64_t bit_of(std::size_t a, std::size_t b, std::size_t c) {
  return std::uint64_t{1} << (a + b * (b - 1) / 2 + c * (c - 1) * (c - 2) / 6);
}

// Bits of triples by their sites. Row (a, b, ...) of what is found for four sites a < b < c < d is read
// by d.
using BitsOfTriples = system::PlainArray<
    system::PlainArray<system::PlainArray<std::uint64_t, max_leaf_sites>, max_leaf_sites>,
    max_leaf_sites>;

constexpr BitsOfTriples make_bits() {
  BitsOfTriples bits{};
  for (std::size_t c = 2; c < max_leaf_sites; ++c) {
    for (std::size_t b = 1; b < c; ++b) {
      for (std::size_t a = 0; a < b; ++a) bits[a][b][c] = bit_of(a, b, c);
    }
  }
  return bits;
}

constexpr BitsOfTriples bits_of_triples = make_bits();

// Steps from one site to all that follow, lane by lane.
struct alignas(64) Steps {
  LeafGroup::BySite<double> u;
  LeafGroup::BySite<double> v;
  LeafGroup::BySite<double> w;
};

// What the lanes have found so far. A bit of a triple in `below` tells that a volume with it is negative,
// in `above` that one is positive, in the order in which the sites of the triple stand.
struct alignas(64) Found {
  Lanes<std::uint64_t> below;
  Lanes<std::uint64_t> above;
  Lanes<std::uint64_t> clockwise;
  Lanes<std::uint64_t> certain;
};

struct alignas(64) Normals {
  Lanes<double> x;
  Lanes<double> y;
  Lanes<double> z;
};

RONDEL_ALWAYS_INLINE inline double magnitude(double value) {
  constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & ~sign_bit);
}

// The steps from site a.
RONDEL_ALWAYS_INLINE inline void find_steps(const LeafGroup& group, std::size_t a, Steps& steps) {
  for (std::size_t i = a + 1; i < group.num_sites; ++i) {
    RONDEL_KEEP_LOOP
    for (std::size_t lane = 0; lane < num_leaf_lanes; ++lane) {
      steps.u[i][lane] = group.u[i][lane] - group.u[a][lane];
      steps.v[i][lane] = group.v[i][lane] - group.v[a][lane];
      steps.w[i][lane] = group.w[i][lane] - group.w[a][lane];
    }
  }
}

// The normals of (a, b, c), and on which side of the edge from a to b site c is. The formulas here and
// below are those of a merge step.
RONDEL_ALWAYS_INLINE inline void find_normals(const LeafGroup& group, const Steps& steps,
                                              std::size_t b, std::size_t c, std::uint64_t bit,
                                              Normals& normals, Found& found) {
  RONDEL_KEEP_LOOP
  for (std::size_t lane = 0; lane < num_leaf_lanes; ++lane) {
    const double bu = steps.u[b][lane];
    const double bv = steps.v[b][lane];
    const double bw = steps.w[b][lane];
    const double cu = steps.u[c][lane];
    const double cv = steps.v[c][lane];
    const double cw = steps.w[c][lane];
    const double z = bu * cv - bv * cu;
    normals.x[lane] = bv * cw - bw * cv;
    normals.y[lane] = bw * cu - bu * cw;
    normals.z[lane] = z;
    found.clockwise[lane] |= system::mask(z < 0) & bit;
    found.certain[lane] &= system::mask(magnitude(z) > group.orientation_limit[lane]);
  }
}

// The volumes with site d. If they are negative, `if_negative` are the triples that they are negative
// for, and `if_positive` those that they are positive for; else it is the other way round.
RONDEL_ALWAYS_INLINE inline void find_volumes(const LeafGroup& group, const Steps& steps,
                                              const Normals& normals, std::size_t d,
                                              std::uint64_t if_negative, std::uint64_t if_positive,
                                              Found& found) {
  const std::uint64_t both = if_negative | if_positive;
  RONDEL_KEEP_LOOP
  for (std::size_t lane = 0; lane < num_leaf_lanes; ++lane) {
    const double volume = normals.x[lane] * steps.u[d][lane] + normals.y[lane] * steps.v[d][lane] +
                          normals.z[lane] * steps.w[d][lane];
    const std::uint64_t below = if_positive ^ (system::mask(volume < 0) & both);
    found.below[lane] |= below;
    found.above[lane] |= below ^ both;
    found.certain[lane] &= system::mask(magnitude(volume) > group.conflict_limit[lane]);
  }
}

RONDEL_ALWAYS_INLINE inline void find_faces(LeafGroup& group) {
  const BitsOfTriples& bits = bits_of_triples;
  const std::size_t n = group.num_sites;
  Steps steps;
  Normals normals;
  Found found;
  for (std::size_t lane = 0; lane < num_leaf_lanes; ++lane) {
    found.below[lane] = found.above[lane] = found.clockwise[lane] = 0;
    found.certain[lane] = ~std::uint64_t{0};
  }
  for (std::size_t a = 0; a + 2 < n; ++a) {
    find_steps(group, a, steps);
    for (std::size_t b = a + 1; b + 1 < n; ++b) {
      for (std::size_t c = b + 1; c < n; ++c) {
        const std::uint64_t abc = bits[a][b][c];
        find_normals(group, steps, b, c, abc, normals, found);
        for (std::size_t d = c + 1; d < n; ++d) {
          find_volumes(group, steps, normals, d, abc | bits[a][c][d], bits[a][b][d] | bits[b][c][d],
                       found);
        }
      }
    }
  }
  const std::uint64_t all = 2 * bit_of(n - 3, n - 2, n - 1) - 1;
  for (std::size_t lane = 0; lane < num_leaf_lanes; ++lane) {
    const std::uint64_t clockwise = found.clockwise[lane];
    group.faces[lane] =
        all & ((clockwise & ~found.above[lane]) | (~clockwise & ~found.below[lane]));
    group.clockwise[lane] = clockwise;
    group.certain[lane] = found.certain[lane];
  }
}

// Halfedges from site x to site y are named 8x + y here.
using Way = std::uint8_t;

constexpr Way way(std::size_t x, std::size_t y) { return static_cast<Way>(max_leaf_sites * x + y); }
constexpr std::size_t origin_of(std::size_t way) { return way / max_leaf_sites; }
constexpr std::size_t target_of(std::size_t way) { return way % max_leaf_sites; }
constexpr std::size_t reversed(std::size_t w) { return way(target_of(w), origin_of(w)); }

// The sides of a face in its order.
struct FaceSides {
  std::array<Way, 3> ways;
  std::uint64_t bits;
};

constexpr std::size_t num_triples = 56;
using FaceSidesByTriple = std::array<std::array<FaceSides, 2>, num_triples>;

constexpr FaceSides sides_of(std::size_t a, std::size_t b, std::size_t c) {
  const std::array<Way, 3> ways = {way(a, b), way(b, c), way(c, a)};
  return {ways,
          std::uint64_t{1} << ways[0] | std::uint64_t{1} << ways[1] | std::uint64_t{1} << ways[2]};
}

// By triple, then by whether it is clockwise.
constexpr FaceSidesByTriple make_sides() {
  FaceSidesByTriple sides{};
  for (std::size_t c = 2; c < max_leaf_sites; ++c) {
    for (std::size_t b = 1; b < c; ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        const auto triple = static_cast<std::size_t>(std::countr_zero(bit_of(a, b, c)));
        sides[triple] = {sides_of(a, b, c), sides_of(a, c, b)};
      }
    }
  }
  return sides;
}

constexpr FaceSidesByTriple sides_by_triple = make_sides();

// The ways x to y with x < y.
constexpr std::uint64_t make_upward() {
  std::uint64_t ways = 0;
  for (std::size_t y = 1; y < max_leaf_sites; ++y) {
    for (std::size_t x = 0; x < y; ++x) ways |= std::uint64_t{1} << way(x, y);
  }
  return ways;
}

constexpr std::uint64_t upward = make_upward();

// Turns all ways around (Hacker's Delight, 7-3).
constexpr std::uint64_t transposed(std::uint64_t ways) {
  std::uint64_t swapped = (ways ^ (ways >> 7U)) & 0x00AA00AA00AA00AA;
  ways ^= swapped ^ (swapped << 7U);
  swapped = (ways ^ (ways >> 14U)) & 0x0000CCCC0000CCCC;
  ways ^= swapped ^ (swapped << 14U);
  swapped = (ways ^ (ways >> 28U)) & 0x00000000F0F0F0F0;
  return ways ^ swapped ^ (swapped << 28U);
}

static_assert(transposed(upward) == ~upward - 0x8040201008040201);

// Calls visit(i) for each bit i that is set.
template <class Visit>
RONDEL_ALWAYS_INLINE inline void for_bits(std::uint64_t bits, Visit visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace

void find_leaf_faces(LeafGroup& group) {
  system::with_wide_vectors([&group]() RONDEL_ALWAYS_INLINE { find_faces(group); });
}

Part draw_leaf(PlaneGraph& graph, const LeafGroup& group, std::size_t lane, Index first) {
  const std::uint64_t faces = group.faces[lane];
  const std::uint64_t clockwise = group.clockwise[lane];
  std::uint64_t left = 0;  // ways with a face on their left
  for_bits(faces, [&](std::size_t i) { left |= sides_by_triple[i][clockwise >> i & 1U].bits; });
  const std::uint64_t right = transposed(left);
  std::array<PlaneGraph::Edge, std::size_t{max_leaf_sites} * max_leaf_sites> edges;
  const std::uint64_t pairs = (left | right) & upward;
  const PlaneGraph::Edge row =
      graph.new_pairs_in_row(static_cast<std::size_t>(std::popcount(pairs)));
  PlaneGraph::Edge next_pair = row;
  for_bits(pairs, [&](std::size_t w) {
    const PlaneGraph::Edge e = row == no_index ? graph.new_pairs<1>()[0] : next_pair;
    next_pair += 2;
    graph.set_ends(e, first + static_cast<Index>(origin_of(w)),
                   first + static_cast<Index>(target_of(w)));
    edges[w] = e;
    edges[reversed(w)] = e ^ 1;
  });
  for_bits(faces, [&](std::size_t i) {
    const auto& ways = sides_by_triple[i][clockwise >> i & 1U].ways;
    const PlaneGraph::Edge ab = edges[ways[0]];
    const PlaneGraph::Edge bc = edges[ways[1]];
    const PlaneGraph::Edge ca = edges[ways[2]];
    graph.link(ab, ca ^ 1);
    graph.link(bc, ab ^ 1);
    graph.link(ca, bc ^ 1);
  });
  // The outer face lies on the left of one way from each site of the boundary.
  const std::uint64_t outer = right & ~left;
  Part part;
  for_bits(outer, [&](std::size_t w) {
    const std::size_t site = target_of(w);
    const auto next = static_cast<std::size_t>(std::countr_zero(outer >> (max_leaf_sites * site)));
    const PlaneGraph::Edge back = edges[w] ^ 1;
    graph.link(edges[way(site, 0) + next], back);
    part = {first + static_cast<Index>(site), back};
  });
  return part;
}

}  // namespace rondel::bulk
