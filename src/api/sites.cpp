// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites: points that the object owns, copied or moved into it, or a view of points that somebody
// else owns. Copies of Sites share the points; one that was moved from has none.

#include "rondel/sites.h"

#include <algorithm>
#include <utility>

#include "api/validation.h"

namespace rondel {

Sites::Sites(std::vector<Point>&& points) {
  auto owner = std::make_shared<const std::vector<Point>>(std::move(points));
  points_ = *owner;
  owner_ = std::move(owner);
}

Sites::Sites(const std::vector<Point>& points) : Sites(std::span(points)) {}

// The number is validated before anything is allocated for the copy.
Sites::Sites(std::span<const Point> points) {
  api::validate({}, points.size());
  *this = Sites(std::vector<Point>(points.begin(), points.end()));
}

Sites::Sites(Sites&& other) noexcept
    : points_(std::exchange(other.points_, {})), owner_(std::move(other.owner_)) {}

Sites& Sites::operator=(Sites&& other) noexcept {
  points_ = std::exchange(other.points_, {});
  owner_ = std::exchange(other.owner_, nullptr);
  return *this;
}

Sites Sites::view(std::span<const Point> points, std::shared_ptr<const void> owner) {
  Sites sites;
  sites.points_ = points;
  sites.owner_ = std::move(owner);
  return sites;
}

// True if the coordinates are equal, so 0 equals -0; who owns the points plays no part.
bool operator==(const Sites& a, const Sites& b) { return std::ranges::equal(a.points_, b.points_); }

}  // namespace rondel
