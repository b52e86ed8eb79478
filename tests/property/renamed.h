// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations of the same sites under different names.
#pragma once

#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "rondel/triangulation.h"

namespace rondel::test {

// The arrays with every site under the name that `name` gives it.
struct Renamed {
  std::vector<Triple> faces;
  std::vector<Triple> neighbors;
  std::vector<Index> ghosts;
  std::vector<Index> ring;
  std::set<std::pair<Index, Index>> hidden;
  std::set<Index> duplicates;
  int dimension;
  friend bool operator==(const Renamed&, const Renamed&) = default;
};

// Duplicates share a name, that of their representative in the original order, so that it does not
// matter which of them is the vertex.
inline Renamed renamed(const Triangulation& t, const std::vector<Index>& name) {
  Renamed r;
  r.dimension = t.dimension();
  for (const Triple& f : t.faces()) r.faces.push_back({name[f[0]], name[f[1]], name[f[2]]});
  r.neighbors.assign(t.neighbors().begin(), t.neighbors().end());
  r.ghosts.assign(t.ghost_faces().begin(), t.ghost_faces().end());
  for (const Index v : t.ring()) r.ring.push_back(name[v]);
  for (const Hidden& h : t.hidden()) r.hidden.insert({name[h.site], h.face});
  for (const Duplicate& d : t.duplicates()) r.duplicates.insert(name[d.representative]);
  return r;
}

inline std::vector<Index> place_names(const Triangulation& t) {
  std::vector<Index> names(t.num_sites());
  std::iota(names.begin(), names.end(), Index{0});
  for (const Duplicate& d : t.duplicates()) names[d.site] = d.representative;
  return names;
}

}  // namespace rondel::test
