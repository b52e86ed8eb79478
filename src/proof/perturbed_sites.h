// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites as the triangulation sees them: exact signs of the orientation of four
// perturbed sites, from the ladder of predicates/conflict.h.
//
// The perturbation (docs/theory/check.md) raises each site from the center of the sphere and,
// infinitely less, from a point g strictly inside the hull. The ladder gives its sign, but
// when the four lie in one plane with the center it takes the side of g from the order
// of the face, and whether that is a face is what we want to know. Here a frame of independent
// sites defines g: infinitely near to the first of them, from there towards the second, and so on.
// A plane has g on the side of the first one that is not in it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "predicates/points.h"
#include "proof/sites_by_place.h"
#include "rondel/types.h"

namespace rondel::proof {

class PerturbedSites {
 public:
  // Sites and places must outlive the object.
  PerturbedSites(std::span<const Point> sites, const SitesByPlace& places, Model model,
                 const Sphere& sphere);

  [[nodiscard]] const Point& point(Index place) const {
    return sites_[places_.representative[place]];
  }

  [[nodiscard]] const Point& center() const { return sphere_.center; }
  // The unit vector of a place; in the projected model.
  [[nodiscard]] const predicates::Vector& direction(Index place) const {
    return directions_[place];
  }

  // -1 without sites, 0 with one place, 1 when all lie on one great circle (in one
  // plane with the center), otherwise 2.
  [[nodiscard]] int dimension() const { return dimension_; }
  // Three sites that are not on one great circle; only in dimension 2.
  [[nodiscard]] std::array<Index, 3> independent() const {
    return {frame_[0], frame_[1], frame_[2]};
  }

  // Whether d is above the plane of a, b, c, counterclockwise seen from above. The four are
  // lowest indices of different places; dimension() is 2.
  // 1. Never undecided, and odd under exchange of any two arguments, unless the four lie on one
  //    line with the center: those stay in one plane, and the answer is no.
  // 2. The same as rondel::is_in_conflict() where that is defined.
  [[nodiscard]] bool is_above(Index a, Index b, Index c, Index d) const;

  // On which side of the plane of a, b, c the place d is before the perturbation: positive above.
  [[nodiscard]] Sign side(Index a, Index b, Index c, Index d) const;

  // Whether a, b, c lie on one line with the center.
  [[nodiscard]] bool are_in_line_with_center(Index a, Index b, Index c) const;

 private:
  [[nodiscard]] Sign oriented(Index a, Index b, Index c) const;
  [[nodiscard]] bool are_dependent(Index a, Index b) const;
  [[nodiscard]] bool are_in_plane_with_center(Index a, Index b, Index c, Index d) const;
  void find_frame();
  [[nodiscard]] Sign side_of_inner(const std::array<Index, 3>& triple) const;
  [[nodiscard]] bool is_conflict(Index a, Index b, Index c, Index d) const;

  std::span<const Point> sites_;
  const SitesByPlace& places_;
  std::vector<predicates::Vector> directions_;  // projected: unit vectors, for the filter
  Model model_;
  Sphere sphere_;
  int dimension_ = -1;
  // frame_[3] is no_index when all sites lie in one plane.
  std::array<Index, 4> frame_{no_index, no_index, no_index, no_index};
};

}  // namespace rondel::proof
