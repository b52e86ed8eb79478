// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A tripolar grid of the ocean: Mercator's rows, and a cap with two poles on land (R. J. Murray,
// Explicit generation of orthogonal grids for ocean models, J. Comput. Phys. 126, 1996, section 2).
//
// Columns are d = 360 / n degrees wide and begin at longitude 80, one of the two poles of the cap.
// Up to the joint, row border k is at the latitude whose Mercator ordinate is k d: cells are as high
// as they are wide. The cap beyond the joint is the northern half of another sphere, which a
// stereographic projection shrinks. There the poles A and B are on the equator, and the grid is that
// of meridians through A and B, every d degrees, and of the circles around A and B on which columns go
// on. As the projection keeps angles, lines cross at right angles, and cells beside the joint have
// the same width and height on both sides.
//
//                 north pole
//        B ----------- x ----------- A     the last border, the fold: columns i and n - 1 - i meet
//       / \____________|____________/ \    meridians through A and B
//      /  |       |    |    |        | \   circles around A, or around B
//     B --+-------+----+----+--------+- A  the joint, near 65 degrees north (half of it)
//
// in    the number of columns
// out   cells, row by row from the south, eastward within a row
// index lines at half steps, even ones are borders: h eastward from A, v northward from the south
//
// Invariant: a corner is computed from (h, v) alone, and the corners h and 2 n - h of the fold, which
// are one, from the smaller of both numbers.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "grids/grid_formula.h"
#include "rondel/delaunay.h"

namespace rondel::grids {
namespace {

// The pole A is in Siberia and B, 180 degrees away, in Canada, as in GFDL's ocean models.
constexpr double pole_lon_deg = 80;
// Mercator's ordinates asinh(tan(latitude)) in degrees: of 65 north, near which the joint is, and of
// 78, which the first row reaches in the south.
constexpr double ordinate_of_joint = 86.3134698287197;
constexpr double ordinate_of_south = 129.0760870392748;

// Returns exp(x) for 0 <= x < 8 with a relative error below 16 ulp, the same bits everywhere: a
// series for x / 16, of which the first term left out is below 2^-55, squared four times.
double exponential(double x) {
  constexpr int terms = 14;
  const double part = x / 16;
  double sum = 1;
  for (int k = terms; k >= 1; --k) sum = 1 + part * sum / k;
  for (int k = 0; k < 4; ++k) sum *= sum;
  return sum;
}

// Returns the sine and the cosine of the latitude of an ordinate.
exact::SineCosine latitude_at(double ordinate_deg) {
  const double power = exponential(2 * std::abs(ordinate_deg) / exact::degrees_per_radian);
  const double sine = (power - 1) / (power + 1);
  const double cosine = 2 * std::sqrt(power) / (power + 1);
  return {ordinate_deg < 0 ? -sine : sine, cosine};
}

class TripolarGrid : public GridFormula {
 public:
  explicit TripolarGrid(std::int64_t columns) : columns_(columns), pole_(turn(0)) {
    const double step = 360 / static_cast<double>(columns);
    const auto joint = static_cast<std::int64_t>(std::round(ordinate_of_joint / step));
    const auto south = static_cast<std::int64_t>(std::ceil(ordinate_of_south / step));
    joint_ = 2 * (joint + south);
    rows_ = joint + south + columns / 4;
    shrink_ = 1 / exponential(static_cast<double>(joint) * step / exact::degrees_per_radian);
    for (std::int64_t v = 0; v <= joint_; ++v) {
      parallels_.push_back(
          latitude_at((static_cast<double>(v) / 2 - static_cast<double>(south)) * step));
    }
    for (std::int64_t h = 0; h < 2 * columns; ++h) turns_.push_back(turn(h));
    for (std::int64_t h = 0; h <= columns; ++h) {
      angles_.push_back(exact::sine_cosine_of_degrees(static_cast<double>(180 * h) /
                                                      static_cast<double>(columns)));
    }
  }

