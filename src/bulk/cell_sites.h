// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites of a block in the coordinates in which divide and conquer sees them.
//
// Let z be the coordinate of a ray along the axis of the block's face of the cube, x and y the
// other two. The map (x, y, z) -> (u, v, w) = (x/z, y/z, s/z), with a scale s > 0, takes planes to
// planes and planes through the center to vertical ones, and keeps their sides where z > 0. So (u,
// v) is the place of the ray on the face of the cube, the orientation of three rays is that of
// their places in the plane, and the conflict test is the orientation of four points in space, as
// before:
//
//     w |      .   y          N = (r - l) x (x - l), the normal of the face (l, r, x):
//       |   .     / \         N.w > 0    x lies to the left of the edge (l, r);
//       | l------r---x        N.(y-l) < 0    y lies beyond the face, away from the center.
//       +------------ (u, v)
//
// In the weighted model s is one number for all. In the projected model s = |p|, and w is the
// height of w = sqrt(1 + u^2 + v^2) over its tangent plane in the middle of the cell: no plane
// becomes another one, and small cells have small numbers with small errors. Doubles decide when
// they can (docs/theory/blocks.md), else the traits class does.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bulk/accurate_places.h"
#include "bulk/cell_point.h"
#include "bulk/cells.h"
#include "incremental/projected_points.h"
#include "incremental/sphere_traits.h"
#include "incremental/weighted_points.h"

namespace rondel::bulk {

// Values beyond these are proven for all sites of a cell, which saves the lengths of the vectors.
struct CellLimits {
  double orientation;
  double conflict;
};

// blocks::CubePosition on a known face.
struct CellPosition {
  std::uint64_t u;
  std::uint64_t v;
};

// What the sites of all blocks have in common.
struct Extent {
  double least_size = 1;  // distances from the center, at least and at most, for weighted sites
  double most_size = 1;   // 1 in the projected model
};

template <incremental::SphereTraits T>
class CellSites {
 public:
  // The sites sites[order[0]], sites[order[1]], ... of this cell. Also finds their positions, which
  // are those of the spatial order.
  void assign(std::span<const Point> sites, std::span<const Index> order, const Point& center,
              const Cell& cell, const Extent& extent);

  [[nodiscard]] Index size() const { return static_cast<Index>(points_.size()); }
  [[nodiscard]] const CellPoint* points() const { return points_.data(); }
  [[nodiscard]] const Point& site(Index i) const { return sites_[order_[i]]; }
  [[nodiscard]] const Point& center() const { return center_; }
  [[nodiscard]] const std::vector<CellPosition>& positions() const { return positions_; }
  void set_position(Index i, const CellPosition& position) { positions_[i] = position; }

  // The vector from the center to a site, within a few units: in right-handed axes of which the
  // third leads to the middle of the face, and the others run along it, the second one against the
  // direction of positions if hand() is -1. Of unit length in the projected model.
  [[nodiscard]] predicates::Vector ray(Index i) const {
    const CellPoint& p = points_[i];
    const double z = 1 / p.size;
    return {z * p.u, z * p.v, z};
  }
  [[nodiscard]] double hand() const { return hand_; }

  // For the sites of a cell that is this long in u and v.
  [[nodiscard]] CellLimits limits(double length) const;

  // For sites with this largest distance: in u and v in the projected model, in space with weights.
  [[nodiscard]] double conflict_limit(double distance) const {
    return distance * distance * (square_bound_ + distance * cube_bound_);
  }

  // The rest of the ladder: a filter for the sites themselves, accurate places, the traits class.
  [[nodiscard]] Sign orientation(Index a, Index b, Index c) const;
  // `value` is N.(p-a).
  [[nodiscard]] bool is_in_conflict(Index a, Index b, Index c, Index p, double value) const;

  // In the projected model: positive if p lies above the face, over the tangent plane at a; zero if
  // this is not certain.
  [[nodiscard]] Sign side_over_tangent(Index a, Index b, Index c, Index p) const;

  // Of all conflict tests, given that this is called for those that did not come here.
  void count_filtered() const { ++num_filtered_; }
  [[nodiscard]] Tally tally() const;

 private:
  // Calls test(traits, a, b, ...) of the sites with these indices: few are given a traits class of
  // their own, many one for all sites of the block.
  template <std::size_t N, class Test>
  auto ask_traits(const std::array<Index, N>& indices, Test test) const;

  std::vector<CellPoint> points_;
  std::vector<CellPosition> positions_;
  std::span<const Point> sites_;
  std::span<const Index> order_;
  Point center_;
  Extent extent_;
  double hand_ = 1;
  double square_bound_ = 0;
  double cube_bound_ = 0;
  mutable AccuratePlaces accurate_;
  mutable T exact_;
  mutable T few_;
  mutable Index num_unsure_ = 0;
  mutable std::uint64_t num_filtered_ = 0;
  mutable Tally tally_{};  // of what the few were asked
};

extern template class CellSites<incremental::ProjectedPoints>;
extern template class CellSites<incremental::WeightedPoints>;

}  // namespace rondel::bulk
