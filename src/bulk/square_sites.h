// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites of a square in the coordinates in which divide and conquer sees them.
//
// in    the sites of a piece, and one square after the other with the sites that are in it
// out   coordinates, positions, exact signs of orientations and conflict tests within the square
// index local sites
//
// Let z be the coordinate of a ray along the axis of the square's face of the cube, x and y the
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

#include "bulk/given_sites.h"
#include "bulk/squares.h"
#include "models/projected_points.h"
#include "models/weighted_points.h"

namespace rondel::bulk {

// With four numbers an index becomes an address by a shift.
struct alignas(32) SquarePoint {
  double u;
  double v;
  double w;
  double size;  // s/z
};

// order::CubePosition on a known face.
struct SquarePosition {
  std::uint64_t u;
  std::uint64_t v;
};

// Memory for the coordinates of the sites of a piece, not initialized.
struct SquareCoordinates {
  SquarePoint* points = nullptr;
  SquarePosition* positions = nullptr;
};

// Values beyond these are proven for all sites of a square, which saves the lengths of the vectors.
struct SquareLimits {
  double orientation;
  double conflict;
};

// Squares are split down to this bit of positions.
inline constexpr int min_bit = 14;

// Rounding moves positions by less than this.
inline constexpr std::uint64_t position_rounding = 4;

template <models::SphereModel T>
class SquareSites {
 public:
  static constexpr bool hides_sites = T::hides_sites;

  using Vector = predicates::Vector;  // (u, v, w)
  using Limits = SquareLimits;

  // The sites first ... first + num_sites - 1 of `given`, in one or several squares. Only enter()
  // reads the copies that `input` may have.
  void assign(const Input& input, const GivenSites<T>& given, Index first, Index num_sites,
              const SquareCoordinates& coordinates);

  // From now on questions are about so many of the sites that follow, which are in this square.
  // Finds their coordinates, and their positions, which are those of the spatial order.
  void enter(const Square& square, Index num_sites);
  // The entered sites whose positions may be wrong where squares are split.
  [[nodiscard]] const std::vector<Index>& doubtful() const { return doubtful_; }

  [[nodiscard]] const SquarePoint* points() const { return points_; }
  [[nodiscard]] Vector coordinates(Index i) const {
    const SquarePoint& p = points_[i];
    return {p.u, p.v, p.w};
  }
  [[nodiscard]] const Point& point(Index i) const { return given_->point(i); }
  [[nodiscard]] const Point& center() const { return given_->center(); }
  [[nodiscard]] const SquarePosition* positions() const { return positions_; }
  void set_position(Index i, const SquarePosition& position) { positions_[i] = position; }

  // The vector from the center to a site, within a few units: in right-handed axes of which the
  // third leads to the middle of the face, and the others run along it, the second one against the
  // direction of positions if hand() is -1. Of unit length in the projected model.
  [[nodiscard]] Vector ray(Index i) const {
    const SquarePoint& p = points_[i];
    const double z = 1 / p.size;
    return {z * p.u, z * p.v, z};
  }
  [[nodiscard]] double hand() const { return hand_; }

  // For the sites of a square that is this long in u and v.
  [[nodiscard]] SquareLimits limits(double length) const;
  // For the sites of a part of this square that has 2^bits positions either way.
  [[nodiscard]] const SquareLimits& limits_of(int bits) const {
    return limits_[static_cast<std::size_t>(bits)];
  }
  // For sites with this largest distance: in u and v in the projected model, in space with weights.
  [[nodiscard]] double conflict_limit(double distance) const {
    return distance * distance * (square_bound_ + distance * cube_bound_);
  }

  // The filters of one step of a merge, see GivenSites. Overflow leaves infinities and what is not a
  // number: not certain, too.
  [[nodiscard, gnu::always_inline]] static Sign certain_orientation(Limits limits,
                                                                    const Vector& /*l*/,
                                                                    const Vector& normal,
                                                                    const Vector& /*to_r*/,
                                                                    const Vector& /*to_x*/) {
    return beyond(normal.z, limits.orientation);
  }
  [[nodiscard, gnu::always_inline]] static Sign certain_side(Limits limits, double value,
                                                             const Vector& /*to_r*/,
                                                             const Vector& /*to_x*/,
                                                             const Vector& /*to_y*/) {
    return -beyond(value, limits.conflict);
  }

  // What the limits leave open: the ladder of predicates/orientation.h; filters for the very sites,
  // then the ladder of predicates/conflict.h above its filter.
  [[nodiscard]] Sign orientation(Index a, Index b, Index c) const;
  [[nodiscard]] bool is_in_conflict(Index a, Index b, Index c, Index p);

  // In the projected model: positive if p lies above the face, over the tangent plane at a; zero if
  // this is not certain.
  [[nodiscard]] Sign side_over_tangent(Index a, Index b, Index c, Index p) const;

  // The tally counts all conflict tests, provided that count_filtered() is called for those that
  // the limits decided.
  void count_filtered(std::uint64_t num = 1) { tally_.filter += num; }
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  static constexpr bool is_weighted = T::model == Model::weighted;

  [[gnu::always_inline]] static Sign beyond(double value, double limit) {
    if (value > limit) return Sign::positive;
    return value < -limit ? Sign::negative : Sign::zero;
  }
  void find_bounds(int bits);
  // Reads the sites from `first` on; more will be read, up to `end`.
  void read_sites(std::size_t first, std::size_t end, std::span<Point> sites) const;
  // Returns the sign of is_in_conflict() if a filter for these sites decides, and zero otherwise.
  [[nodiscard]] Sign filtered_side(Index a, Index b, Index c, Index p);

  SquarePoint* points_ = nullptr;
  SquarePosition* positions_ = nullptr;
  const GivenSites<T>* given_ = nullptr;
  std::span<const Point> sites_;
  std::span<const Index> order_;
  system::SiteCopies copies_;
  Index first_ = 0;
  Index num_sites_ = 0;
  Index next_ = 0;  // the first site of the next square
  std::vector<Index> doubtful_;
  Extent extent_;
  double hand_ = 1;
  int bits_ = -1;  // of the squares for which there are bounds
  std::array<SquareLimits, order::position_bits + 1> limits_;
  double square_bound_ = 0;
  double cube_bound_ = 0;
  T all_;                               // of all sites, once many questions were asked
  Index num_unsure_ = 0;                // conflict tests that came to the ladder
  std::uint64_t num_over_tangent_ = 0;  // what side_over_tangent() decided
  std::uint64_t num_ties_ = 0;          // and what it did not
  Tally tally_{};
};

extern template class SquareSites<models::ProjectedPoints>;
extern template class SquareSites<models::WeightedPoints>;

}  // namespace rondel::bulk
