// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// HEALPix. Places are those of a lattice on the sphere: a ring J, counted from the north pole, and
// a position T along it. The parallel of ring J has 8 S(J) positions, eastward from the meridian 0,
// with S = min(J, N, 4 N - J) where N is the number of steps along the side of a base pixel.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
#include "grids/grid_formula.h"
#include "meshing/point_rings.h"

namespace rondel::grids {
namespace {

// A place of the lattice within a quarter of the sphere: T is from 0 to 2 S.
struct LatticePlace {
  std::int64_t ring;
  std::int64_t position;
};

// A pixel: its base pixel, and its place there along the northeast and the northwest.
struct Pixel {
  std::int64_t face;
  std::int64_t x;
  std::int64_t y;
};

// Returns the number of every other bit.
std::int64_t compressed(std::uint64_t bits) {
  std::uint64_t result = 0;
  for (unsigned k = 0; k < 32; ++k) result |= (bits >> (2 * k) & 1U) << k;
  return static_cast<std::int64_t>(result);
}

std::int64_t floor_quotient(std::int64_t a, std::int64_t b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

// Returns the area between an arc and the north pole, positive if the arc leads east.
double area_north_of(const Point& p, const Point& q) {
  const double sine = p.x * (q.y - p.y) - p.y * (q.x - p.x);
  const double half = exact::argument(std::abs(sine), 1 + dot(p, q) + p.z + q.z);
  return sine < 0 ? -2 * half : 2 * half;
}

// Turns a point around the axis by quarters of a turn, exactly.
Point turned(const Point& p, std::int64_t quarters) {
  switch (quarters & 3) {
    case 1:
      return {-p.y, p.x, p.z};
    case 2:
      return {-p.x, -p.y, p.z};
    case 3:
      return {p.y, -p.x, p.z};
    default:
      return p;
  }
}

class HealpixGrid : public GridFormula {
 public:
  HealpixGrid(unsigned order, bool is_in_rings, GridSides sides)
      : side_(std::int64_t{1} << order),
        is_in_rings_(is_in_rings),
        // Coarse pixels have more corners, so that their sides are nearer to the curves.
        steps_(sides == GridSides::great_circles ? 1 : std::max(2, 32 >> order)),
        lattice_(side_ * steps_) {}

  [[nodiscard]] Index num_cells() const override { return static_cast<Index>(12 * side_ * side_); }

  [[nodiscard]] double equal_area() const override {
    return steps_ > 1 ? 4 * std::numbers::pi / static_cast<double>(12 * side_ * side_) : 0;
  }

  [[nodiscard]] LonLat center(Index cell) const override {
    const auto [ring, position] = is_in_rings_ ? ring_of(cell) : ring_of(pixel_of(cell));
    const mesh::PointRing row =
        mesh::healpix_ring(static_cast<std::size_t>(side_), static_cast<std::size_t>(ring));
    return {row.lon_deg(static_cast<std::size_t>(position)),
            exact::argument(row.z, row.radius) * exact::degrees_per_radian};
  }

  void append_ring(Index cell, std::vector<Point>& ring) const override {
    const Pixel pixel = is_in_rings_ ? pixel_in_ring(cell) : pixel_of(cell);
    // The corners in the south, east, north and west.
    constexpr std::int64_t along_x[] = {0, 1, 1, 0};
    constexpr std::int64_t along_y[] = {0, 0, 1, 1};
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      append_side({pixel.face, (pixel.x + along_x[k]) * steps_, (pixel.y + along_y[k]) * steps_},
                  along_x[next] - along_x[k], along_y[next] - along_y[k], ring);
    }
  }

 private:
  // A ring from 1 on, and the place of a pixel in it.
  struct RingPlace {
    std::int64_t ring;
    std::int64_t position;
  };

  [[nodiscard]] RingPlace ring_of(Index cell) const {
    const auto p = static_cast<std::int64_t>(cell);
    const std::int64_t in_cap = 2 * side_ * (side_ - 1);
    const std::int64_t all = 12 * side_ * side_;
    if (p >= in_cap && p < all - in_cap) {
      return {side_ + (p - in_cap) / (4 * side_), (p - in_cap) % (4 * side_)};
    }
    const std::int64_t from_pole = p < in_cap ? p : all - 1 - p;
    // Ring i of a cap is behind 2 i (i - 1) others.
    auto i = static_cast<std::int64_t>(std::sqrt(static_cast<double>(from_pole) / 2)) + 1;
    while (2 * i * (i - 1) > from_pole) --i;
    while (2 * i * (i + 1) <= from_pole) ++i;
    const std::int64_t behind = from_pole - 2 * i * (i - 1);
    return p < in_cap ? RingPlace{i, behind} : RingPlace{4 * side_ - i, 4 * i - 1 - behind};
  }
  [[nodiscard]] RingPlace ring_of(const Pixel& pixel) const {
    // The center is between the lines of a lattice of half the step.
    const std::int64_t ring = (2 + pixel.face / 4) * side_ - pixel.x - pixel.y - 1;
    const std::int64_t steps = std::min({ring, side_, 4 * side_ - ring});
    const std::int64_t quarter =
        pixel.face / 4 == 1 ? 2 * (pixel.face % 4) : 2 * (pixel.face % 4) + 1;
    // 4 (position + first) for half steps.
    std::int64_t place = 2 * quarter * steps + 2 * (pixel.x - pixel.y);
    if (place < 0) place += 16 * steps;
    return {ring, place / 4};
  }

  [[nodiscard]] Pixel pixel_of(Index cell) const {
    const auto p = static_cast<std::uint64_t>(cell);
    const auto of_face = static_cast<std::uint64_t>(side_ * side_);
    return {static_cast<std::int64_t>(p / of_face), compressed(p % of_face),
            compressed(p % of_face >> 1U)};
  }
  // Returns the pixel at a place of a ring: the base pixel in which its center has coordinates from
  // 0 to the side.
  [[nodiscard]] Pixel pixel_in_ring(Index cell) const {
    const auto [ring, position] = ring_of(cell);
    const std::int64_t steps = std::min({ring, side_, 4 * side_ - ring});
    const bool is_half = ring < side_ || ring > 3 * side_ || (ring - side_) % 2 == 0;
    const std::int64_t place = 4 * position + (is_half ? 2 : 0);
    const std::int64_t quarter = place / (4 * steps);
    for (std::int64_t row = 0; row < 3; ++row) {
      const bool is_belt = row == 1;
      const std::int64_t face = is_belt ? (place + 2 * steps) / (4 * steps) % 4 : quarter;
      std::int64_t east = place - (is_belt ? 4 * face : 4 * face + 2) * steps;
      if (east > 8 * steps) east -= 16 * steps;
      const std::int64_t x_minus_y = east / 2;
      const std::int64_t x_plus_y = (2 + row) * side_ - ring - 1;
      const std::int64_t x = floor_quotient(x_plus_y + x_minus_y, 2);
      const std::int64_t y = x_plus_y - x;
      if (x - y == x_minus_y && x >= 0 && y >= 0 && x < side_ && y < side_) {
        return {4 * row + face, x, y};
      }
    }
    return {0, 0, 0};  // not reached
  }

  // Returns the steps along a quarter of a ring.
  [[nodiscard]] std::int64_t steps_of(std::int64_t ring) const {
    return std::min({ring, lattice_, 4 * lattice_ - ring});
  }

  // Returns a place in the quarter of the sphere that begins at the meridian 0.
  [[nodiscard]] Point point_of(const LatticePlace& place) const {
    const std::int64_t steps = steps_of(place.ring);
    const double sign = place.ring <= 2 * lattice_ ? 1 : -1;
    if (steps == 0) return {0, 0, sign};
    const auto n = static_cast<double>(lattice_);
    const auto s = static_cast<double>(steps);
    const exact::SineCosine turn =
        exact::sine_cosine_of_degrees(45 * static_cast<double>(place.position) / s);
    double z = static_cast<double>(2 * (2 * lattice_ - place.ring)) / (3 * n);
    double radius = std::sqrt((1 - z) * (1 + z));
    if (steps < lattice_) {
      const double depth = s * s / (3 * n * n);
      z = sign * (1 - depth);
      radius = std::sqrt(depth * (2 - depth));
    }
    return {radius * turn.cosine, radius * turn.sine, z};
  }

  // Appends the places from a corner of a pixel to before the next one. `from` has the base pixel
  // and lattice coordinates; `dx` and `dy` are the direction.
  void append_side(const Pixel& from, std::int64_t dx, std::int64_t dy,
                   std::vector<Point>& ring) const {
    const std::int64_t row = from.face / 4;
    const std::int64_t quarter = row == 1 ? 2 * (from.face % 4) : 2 * (from.face % 4) + 1;
    const auto place_of = [&](std::int64_t step) {
      const std::int64_t x = from.x + step * dx;
      const std::int64_t y = from.y + step * dy;
      const std::int64_t j = (2 + row) * lattice_ - x - y;
      return LatticePlace{j, quarter * steps_of(j) + x - y};
    };
    for (std::int64_t step = 0; step < steps_; step += 2) {
      LatticePlace start = place_of(step);
      LatticePlace middle = place_of(step + 1);
      LatticePlace end = place_of(step + (steps_ == 1 ? 1 : 2));
      // Base pixels near the equator are in two quarters, others in one.
      const std::int64_t turn =
          row == 1 ? floor_quotient(std::min(start.position, end.position), 2 * lattice_)
                   : from.face % 4;
      for (LatticePlace* const place : {&start, &middle, &end}) {
        place->position -= 2 * turn * steps_of(place->ring);
      }
      ring.push_back(turned(point_of(start), turn));
      if (steps_ > 1) ring.push_back(turned(middle_of(start, middle, end), turn));
    }
  }

  // Returns the place of the middle of two steps, moved across the line between the others so that
  // both arcs have the curve's area on their sides.
  [[nodiscard]] Point middle_of(LatticePlace start, LatticePlace middle, LatticePlace end) const {
    const bool is_south = middle.ring > 2 * lattice_;
    if (is_south) {
      for (LatticePlace* const place : {&start, &middle, &end}) {
        place->ring = 4 * lattice_ - place->ring;
      }
    }
    if (start.ring > end.ring) std::swap(start, end);
    Point result = moved_middle(start, middle, end);
    if (is_south) result.z = -result.z;
    return result;
  }
  [[nodiscard]] Point moved_middle(const LatticePlace& start, const LatticePlace& middle,
                                   const LatticePlace& end) const {
    const Point from = point_of(start);
    const Point to = point_of(end);
    Point at = point_of(middle);
    const auto n = static_cast<double>(lattice_);
    double area = 0;  // between the curve and the north pole
    if (middle.ring > lattice_) {
      const double z = static_cast<double>(2 * (2 * lattice_ - middle.ring)) / (3 * n);
      area =
          (1 - z) * static_cast<double>(end.position - start.position) * (std::numbers::pi / 4) / n;
    } else {
      // The longitude is pi / 4 (k + c / J) and 1 - z is J^2 / (3 N^2).
      const std::int64_t k = (end.position - start.position) / (end.ring - start.ring);
      const std::int64_t c = start.position - k * start.ring;
      if (c == 0) return at;  // a meridian
      area = -static_cast<double>(c) * static_cast<double>(end.ring - start.ring) *
             (std::numbers::pi / 4) / (3 * n * n);
    }
    const Point normal = normalized(cross(from, to - from));  // to the left
    const Point step = to - from;
    const double half = std::sqrt(dot(step, step)) / 2;
    for (int round = 0; round < 4; ++round) {
      const double excess = area_north_of(from, at) + area_north_of(at, to) - area;
      at = normalized(at + (excess / half) * normal);
    }
    return at;
  }

  std::int64_t side_;
  bool is_in_rings_;
  std::int64_t steps_;    // along the side of a pixel
  std::int64_t lattice_;  // steps along the side of a base pixel
};

}  // namespace

std::unique_ptr<GridFormula> healpix_grid(unsigned order, bool is_in_rings, GridSides sides) {
  return std::make_unique<HealpixGrid>(order, is_in_rings, sides);
}

}  // namespace rondel::grids
