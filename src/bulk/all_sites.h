// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What must be known of all sites before any bucket is triangulated.
//
// in    the sites, some after the other
// out   how far from the center they are, and on which sides of it
#pragma once

#include <span>

#include "bulk/input.h"
#include "rondel/export.h"

namespace rondel::bulk {

class RONDEL_API AllSites {
 public:
  AllSites() = default;
  explicit AllSites(const system::Job& options);

  void add(std::span<const Point> sites);
  // Those that somebody else looked at.
  void add(const AllSites& others);

  [[nodiscard]] const Extent& extent() const { return extent_; }
  // The one with the largest coordinate, or one of them.
  [[nodiscard]] const Point& largest() const { return largest_; }
  // Whether the center is inside the hull of the sites, told by the octants in which they are: all.
  // What is hidden in a bucket is hidden then.
  [[nodiscard]] bool surround_center() const;

 private:
  void take_larger(const Point& p);

  Model model_ = Model::projected;
  Point center_ = {0, 0, 0};
  Extent extent_;
  Point largest_ = {0, 0, 0};
  unsigned octants_ = 0;
};

}  // namespace rondel::bulk
