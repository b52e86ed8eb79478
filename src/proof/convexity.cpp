// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "proof/convexity.h"

#include <algorithm>
#include <vector>

namespace rondel::proof {
namespace {

bool is_above_face(const PerturbedSites& sites, const Triple& face, Index site) {
  return sites.is_above(face[0], face[1], face[2], site);
}

// Three sites in line with the center stay in one plane with g, so they bound no hull; and
// without such faces no sign below is undecided. A line meets a sphere twice only.
std::string find_degenerate_face(const Surface& surface, const PerturbedSites& sites, Model model) {
  if (model == Model::projected) return {};
  for (Index f = 0; f < surface.num_faces(); ++f) {
    const auto& [a, b, c] = surface.face(f);
    if (sites.are_in_line_with_center(a, b, c)) {
      return "the corners of face " + text(f) + " lie in line with the center";
    }
  }
  return {};
}

std::string describe_edge(const Surface& surface, const PerturbedSites& sites, Index h,
                          Model model) {
  const Index g = surface.opposite(h);
  const auto& [a, b, c] = surface.face(h / 3);
  const std::string edge = "edge " + text(std::min(surface.origin(h), surface.target(h))) + "-" +
                           text(std::max(surface.origin(h), surface.target(h))) + " of faces " +
                           text(h / 3) + " and " + text(g / 3);
  const std::string apex = "site " + text(surface.apex(g));
  const bool is_weighted = model == Model::weighted;
  if (sites.side(a, b, c, surface.apex(g)) == Sign::zero) {
    return edge + " is not the canonical choice: its four sites are " +
           (is_weighted ? "coplanar" : "cocircular") + ", and the tie puts " + apex +
           (is_weighted ? " above face " : " inside the circle of face ") + text(h / 3);
  }
  return edge + " is not locally " + (is_weighted ? "regular: " : "Delaunay: ") + apex +
         (is_weighted ? " lies above face " : " lies inside the circle of face ") + text(h / 3);
}

// Symmetric in the two faces: exchanging them is an even permutation of the four sites.
std::string find_concave_edge(const Surface& surface, const PerturbedSites& sites, Model model) {
  for (Index h = 0; h < 3 * surface.num_faces(); ++h) {
    const Index g = surface.opposite(h);
    if (g < h) continue;
    if (is_above_face(sites, surface.face(h / 3), surface.apex(g))) {
      return describe_edge(surface, sites, h, model);
    }
  }
  return {};
}

struct PoleCount {
  std::size_t num_faces = 0;  // without the pole
  std::size_t num_above = 0;  // of these, with the pole above
  Index first_above = no_index;
};

PoleCount count_below_pole(const Surface& surface, const PerturbedSites& sites, Index pole) {
  PoleCount count;
  for (Index f = 0; f < surface.num_faces(); ++f) {
    if (contains(surface.face(f), pole)) continue;
    ++count.num_faces;
    if (!is_above_face(sites, surface.face(f), pole)) continue;
    ++count.num_above;
    count.first_above = std::min(count.first_above, f);
  }
  return count;
}

// Seen from outside the pole, all vertices of the link are left of its first edge, and their
// angles around the origin of that edge increase: (pole, a, b) has c below it when c is left of ab.
std::string find_winding_link(const Surface& surface, const PerturbedSites& sites, Index pole) {
  const std::vector<Index> ring = surface.link(pole);
  for (std::size_t i = 2; i < ring.size(); ++i) {
    if (sites.is_above(pole, ring[0], ring[1], ring[i]) ||
        sites.is_above(pole, ring[i - 1], ring[i], ring[0])) {
      return "the star of site " + text(pole) + " is not convex: sites " + text(ring[0]) + ", " +
             text(ring[i - 1]) + " and " + text(ring[i]) + " are out of order around it";
    }
  }
  return {};
}

}  // namespace

std::string find_concavity(const Surface& surface, const PerturbedSites& sites, Index pole,
                           Model model) {
  std::string flaw = find_degenerate_face(surface, sites, model);
  if (!flaw.empty()) return flaw;
  const PoleCount count = count_below_pole(surface, sites, pole);
  if (count.num_above == count.num_faces) {
    return "face " + text(count.first_above) +
           " is clockwise seen from outside, and so are all others without site " + text(pole);
  }
  // An edge says more than a far face, so it goes first.
  flaw = find_concave_edge(surface, sites, model);
  if (!flaw.empty()) return flaw;
  if (count.num_above > 0) {
    return "site " + text(pole) +
           (model == Model::weighted ? " lies above face " : " lies inside the circle of face ") +
           text(count.first_above);
  }
  return find_winding_link(surface, sites, pole);
}

}  // namespace rondel::proof
