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
// height of w = sqrt(1 + u^2 + v^2) over its tangent plane in the middle of the square: no plane
// becomes another one, and small squares have small numbers with small errors. Doubles decide when
// they can (docs/theory/blocks.md), else the ladders of predicates/ do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bulk/accurate_places.h"
#include "bulk/square_point.h"
#include "bulk/squares.h"
#include "models/projected_points.h"
#include "models/sphere_traits.h"
#include "models/weighted_points.h"
#include "system/huge_pages.h"
#include "system/site_copies.h"

namespace rondel::bulk {

// Values beyond these are proven for all sites of a square, which saves the lengths of the vectors.
struct SquareLimits {
  double orientation;
  double conflict;
};

// order::CubePosition on a known face.
struct SquarePosition {
  std::uint64_t u;
  std::uint64_t v;
};

// Squares are split down to this bit of positions.
inline constexpr int least_bit = 14;

// Rounding moves positions by less than this.
inline constexpr std::uint64_t position_rounding = 4;

// Memory for the coordinates of sites, not initialized, in one piece.
class SquareCoordinates {
 public:
  SquareCoordinates() = default;
  SquareCoordinates(SquareCoordinates&&) = default;
  SquareCoordinates& operator=(SquareCoordinates&&) = default;

  static constexpr std::size_t bytes_of_site = sizeof(SquarePoint) + sizeof(SquarePosition);

  // For so many; forgets what there was if it has to grow.
  void reserve(std::size_t size) {
    if (size <= capacity_) return;
    memory_ = {};
    memory_ = system::make_large_array<std::byte>(size * bytes_of_site);
    capacity_ = size;
    place(memory_.get(), size);
  }
  // In memory of the caller.
  void place(std::byte* memory, std::size_t size) {
    points_ = reinterpret_cast<SquarePoint*>(memory);
    positions_ = reinterpret_cast<SquarePosition*>(memory + size * sizeof(SquarePoint));
  }

  [[nodiscard]] SquarePoint* points() { return points_; }
  [[nodiscard]] SquarePosition* positions() { return positions_; }

 private:
  system::LargeArray<std::byte> memory_;
  std::size_t capacity_ = 0;
  SquarePoint* points_ = nullptr;
  SquarePosition* positions_ = nullptr;
};

// What the sites of all blocks have in common.
struct Extent {
  double least_size = 1;  // distances from the center, at least and at most, for weighted sites
  double most_size = 1;   // 1 in the projected model
};

template <models::SphereModel T>
class SquareSites {
 public:
  // The sites sites[order[first]], sites[order[first + 1]], ..., num_sites of them in one or
  // several squares. They are named by their place in `order`, which is also that of their
  // coordinates. Perhaps there are copies of the sites in this order; only enter() reads them.
  void assign(std::span<const Point> sites, std::span<const Index> order, Index first,
              Index num_sites, const Point& center, const Extent& extent,
              SquareCoordinates& coordinates, const system::SiteCopies& copies = {});

  // From now on questions are about so many of the sites that follow, which are in this square.
  // Finds their coordinates, and their positions, which are those of the spatial order.
  void enter(const Square& square, Index num_sites);
  // Those of them whose positions may be wrong where squares are split.
  [[nodiscard]] const std::vector<Index>& doubtful() const { return doubtful_; }

  [[nodiscard]] const SquarePoint* points() const { return points_; }
  [[nodiscard]] const Point& point(Index i) const { return sites_[order_[i]]; }
  [[nodiscard]] const Point& center() const { return center_; }
  [[nodiscard]] const SquarePosition* positions() const { return positions_; }
  void set_position(Index i, const SquarePosition& position) { positions_[i] = position; }

  // The vector from the center to a site, within a few units: in right-handed axes of which the
  // third leads to the middle of the face, and the others run along it, the second one against the
  // direction of positions if hand() is -1. Of unit length in the projected model.
  [[nodiscard]] predicates::Vector ray(Index i) const {
    const SquarePoint& p = points_[i];
    const double z = 1 / p.size;
    return {z * p.u, z * p.v, z};
  }
  [[nodiscard]] double hand() const { return hand_; }

  // For the sites of a square that is this long in u and v.
  [[nodiscard]] SquareLimits limits(double length) const;
  // For those of a part of this square that has 2^bits positions either way.
  [[nodiscard]] const SquareLimits& limits_of(int bits) const {
    return limits_[static_cast<std::size_t>(bits)];
  }

  // For sites with this largest distance: in u and v in the projected model, in space with weights.
  [[nodiscard]] double conflict_limit(double distance) const {
    return distance * distance * (square_bound_ + distance * cube_bound_);
  }

  // What the limits leave open: filters for the very sites, then the ladders of
  // predicates/orientation.h and, above its filter, predicates/conflict.h.
  [[nodiscard]] Sign orientation(Index a, Index b, Index c);
  // `value` is N.(p-a).
  [[nodiscard]] bool is_in_conflict(Index a, Index b, Index c, Index p, double value);

  // In the projected model: positive if p lies above the face, over the tangent plane at a; zero if
  // this is not certain.
  [[nodiscard]] Sign side_over_tangent(Index a, Index b, Index c, Index p) const;

  // Of all conflict tests, given that this is called for those that the limits decided.
  void count_filtered() { ++tally_.filter; }
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  static constexpr bool is_weighted = T::model == Model::weighted;

  void find_bounds(int bits);
  // Reads the sites from `first` on; more will be read, up to `end`.
  void read_sites(std::size_t first, std::size_t end, std::span<Point> sites) const;

  // Returns decide(points, names) of these sites in a source of points and by their names there: on
  // the stack for few questions, for many in the model of all sites, which remembers.
  template <std::size_t N, class Decide>
  predicates::Decision ask_ladder(const std::array<Index, N>& indices, Decide decide);

  SquarePoint* points_ = nullptr;
  SquarePosition* positions_ = nullptr;
  std::span<const Point> sites_;
  std::span<const Index> order_;
  system::SiteCopies copies_;
  Index first_ = 0;
  Index num_sites_ = 0;
  Index next_ = 0;  // the first site of the next square
  std::vector<Index> doubtful_;
  Point center_;
  Extent extent_;
  double hand_ = 1;
  int bits_ = -1;  // of the squares for which there are bounds
  std::array<SquareLimits, order::position_bits + 1> limits_;
  double square_bound_ = 0;
  double cube_bound_ = 0;
  AccuratePlaces accurate_;
  T all_;                               // of all sites, once many questions were asked
  Index num_unsure_ = 0;                // questions that came to the ladder
  std::uint64_t num_over_tangent_ = 0;  // what side_over_tangent() decided
  std::uint64_t num_ties_ = 0;          // and what it did not
  Tally tally_{};
};

extern template class SquareSites<models::ProjectedPoints>;
extern template class SquareSites<models::WeightedPoints>;

}  // namespace rondel::bulk
