// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/snapped_sides.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "exact/vector.h"
#include "overlay/corner_tree.h"

namespace rondel::overlay {
namespace {

// Returns the ends of a side, the same for both directions.
std::pair<Index, Index> ends_of(const OwnedSide& side) { return std::minmax(side.from, side.to); }

// Removes pairs of opposite sides of one owner.
void cancel_owned(std::vector<OwnedSide>& sides) {
  std::ranges::sort(sides, {}, [](const OwnedSide& side) {
    return std::tuple(ends_of(side), side.owner, side.from);
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t end = k;
    std::size_t num_upwards = 0;
    while (end < sides.size() && ends_of(sides[end]) == ends_of(sides[k]) &&
           sides[end].owner == sides[k].owner) {
      if (sides[end].from < sides[end].to) ++num_upwards;
      ++end;
    }
    const std::size_t num_downwards = end - k - num_upwards;
    const std::size_t num_left =
        std::max(num_upwards, num_downwards) - std::min(num_upwards, num_downwards);
    const auto [low, high] = ends_of(sides[k]);
    const Index owner = sides[k].owner;
    for (std::size_t i = 0; i < num_left; ++i) {
      sides[kept++] =
          num_upwards > num_downwards ? OwnedSide{low, high, owner} : OwnedSide{high, low, owner};
    }
    k = end;
  }
  sides.resize(kept);
}

}  // namespace

Snaps::Snaps(std::span<const Point> points, std::span<const OwnedSide> sides, double distance)
    : points_(points), distance_(distance) {
  std::vector<Index> corners;
  std::vector<std::pair<Index, Index>> ends;
  for (const OwnedSide& side : sides) {
    corners.push_back(side.from);
    corners.push_back(side.to);
    ends.push_back(ends_of(side));
  }
  const auto make_unique = [](auto& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
  };
  make_unique(corners);
  make_unique(ends);
  const CornerTree tree(points_, std::move(corners));
  for (const std::pair<Index, Index>& side : ends) {
    const Index low = side.first;
    const Index high = side.second;
    const Point& a = points_[low];
    const Point& b = points_[high];
    const Point step = b - a;
    // The arc is nearer to its chord than this.
    const double margin = dot(step, step) / 4 + distance_;
    if (is_nearly(a, b)) join(low, high);
    const Point lowest = {std::min(a.x, b.x) - margin, std::min(a.y, b.y) - margin,
                          std::min(a.z, b.z) - margin};
    const Point highest = {std::max(a.x, b.x) + margin, std::max(a.y, b.y) + margin,
                           std::max(a.z, b.z) + margin};
    tree.visit(lowest, highest, [&](Index corner) {
      if (corner != low && corner != high) take(low, high, corner);
    });
  }
  std::ranges::sort(passed_, {}, [](const PassedCorner& passed) {
    return std::tuple(passed.low, passed.high, passed.part, passed.corner);
  });
}

// True if two points are within the distance.
bool Snaps::is_nearly(const Point& a, const Point& b) const {
  const Point step = b - a;
  return dot(step, step) <= distance_ * distance_;
}

void Snaps::join(Index p, Index q) {
  if (!merged_) merged_.emplace(points_.size());
  merged_->join(p, q);
}

// Divides the side from `low` to `high` at a corner. A corner near an end is merged with that end.
void Snaps::take(Index low, Index high, Index corner) {
  const Point& a = points_[low];
  const Point& b = points_[high];
  const Point& c = points_[corner];
  if (is_nearly(a, c)) join(low, corner);
  if (is_nearly(b, c)) join(high, corner);
  if (is_nearly(a, c) || is_nearly(b, c)) return;
  const Point normal = cross(a, b - a);
  const double height = dot(normal, c - a);
  const double size = dot(normal, normal);
  if (!(height * height <= distance_ * distance_ * size)) return;
  const double part = dot(c - a, b - a);
  if (part > 0 && part < dot(b - a, b - a) && dot(c, a + b) > 0) {
    passed_.push_back({low, high, part, corner});
  }
}

// Returns the corners near a side, sorted along it.
std::span<const Snaps::PassedCorner> Snaps::passed_by(const OwnedSide& side) const {
  const auto ends = [](const PassedCorner& passed) { return std::pair(passed.low, passed.high); };
  const auto first = std::ranges::lower_bound(passed_, ends_of(side), {}, ends);
  return {first, std::ranges::upper_bound(first, passed_.end(), ends_of(side), {}, ends)};
}

bool Snaps::would_change(std::span<const OwnedSide> sides) const {
  return std::ranges::any_of(sides, [&](const OwnedSide& side) {
    return name(side.from) != side.from || name(side.to) != side.to || !passed_by(side).empty();
  });
}

std::vector<OwnedSide> Snaps::applied(std::span<const OwnedSide> sides) const {
  std::vector<OwnedSide> result;
  for (const OwnedSide& side : sides) {
    Index from = name(side.from);
    const auto go_to = [&](Index p) {
      const Index to = name(p);
      if (to != from) result.push_back({from, to, side.owner});
      from = to;
    };
    const auto passed = passed_by(side);
    for (std::size_t k = 0; k < passed.size(); ++k) {
      go_to(passed[side.from < side.to ? k : passed.size() - 1 - k].corner);
    }
    go_to(side.to);
  }
  cancel_owned(result);
  return result;
}

}  // namespace rondel::overlay
