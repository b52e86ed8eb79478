// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <limits>

#include "bulk/bucket.h"
#include "bulk/sphere.h"
#include "exact/vector.h"
#include "predicates/orientation.h"
#include "predicates/turn.h"

namespace rondel::bulk {

AllSites::AllSites(const system::Job& options)
    : model_(options.model), center_(options.sphere.center) {
  if (model_ == Model::weighted) extent_ = {std::numeric_limits<double>::infinity(), 0};
}

void AllSites::add(std::span<const Point> sites) {
  if (sites.empty()) return;
  for (const Point& p : sites) take_larger(p);
  for (std::size_t i = 0; i < sites.size() && num_spanning_ < spanning_.size(); ++i)
    take_spanning(sites[i]);
  octants_ |= octants_of(sites, center_);
  system::Job options;
  options.model = model_;
  options.sphere.center = center_;
  const Extent extent = make_input(sites, {}, options).extent;
  extent_.min_size = std::min(extent_.min_size, extent.min_size);
  extent_.max_size = std::max(extent_.max_size, extent.max_size);
}

void AllSites::take_larger(const Point& p) {
  if (exact::largest_coordinate(p) > exact::largest_coordinate(largest_)) largest_ = p;
}

// The three spanning sites of other sites suffice. The sites between two of these three are in line
// or in a plane with those before, so none of them is the first one that is not.
void AllSites::take_spanning(const Point& p) {
  if (model_ == Model::projected || num_spanning_ == spanning_.size()) return;
  const auto& [first, second, third] = spanning_;
  const bool is_new = num_spanning_ == 0 ? p != center_
                      : num_spanning_ == 1
                          ? !predicates::are_collinear(center_, first, p)
                          : predicates::orientation(first, second, p, center_).sign != Sign::zero;
  if (is_new) spanning_[num_spanning_++] = p;
}

std::vector<Point> AllSites::landmarks() const {
  std::vector<Point> result(spanning_.begin(), spanning_.begin() + num_spanning_);
  result.push_back(largest_);
  return result;
}

void AllSites::add(const AllSites& others) {
  take_larger(others.largest_);
  for (std::size_t i = 0; i < others.num_spanning_; ++i) take_spanning(others.spanning_[i]);
  octants_ |= others.octants_;
  extent_.min_size = std::min(extent_.min_size, others.extent_.min_size);
  extent_.max_size = std::max(extent_.max_size, others.extent_.max_size);
}

bool AllSites::surround_center() const { return octants_ == all_octants; }

}  // namespace rondel::bulk
