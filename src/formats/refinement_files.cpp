// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// read_refinement(): points along the lines of a file, dense where spacings are kept.
#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/mesh_lines.h"
#include "rondel/mesh_size_files.h"
#include "system/arithmetic.h"

namespace rondel::mesh {
namespace {

// Appends points of the arc from a to b but b itself, as read_refinement() describes.
class ArcPoints {
 public:
  ArcPoints(double distance, const SizeRegion& region)
      : distance_(distance), center_(exact::to_vector(region.center)) {
    // The corners of a region are no farther from its center than its two angles together.
    reach_ = region.half_width + region.half_height;
  }

  void append(const Point& a, const Point& b, std::vector<Point>& points) const {
    const auto p = exact::to_vector(a);
    const auto q = exact::to_vector(b);
    const auto middle = normalized(p + q);
    const double half = 0.5 * exact::argument(norm(cross(p, q)), dot(p, q));
    const double from_center = exact::argument(norm(cross(middle, center_)), dot(middle, center_));
    const double apart = from_center - reach_ - half;  // no part of the arc is nearer to the region
    if (2 * half <= std::max(distance_, apart / 4)) {
      points.push_back(a);
      return;
    }
    // An arc as short as the region that is close to it has no part that is far away.
    if (apart <= 0 && half <= reach_) {
      const std::vector<Point> dense = densified(std::array{a, b}, distance_);
      points.insert(points.end(), dense.begin(), dense.end() - 1);
      return;
    }
    append(a, exact::to_point(middle), points);
    append(exact::to_point(middle), b, points);
  }

 private:
  double distance_;
  exact::Vector3<double> center_;
  double reach_;
};

}  // namespace

std::vector<Point> read_refinement(const FileName& file, double distance,
                                   const PolygonOptions& options, const Execution& execution,
                                   const std::optional<SizeRegion>& region) {
  const system::ArithmeticScope arithmetic;
  if (!(distance > 0)) throw InvalidInput("a distance of points is more than 0");
  if (region) (void)SizeRaster(*region, 1).longest_step();  // throws for what is no region
  std::vector<Point> points;
  for (const std::vector<Point>& line : read_places(file, options, execution)) {
    try {
      // Antipodes among neighbors are refused before anything is divided.
      std::vector<Point> dense = densified(line, region ? std::numbers::pi : distance);
      if (region) {
        const ArcPoints arcs(distance, *region);
        const std::vector<Point> ends = std::exchange(dense, {});
        for (std::size_t i = 1; i < ends.size(); ++i) arcs.append(ends[i - 1], ends[i], dense);
        if (!ends.empty()) dense.push_back(ends.back());
      }
      points.insert(points.end(), dense.begin(), dense.end());
    } catch (const InvalidInput& error) {
      if (error.index() == InvalidInput::no_index) throw;
      throw FileError(file.path + ": " + error.what());
    }
  }
  return points;
}

}  // namespace rondel::mesh