  [[nodiscard]] Index num_cells() const override { return static_cast<Index>(rows_ * columns_); }
  [[nodiscard]] bool covers_sphere() const override { return false; }
  [[nodiscard]] std::vector<std::uint64_t> shape() const override {
    return {static_cast<std::uint64_t>(rows_), static_cast<std::uint64_t>(columns_)};
  }

  [[nodiscard]] LonLat center(Index cell) const override {
    const std::int64_t h = 2 * (cell % columns_) + 1;
    const std::int64_t v = 2 * (cell / columns_) + 1;
    if (v > joint_) return lonlats(std::vector<Point>{point(h, v)})[0];
    const exact::SineCosine& height = parallels_[static_cast<std::size_t>(v)];
    const double lon = lon_of(h);
    return {lon >= 180 ? lon - 360 : lon,
            exact::argument(height.sine, height.cosine) * exact::degrees_per_radian};
  }

  // Cells of the cap at A and B have three corners, others four.
  void append_ring(Index cell, std::vector<Point>& ring) const override {
    const std::int64_t h = 2 * (cell % columns_);
    const std::int64_t v = 2 * (cell / columns_);
    const std::array<Point, 4> corners = {point(h, v), point(h + 2, v), point(h + 2, v + 2),
                                          point(h, v + 2)};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (!(corners[k] == corners[(k + 1) % corners.size()])) ring.push_back(corners[k]);
    }
  }

 private:
  [[nodiscard]] double lon_of(std::int64_t h) const {
    return pole_lon_deg + static_cast<double>(180 * h) / static_cast<double>(columns_);
  }
  [[nodiscard]] exact::SineCosine turn(std::int64_t h) const {
    return exact::sine_cosine_of_degrees(lon_of(h));
  }

  [[nodiscard]] Point point(std::int64_t h, std::int64_t v) const {
    h %= 2 * columns_;
    // The lines through A and B meet there.
    const bool is_pole_of_cap = h == 0 || h == columns_;
    if (v > joint_ && !is_pole_of_cap) return point_of_cap(h, v - joint_);
    const exact::SineCosine& height = parallels_[static_cast<std::size_t>(std::min(v, joint_))];
    const exact::SineCosine& turn = turns_[static_cast<std::size_t>(h)];
    return {height.cosine * turn.cosine, height.cosine * turn.sine, height.sine};
  }

  // On the other sphere A is at (1, 0, 0). A point (x, y, z) of it has the projection (x, y) / (1 + z),
  // which is shrunk, and projected back.
  [[nodiscard]] Point point_of_cap(std::int64_t h, std::int64_t v) const {
    const bool is_beyond = h > columns_;
    const exact::SineCosine& from_a =
        angles_[static_cast<std::size_t>(is_beyond ? 2 * columns_ - h : h)];
    const exact::SineCosine& rise = angles_[static_cast<std::size_t>(v)];
    // Adding 0 makes a negative zero of the fold positive.
    const double y = (is_beyond ? -1 : 1) * (from_a.sine * rise.cosine) + 0.0;
    const double z = from_a.sine * rise.sine;
    const double above = 1 + z;
    const double below = shrink_ * shrink_ * (1 - z);
    const double wide = 2 * shrink_ / (above + below);
    const double east = wide * from_a.cosine;
    const double north = wide * y;
    return {east * pole_.cosine - north * pole_.sine, east * pole_.sine + north * pole_.cosine,
            (above - below) / (above + below)};
  }

  std::int64_t columns_;
  std::int64_t rows_ = 0;
  std::int64_t joint_ = 0;                    // its line
  double shrink_ = 0;                         // the tangent of half of the colatitude of the joint
  exact::SineCosine pole_;                    // of the longitude of A
  std::vector<exact::SineCosine> parallels_;  // up to the joint
  std::vector<exact::SineCosine> turns_;      // of the longitudes of columns
  std::vector<exact::SineCosine> angles_;     // from A to B
};

}  // namespace

std::unique_ptr<GridFormula> tripolar_grid(unsigned columns) {
  return std::make_unique<TripolarGrid>(columns);
}

}  // namespace rondel::grids
