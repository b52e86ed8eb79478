// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Facets of the hull: neighboring faces are joined when they lie exactly in one
// plane, then the border of each facet is traced.

#include <algorithm>
#include <cstddef>

#include "dual/face_normal.h"
#include "dual/parts.h"
#include "dual/ring_walk.h"
#include "rondel/diagram.h"
#include "rondel/predicates.h"
#include "system/disjoint_sets.h"
#include "system/job.h"

namespace rondel {
namespace {

class FacetFinder {
 public:
  FacetFinder(const Triangulation& triangulation, unsigned threads)
      : triangulation_(triangulation),
        faces_(triangulation.faces()),
        neighbors_(triangulation.neighbors()),
        split_sites_(triangulation, threads),
        normals_(dual::circumcenters(triangulation, split_sites_)),
        sets_(faces_.size()) {}

  CompressedRows<Index> facets() {
    for (Index f = 0; f < faces_.size(); ++f) {
      for (Index i = 0; i < 3; ++i) {
        if (is_same_facet(f, i)) sets_.join(f, neighbors_[f][i]);
      }
    }
    return traced();
  }

 private:
  // Collinear corners (weighted, after the perturbation) lie in any plane through their
  // line; such a face joins the one across its longest edge, which covers the other two.
  [[nodiscard]] bool is_same_facet(Index f, Index i) const {
    if (is_degenerate(f)) return i == middle_corner(f);
    const Index g = neighbors_[f][i];
    if (g < f) return false;
    // Normals 4u from the truth that are more than 8u apart belong to different planes; on
    // the rim of a flat hull the plane is the same, but the normals are opposite.
    constexpr double twice_the_error = 16 * 0x1p-53;
    const auto d = dual::to_vector(normals_[f]) - dual::to_vector(normals_[g]);
    if (dot(d, d) > twice_the_error * twice_the_error) return false;
    const auto [a, b, c] = faces_[f];
    const Index p = faces_[g][dual::mirror_corner(faces_[f], i, faces_[g])];
    const auto sites = split_sites_.sites();
    return side_of_circle(sites[a], sites[b], sites[c], sites[p], triangulation_.model(),
                          triangulation_.sphere()) == Sign::zero;
  }

  [[nodiscard]] bool is_degenerate(Index f) const {
    const auto [a, b, c] = split_sites_.corners(f);
    return dual::is_degenerate(split_sites_, a, b, c);
  }

  // The corner between the other two on a line: the directions to them are opposite.
  [[nodiscard]] Index middle_corner(Index f) const {
    const auto direction = [&](Index i, Index j) {
      return split_sites_.direction(split_sites_.corners(f)[i], split_sites_.corners(f)[j]);
    };
    for (Index i = 0; i < 2; ++i) {
      if (dot(direction(i, dual::next_corner(i)), direction(i, dual::previous_corner(i))) < 0) {
        return i;
      }
    }
    return 2;
  }

  // The halfedge (f, i) is on the border of its facet.
  bool is_border(Index f, Index i) { return sets_[neighbors_[f][i]] != sets_[f]; }

  CompressedRows<Index> traced() {
    CompressedRows<Index> result;
    std::vector<bool> is_traced(faces_.size(), false);
    for (Index f = 0; f < faces_.size(); ++f) {
      for (Index i = 0; i < 3; ++i) {
        if (is_traced[sets_[f]] || !is_border(f, i)) continue;
        is_traced[sets_[f]] = true;
        trace(f, i, result);
      }
    }
    return result;
  }

  // A facet is a convex polygon, so its border is one cycle. After a border halfedge the next one
  // is found by turning around its head, inside the facet.
  void trace(Index first, Index i, CompressedRows<Index>& polygons) {
    const auto begin = static_cast<std::ptrdiff_t>(polygons.values.size());
    const Index first_corner = i;
    Index f = first;
    do {
      polygons.values.push_back(faces_[f][dual::next_corner(i)]);
      i = dual::next_corner(i);
      while (!is_border(f, i)) {
        const Index g = neighbors_[f][i];
        i = dual::next_corner(dual::mirror_corner(faces_[f], i, faces_[g]));
        f = g;
      }
    } while (f != first || i != first_corner);
    const auto polygon = polygons.values.begin() + begin;
    std::rotate(polygon, std::min_element(polygon, polygons.values.end()), polygons.values.end());
    polygons.end_row();
  }

  const Triangulation& triangulation_;
  std::span<const Triple> faces_;
  std::span<const Triple> neighbors_;
  dual::SplitSites split_sites_;
  std::vector<Point> normals_;
  system::DisjointSets sets_;
};

}  // namespace

CompressedRows<Index> merge_cocircular(const Triangulation& triangulation,
                                       const Execution& execution) {
  const system::Call call(execution);
  return FacetFinder(triangulation, execution.threads).facets();
}

}  // namespace rondel
