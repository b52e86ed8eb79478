// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/all_sites.h"

#include <algorithm>
#include <limits>

#include "bulk/sphere.h"
#include "exact/vector.h"

namespace rondel::bulk {

AllSites::AllSites(const system::Job& options)
    : model_(options.model), center_(options.sphere.center) {
  if (model_ == Model::weighted) extent_ = {std::numeric_limits<double>::infinity(), 0};
}

void AllSites::add(std::span<const Point> sites) {
  if (sites.empty()) return;
  for (const Point& p : sites) take_larger(p);
  octants_ |= octants_of(sites, center_);
  system::Job options;
  options.model = model_;
  options.sphere.center = center_;
  const Extent extent = make_input(sites, {}, options).extent;
  extent_.least_size = std::min(extent_.least_size, extent.least_size);
  extent_.most_size = std::max(extent_.most_size, extent.most_size);
}

void AllSites::take_larger(const Point& p) {
  if (exact::largest_coordinate(p) > exact::largest_coordinate(largest_)) largest_ = p;
}

void AllSites::add(const AllSites& others) {
  take_larger(others.largest_);
  octants_ |= others.octants_;
  extent_.least_size = std::min(extent_.least_size, others.extent_.least_size);
  extent_.most_size = std::max(extent_.most_size, others.extent_.most_size);
}

bool AllSites::surround_center() const { return octants_ == all_octants; }

}  // namespace rondel::bulk
