// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What must be known of all sites before any bucket is triangulated.
//
// in    the sites, some after the other
// out   how far from the center they are, and on which sides of it; some of them that stand for all
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "bulk/input.h"
#include "rondel/export.h"

namespace rondel::bulk {

class RONDEL_API AllSites {
 public:
  AllSites() = default;
  explicit AllSites(const system::Job& options);

  void add(std::span<const Point> sites);
  // Adds the sites that `others` has seen.
  void add(const AllSites& others);

  [[nodiscard]] const Extent& extent() const { return extent_; }
  // Before the sites of a piece of the triangulation, they make the piece's circumcenters those of the
  // whole. The scale of weighted sites asks for the one with the largest coordinate (or one of them).
  // The normal of corners in line asks for the first site that is not on some line or plane through the
  // center, so the first three that span space with it come first: the sites before the second one are
  // in line with the first one, those before the third one in a plane with both.
  [[nodiscard]] std::vector<Point> landmarks() const;
  // Whether the center is inside the hull of the sites, told by the octants in which they are: all.
  // What is hidden in a bucket is hidden then.
  [[nodiscard]] bool surround_center() const;

 private:
  void take_larger(const Point& p);
  void take_spanning(const Point& p);

  Model model_ = Model::projected;
  Point center_ = {0, 0, 0};
  Extent extent_;
  Point largest_ = {0, 0, 0};
  std::array<Point, 3> spanning_ = {};  // the first ones, of weighted sites
  std::size_t num_spanning_ = 0;
  unsigned octants_ = 0;
};

}  // namespace rondel::bulk
