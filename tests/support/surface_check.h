// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Properties of a triangulation that need no second triangulation, for any number of sites.
#pragma once

#include <span>
#include <sstream>
#include <string>

#include "rondel/triangulation.h"

namespace rondel::test {

// Returns the texts of the arguments, one after the other.
template <typename... Args>
std::string text_of_all(const Args&... args) {
  std::ostringstream out;
  (out << ... << args);
  return out.str();
}

// Each returns what is wrong first, or nothing.

// Indices in range, neighbors mutual, one closed surface with 2V-4 faces, each site accounted for.
std::string topology_error(const Triangulation& triangulation);

// The canonical order, as far as it can be told without knowing the spatial order.
std::string order_error(const Triangulation& triangulation);

// Every edge is regular after the perturbation, ghost flags are right, and a ray from
// inside leaves the surface once: together a proof that the surface is the perturbed hull of
// its vertices. Duplicates and hidden sites are checked too.
std::string geometry_error(const Triangulation& triangulation, std::span<const Point> sites);

}  // namespace rondel::test
