// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Builds by simulated ranks, put together again, and the build in memory beside them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "distributed/rank_build.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/distributed.h"
#include "support/generators.h"
#include "support/simulated_ranks.h"

namespace rondel::test {

// What all ranks have, one behind the other.
struct RankResults {
  int dimension = -1;
  std::uint64_t num_faces = 0;
  std::uint64_t num_vertices = 0;
  std::vector<GlobalTriple> faces;
  std::vector<GlobalTriple> neighbors;
  std::vector<std::uint64_t> ghost_faces;
  std::vector<std::uint64_t> ring;
  std::vector<GlobalDuplicate> duplicates;
  std::vector<std::uint64_t> hidden;
  std::vector<std::uint64_t> owned_sites;
  std::vector<double> areas;
  std::vector<Point> circumcenters;
};

// The rank's sites: different shares, some of them empty.
inline std::span<const Point> share(std::span<const Point> sites, int rank, int num_ranks,
                                    std::uint64_t seed) {
  std::vector<std::size_t> cuts = {0, sites.size()};
  Random random(seed);
  for (int i = 1; i < num_ranks; ++i)
    cuts.push_back(static_cast<std::size_t>(random.below(sites.size() + 1)));
  std::ranges::sort(cuts);
  const auto r = static_cast<std::size_t>(rank);
  return sites.subspan(cuts[r], cuts[r + 1] - cuts[r]);
}

template <class T>
void append(std::span<const T> part, std::vector<T>& all) {
  all.insert(all.end(), part.begin(), part.end());
}

// Adds a rank's part behind those of the ranks before it. The points were kept.
inline void append(const DistributedTriangulation& part, std::span<const double> areas,
                   std::uint64_t first_number, RankResults& all, unsigned threads = 1) {
  EXPECT_EQ(part.first_face(), part.dimension() == 2 ? first_number + all.faces.size() : 0);
  const std::size_t end = all.faces.size() + part.num_own_faces();
  part.visit_faces([&](std::span<const GlobalTriple> faces) { append(faces, all.faces); });
  part.visit_neighbors([&](std::span<const GlobalTriple> faces) { append(faces, all.neighbors); });
  EXPECT_EQ(all.faces.size(), end);
  EXPECT_EQ(all.neighbors.size(), end);
  part.visit_circumcenters([&](std::span<const Point> rows) { append(rows, all.circumcenters); },
                           {.threads = threads});
  EXPECT_EQ(all.circumcenters.size(), end);
  append(areas, all.areas);
  append(part.ghost_faces(), all.ghost_faces);
  append(part.ring(), all.ring);
  append(part.duplicates(), all.duplicates);
  append(part.hidden(), all.hidden);
  append(part.owned_sites(), all.owned_sites);
  all.dimension = part.dimension();
  all.num_faces = part.num_faces();
  all.num_vertices = part.num_vertices();
}

// Also of zeros and of what is not a number.
template <class T>
bool are_same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline void expect_same(const RankResults& result, const Triangulation& expected,
                        std::uint64_t first_number) {
  const auto triples = [&](std::span<const Triple> values) {
    std::vector<GlobalTriple> shifted;
    for (const Triple& v : values)
      shifted.push_back({first_number + v[0], first_number + v[1], first_number + v[2]});
    return shifted;
  };
  const auto numbers = [&](std::span<const Index> values) {
    std::vector<std::uint64_t> shifted;
    for (const Index v : values) shifted.push_back(first_number + v);
    return shifted;
  };
  EXPECT_EQ(result.dimension, expected.dimension());
  EXPECT_EQ(result.num_faces, expected.num_faces());
  EXPECT_EQ(result.num_vertices, expected.num_vertices());
  EXPECT_TRUE(result.faces == triples(expected.faces()));
  EXPECT_TRUE(result.neighbors == triples(expected.neighbors()));
  EXPECT_TRUE(result.ghost_faces == numbers(expected.ghost_faces()));
  EXPECT_TRUE(result.ring == numbers(expected.ring()));
  std::vector<GlobalDuplicate> duplicates;
  for (const Duplicate& d : expected.duplicates())
    duplicates.push_back({first_number + d.site, first_number + d.representative});
  EXPECT_TRUE(result.duplicates == duplicates);
  std::vector<std::uint64_t> hidden;
  for (const Hidden& h : expected.hidden()) hidden.push_back(first_number + h.site);
  EXPECT_TRUE(result.hidden == hidden);
  EXPECT_TRUE(are_same_bits(result.areas, areas(expected)));
  EXPECT_TRUE(are_same_bits(result.circumcenters, circumcenters(expected)));
  EXPECT_EQ(result.owned_sites.size() + duplicates.size(), expected.num_sites());
}

}  // namespace rondel::test
