// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The triangulation of a few sites by brute force: every ordered triple with which no other site is
// in conflict, all perturbed, is a face. O(n^4) exact tests, for n up to about 14.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "rondel/triangulation.h"
#include "support/oracle.h"

namespace rondel::test {

struct Hull {
  int dimension = -1;
  std::set<Triple> faces;  // input indices, each starting with its lowest
  std::set<Triple> ghosts;
  std::vector<Index> ring;  // dimension 1: the perturbed polygon, counterclockwise, from the lowest
  std::vector<Duplicate> duplicates;
  std::vector<Index> hidden;
};

Hull brute_force_hull(std::span<const Point> sites, Model model, const Sphere& sphere);

// Everything that the contract of rondel/triangulation.h says, compared with the
// brute-force hull; what differs first, or nothing.
std::string difference(const Triangulation& triangulation, std::span<const Point> sites,
                       const Hull& expected);

// The corners with the lowest first, their cyclic order kept.
Triple lowest_first(const Triple& face);

// The sites that are no duplicates, by the lowest index; `representative[i]` is the site whose
// coordinates stand for the place of `index[i]`: the lexicographically smallest there.
struct Places {
  std::vector<Index> index;
  std::vector<Point> representative;
  std::vector<Duplicate> duplicates;
};
Places distinct_places(std::span<const Point> sites, Model model, const Sphere& sphere);

}  // namespace rondel::test
