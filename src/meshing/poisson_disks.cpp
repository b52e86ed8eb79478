// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Accepted points lie in bins: bands of latitude whose height is at least the radius, cut along
// meridians into bins whose width is at least the radius. So the points near a point lie in its
// band and the two next to it, in bins within reach of the radius.
//
// When many darts in a row have missed, few gaps are left. A gap is a point farther than the radius
// from all points, and the center of an empty circle is the farthest point of its surroundings. So
// the centers of all circles that are too large are tried, the largest first, until no such circle
// is left.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
#include "meshing/seeded_random.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/point_sets.h"
#include "system/arithmetic.h"

namespace rondel::mesh {
namespace {

using exact::to_point;
using exact::to_vector;

// The accepted points, in bins.
class Bins {
 public:
  // Rounding of points and of the squared chord changes it by less than a relative 2^-48.
  Bins(double radius, double square) : square_(square * (1 + 0x1p-48)) {
    const auto bands = static_cast<std::size_t>(std::numbers::pi / radius);
    height_ = 180 / static_cast<double>(bands);
    first_.push_back(0);
    for (std::size_t band = 0; band < bands; ++band) {
      // The width is at least the radius at the end nearer to the pole; around a pole one bin
      // suffices.
      const double low = exact::sine_cosine_of_degrees(static_cast<double>(band) * height_).sine;
      const double high =
          exact::sine_cosine_of_degrees(static_cast<double>(band + 1) * height_).sine;
      const double around = 2 * std::numbers::pi * std::max(0.0, std::min(low, high));
      const auto count = static_cast<std::size_t>(std::max(1.0, std::floor(around / radius)));
      first_.push_back(first_.back() + count);
    }
    heads_.assign(first_.back(), no_index);
  }

  // Adds a point and returns true if no point is closer than the radius.
  bool add(const Point& p) {
    const double lon = 180 + degrees * exact::argument(p.y, p.x);
    const std::size_t band = band_of(p);
    for (std::size_t b = band == 0 ? 0 : band - 1; b <= band + 1 && b + 1 < first_.size(); ++b) {
      const std::size_t count = first_[b + 1] - first_[b];
      const std::size_t bin = bin_of(lon, count);
      if (count <= 4) {
        for (std::size_t k = 0; k < count; ++k) {
          if (has_close(first_[b] + k, p)) return false;
        }
        continue;
      }
      // A bin of the next band may be narrower than those of this band, by less than a factor of
      // two.
      for (std::size_t k = 0; k < std::min<std::size_t>(count, 5); ++k) {
        if (has_close(first_[b] + (bin + count + k - 2) % count, p)) return false;
      }
    }
    const std::size_t count = first_[band + 1] - first_[band];
    Index& head = heads_[first_[band] + bin_of(lon, count)];
    next_.push_back(head);
    head = static_cast<Index>(points_.size());
    points_.push_back(p);
    return true;
  }

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }

 private:
  static constexpr double degrees = 180 / std::numbers::pi;

  // Returns the band of a point, counted from the north pole.
  [[nodiscard]] std::size_t band_of(const Point& p) const {
    const double colatitude =
        degrees * exact::argument(std::sqrt(p.x * p.x + p.y * p.y), p.z) / height_;
    return std::min(static_cast<std::size_t>(colatitude), first_.size() - 2);
  }
  // Returns the bin of a longitude in a band; longitudes are counted from -180 degrees here.
  static std::size_t bin_of(double lon, std::size_t count) {
    return std::min(static_cast<std::size_t>(lon / 360 * static_cast<double>(count)), count - 1);
  }
  // True if the list of a bin has a point closer than the radius.
  [[nodiscard]] bool has_close(std::size_t bin, const Point& p) const {
    for (Index k = heads_[bin]; k != no_index; k = next_[k]) {
      const auto d = to_vector(points_[k]) - to_vector(p);
      if (dot(d, d) < square_) return true;
    }
    return false;
  }

  double square_;
  double height_ = 0;               // height of a band in degrees
  std::vector<std::size_t> first_;  // the first bin of each band, and the end
  // Each bin is a linked list: its first point, and for each point the next one in its bin.
  std::vector<Index> heads_;
  std::vector<Index> next_;
  std::vector<Point> points_;
};

// Returns a uniform direction.
Point random_direction(SeededRandom& random) {
  const double z = 2 * random() - 1;
  const double r = std::sqrt((1 - z) * (1 + z));
  const auto turn = exact::sine_cosine_of_degrees(360 * random());
  return to_point(normalized(exact::Vector3<double>{r * turn.cosine, r * turn.sine, z}));
}

// Returns the centers of the circles around faces whose squared chord exceeds `square`, the largest
// first.
std::vector<Point> gaps(const std::vector<Point>& points, double square,
                        const Execution& execution) {
  const Triangulation triangulation =
      delaunay(Sites::view(points), {}, Execution{.threads = execution.threads});
  const std::vector<Point> centers =
      circumcenters(triangulation, Execution{.threads = execution.threads});
  std::vector<std::pair<double, Index>> found;
  for (Index f = 0; f < centers.size(); ++f) {
    const auto d = to_vector(centers[f]) - to_vector(points[triangulation.faces()[f][0]]);
    if (dot(d, d) > square * (1 + 0x1p-42)) found.emplace_back(-dot(d, d), f);
  }
  std::ranges::sort(found);
  std::vector<Point> result;
  result.reserve(found.size());
  for (const auto& [size, face] : found) result.push_back(centers[face]);
  return result;
}

}  // namespace

std::vector<Point> poisson_disk_points(double radius, std::uint64_t seed,
                                       const Execution& execution) {
  const system::ArithmeticScope arithmetic;
  if (!(radius >= 1e-4 && radius <= 1)) {
    throw InvalidInput("the radius of disks is from 0.0001 to 1 radian");
  }
  constexpr double degrees = 180 / std::numbers::pi;
  const double half = exact::sine_cosine_of_degrees(0.5 * degrees * radius).sine;
  const double square = 4 * half * half;
  Bins bins(radius, square);
  SeededRandom random(seed);
  // Maximal sets have about 0.7 points for each area of a disk, or about 4 / radius^2 in all. Of
  // this many darts, most of the last ones miss.
  const auto darts = static_cast<std::size_t>(16 / (radius * radius));
  for (std::size_t k = 0; k < darts; ++k) (void)bins.add(random_direction(random));
  while (true) {
    const std::vector<Point> centers = gaps(bins.points(), square, execution);
    bool has_added = false;
    for (const Point& center : centers) {
      if (bins.add(center)) has_added = true;
    }
    if (!has_added) return bins.points();
  }
}

}  // namespace rondel::mesh
