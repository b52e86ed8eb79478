// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rasters of regions: SizeRegion, SizeRaster and PlaneRaster; and region_of(), which finds the region
// of an area.
//
// The rectangle around an area has its middle at the center of the plane. The projection changes with
// the center, and so the center is moved to the middle of the rectangle a few times.

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "exact/angles.h"
#include "map/ring_area.h"
#include "meshing/size_raster.h"
#include "overlay/single_cells.h"
#include "rondel/error.h"
#include "rondel/mesh_triangles.h"
#include "system/arithmetic.h"

namespace rondel::mesh {
namespace {

constexpr std::size_t most_cube_steps = 4096;
// The squares of 4096 by 4096 steps: 67 MB of values, and while these are computed 134 MB more. A
// narrow region may have as many, but its columns and rows are numbers of 16 bits.
constexpr std::size_t most_squares = std::size_t{1} << 24U;
constexpr std::size_t most_plane_steps = std::size_t{1} << 16U;

// Within 45 degrees to each side, as a face of the cube has them, no step of the plane is seen under
// less than a third of the angle of another one: at a corner the square of the distance is 3.
constexpr double largest_half = std::numbers::pi / 4;
// 6 mm on the Earth: 4096 steps are then 5e-13 long, thousands of times the rounding of a place.
constexpr double least_half = 1e-9;

double tangent(double angle) {
  const auto [sine, cosine] = exact::sine_cosine_of_degrees(angle * exact::degrees_per_radian);
  return sine / cosine;
}

// Throws InvalidInput unless the region is as described.
void require_region(const SizeRegion& region) {
  const auto is_half = [](double angle) { return angle >= least_half && angle <= largest_half; };
  if (!is_half(region.half_width) || !is_half(region.half_height)) {
    throw InvalidInput("a region of spacings reaches from 1e-9 to pi / 4 radians to each side");
  }
  constexpr double rounding = 1e-9;
  if (!(std::abs(norm(exact::to_vector(region.center)) - 1) <= rounding)) {
    throw InvalidInput("the center of a region of spacings is no unit vector");
  }
}

// Returns the numbers of squares along both sides, eastward and northward, for so many along the
// longer one. The other side's squares are not longer, but for rounding.
std::array<std::size_t, 2> squares_of(const std::array<double, 2>& halves, std::size_t steps) {
  const auto [low, high] = std::minmax(halves[0], halves[1]);
  constexpr double below = 1 - 1e-12;
  const double others = std::ceil(static_cast<double>(steps) * (low / high) * below);
  const std::size_t shorter = std::max<std::size_t>(1, static_cast<std::size_t>(others));
  if (halves[0] >= halves[1]) return {steps, shorter};
  return {shorter, steps};
}

std::size_t most_steps_of(const std::array<double, 2>& halves) {
  const auto is_possible = [&](std::size_t steps) {
    const auto [columns, rows] = squares_of(halves, steps);
    return columns * rows <= most_squares;
  };
  std::size_t steps = 0;
  for (std::size_t bit = most_plane_steps; bit > 0; bit /= 2) {
    if (steps + bit <= most_plane_steps && is_possible(steps + bit)) steps += bit;
  }
  return steps;
}

std::array<double, 2> halves_of(const SizeRegion& region) {
  require_region(region);
  return {tangent(region.half_width), tangent(region.half_height)};
}

// A plane with the smallest rectangle around points on it.
struct FittedPlane {
  SizeRegion region;
  Point middle;    // of the rectangle
  double off = 0;  // radians from the center to the middle
  bool is_found = false;
};

// Returns the rectangle around the center that has all points; none if they are not in its
// hemisphere. It reaches as far to one side as to the other, and so is smallest where the center is
// the middle.
FittedPlane fit(std::span<const Point> points, const Point& center) {
  // Angles are measured on a plane of any size.
  const PlaneRaster plane({center, largest_half, largest_half}, 1);
  std::array<double, 2> low = plane.on_plane(points.front());
  std::array<double, 2> high = low;
  for (const Point& p : points) {
    const auto at = plane.on_plane(p);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (!std::isfinite(at[axis])) return {};
      low[axis] = std::min(low[axis], at[axis]);
      high[axis] = std::max(high[axis], at[axis]);
    }
  }
  std::array<double, 2> halves{};
  std::array<double, 2> middles{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double first = exact::argument(low[axis], 1);
    const double last = exact::argument(high[axis], 1);
    middles[axis] = tangent(0.5 * (first + last));
    // Corners are within the border, however they are rounded.
    constexpr double wider = 1 + 1e-9;
    halves[axis] = std::max(least_half, wider * std::max(-first, last) + 1e-15);
  }
  return {{center, halves[0], halves[1]},
          plane.at(middles[0], middles[1]),
          std::max(std::abs(middles[0]), std::abs(middles[1])),
          true};
}

// Returns the direction of the middle of the box around points in space; none if it is the origin.
std::optional<Point> middle_of_box(std::span<const Point> points) {
  exact::Vector3<double> low = exact::to_vector(points.front());
  exact::Vector3<double> high = low;
  for (const Point& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const auto middle = low + high;
  constexpr double least = 1e-3;
  if (!(norm(middle) > least)) return std::nullopt;
  return exact::to_point(normalized(middle));
}

// Collects the corners of polygons; false if one of them is the whole sphere or is not valid.
bool collect_corners(const CellRings& polygons, std::vector<Point>& corners) {
  if (!polygons.whole.empty()) return false;
  const auto is_valid = [](const std::vector<std::uint64_t>& offsets, std::size_t number) {
    return !offsets.empty() && offsets.back() == number && std::ranges::is_sorted(offsets);
  };
  if (!is_valid(polygons.rings, polygons.corners.size()) ||
      !is_valid(polygons.cells, polygons.rings.size() - 1)) {
    return false;
  }
  for (const Index corner : polygons.corners) {
    if (corner >= polygons.points.size()) return false;
    const Point& p = polygons.points[corner];
    if (!(std::abs(norm(exact::to_vector(p)) - 1) < 1e-9)) return false;
    corners.push_back(p);
  }
  return true;
}

// Returns true if a polygon is on the outside of its rings. Precondition: the rings lie in a
// hemisphere.
bool has_outside(const CellRings& polygons) {
  for (std::size_t cell = 0; cell < polygons.num_cells(); ++cell) {
    std::vector<std::vector<Point>> rings;
    for (std::uint64_t ring = polygons.cells[cell]; ring < polygons.cells[cell + 1]; ++ring) {
      rings.push_back(overlay::points_of_ring(polygons, ring));
    }
    if (map::have_outside_on_left(rings)) return true;
  }
  return false;
}

}  // namespace

bool SizeRegion::contains(const Point& place) const {
  const system::ArithmeticScope arithmetic;
  return PlaneRaster(*this, 1).contains(place);
}

SizeRaster SizeRaster::with_step(const SizeRegion& region, double step) {
  const system::ArithmeticScope arithmetic;
  if (!(step > 0)) throw InvalidInput("the spacing is so small that a step of its raster is 0");
  const std::array<double, 2> halves = halves_of(region);
  const double wanted = std::ceil(2 * std::max(halves[0], halves[1]) / step);
  const std::size_t most = most_steps_of(halves);
  if (!(wanted < static_cast<double>(most))) return {region, most};
  return {region, std::max<std::size_t>(1, static_cast<std::size_t>(wanted))};
}

std::size_t SizeRaster::most_steps() const {
  const system::ArithmeticScope arithmetic;
  return region ? most_steps_of(halves_of(*region)) : most_cube_steps;
}

double SizeRaster::longest_step() const {
  const system::ArithmeticScope arithmetic;
  const AnyRaster raster = raster_of(*this);
  const auto* plane = std::get_if<PlaneRaster>(&raster);
  const double half = plane == nullptr ? 1 : std::max(plane->half(0), plane->half(1));
  return 2 * half / static_cast<double>(steps);
}

AnyRaster raster_of(const SizeRaster& wanted) {
  if (wanted.region) return PlaneRaster(*wanted.region, wanted.steps);
  const std::size_t steps = wanted.steps;
  if (steps < 1 || steps > most_cube_steps || !std::has_single_bit(steps)) {
    throw InvalidInput("the steps of a raster are a power of two from 1 to 4096, not " +
                       std::to_string(steps));
  }
  return CubeRaster{steps};
}

PlaneRaster::PlaneRaster(const SizeRegion& region, std::size_t steps)
    : region_(region), center_(exact::to_vector(region.center)), halves_(halves_of(region)) {
  const std::size_t most = most_steps_of(halves_);
  if (steps < 1 || steps > most) {
    throw InvalidInput("the steps of a raster of this region are from 1 to " +
                       std::to_string(most) + ", not " + std::to_string(steps));
  }
  squares_ = squares_of(halves_, steps);
  center_ = normalized(center_);
  // At a pole "eastward" is what it is at longitude 0.
  const bool is_pole = exact::is_pole(region.center);
  east_ = is_pole ? exact::Vector3<double>{0, 1, 0}
                  : normalized(exact::Vector3<double>{-center_.y, center_.x, 0});
  north_ = cross(center_, east_);
}

// The solid angle of a rectangle that is seen from above its center (Khadjavi, J. Opt. Soc. Am. 58,
// 1968): 4 atan(w h / sqrt(1 + w^2 + h^2)).
double PlaneRaster::solid_angle() const {
  const auto [w, h] = halves_;
  return 4 * exact::argument(w * h, std::sqrt(1 + w * w + h * h));
}

std::array<double, 2> PlaneRaster::on_plane(const Point& p) const {
  const exact::Vector3<double> v = exact::to_vector(moderate(p));
  const double along = dot(v, center_);
  const double x = dot(v, east_);
  const double y = dot(v, north_);
  if (along > 0) return {x / along, y / along};
  constexpr double far = std::numeric_limits<double>::infinity();
  return {std::copysign(far, x), std::copysign(far, y)};
}

RasterPlace PlaneRaster::spot(const Point& p) const {
  const auto at = on_plane(p);
  std::array<std::size_t, 2> square{};
  std::array<double, 2> part{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double half = halves_[axis];
    const double inside = at[axis] > -half ? std::min(at[axis], half) : -half;
    const auto number = static_cast<double>(squares_[axis]);
    const double steps = (inside + half) * (number / (2 * half));
    square[axis] = std::min(static_cast<std::size_t>(steps), squares_[axis] - 1);
    part[axis] = std::min(1.0, steps - static_cast<double>(square[axis]));
  }
  return {0, square[0], square[1], part[0], part[1]};
}

std::optional<SizeRegion> region_of(const MeshDomain& domain) {
  const system::ArithmeticScope arithmetic;
  std::vector<Point> corners;
  for (const Geometries& area : domain.area) {
    if (!collect_corners(area.polygons, corners)) return std::nullopt;
  }
  if (corners.empty()) return std::nullopt;
  // The middle of the box does not depend on where corners are close to each other, as a mean would.
  std::optional<Point> center = middle_of_box(corners);
  if (!center) return std::nullopt;
  FittedPlane best;
  constexpr int most_times = 8;
  constexpr double near_enough = 1e-3;
  const auto reach = [](const SizeRegion& r) { return std::max(r.half_width, r.half_height); };
  for (int time = 0; time < most_times; ++time) {
    const FittedPlane found = fit(corners, *center);
    if (!found.is_found) break;
    if (!best.is_found || reach(found.region) < reach(best.region)) best = found;
    if (found.off <= near_enough * reach(found.region)) break;
    center = found.middle;
  }
  if (!best.is_found || reach(best.region) > largest_half) return std::nullopt;
  // All corners are in the hemisphere of the center, and what is beyond it is inside of a polygon or
  // outside as a whole.
  const auto is_outside = [](const Geometries& area) { return has_outside(area.polygons); };
  if (std::ranges::any_of(domain.area, is_outside)) return std::nullopt;
  return best.region;
}

}  // namespace rondel::mesh
