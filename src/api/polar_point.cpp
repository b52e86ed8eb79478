// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Circles as weighted sites: the center q of a circle of radius r gives the point q / cos r, the
// pole of its plane. Centers are points, or longitudes and latitudes in degrees.

#include <algorithm>
#include <string>

#include "exact/angles.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/arithmetic.h"
#include "system/message_text.h"

namespace rondel {
namespace {

// True for a radius of less than a quarter turn; false for NaN, too.
bool is_radius(double radius_deg) { return radius_deg >= 0 && radius_deg < 90; }

// Returns the text of the error for a radius that is none.
std::string fault(double radius_deg) {
  return "radius " + system::shortest_text(radius_deg) + " is not in [0, 90)";
}

// Returns center / cos radius. The cosine is positive: the double next to 90 degrees is 1.4e-14
// degrees away.
Point pole(const Point& center, double radius_deg) {
  const double cosine = exact::sine_cosine_of_degrees(radius_deg).cosine;
  return {center.x / cosine, center.y / cosine, center.z / cosine};
}

// Throws InvalidInput unless there is one valid radius for each center; the index is that of the
// first flaw.
void require_radii(std::size_t num_centers, std::span<const double> radii_deg) {
  if (radii_deg.size() != num_centers) {
    throw InvalidInput(
        std::to_string(radii_deg.size()) + " radii for " + std::to_string(num_centers) + " centers",
        std::min(radii_deg.size(), num_centers));
  }
  const auto bad = std::ranges::find_if_not(radii_deg, is_radius);
  if (bad == radii_deg.end()) return;
  const auto index = static_cast<std::size_t>(bad - radii_deg.begin());
  throw InvalidInput("site " + std::to_string(index) + ": " + fault(*bad), index);
}

}  // namespace

Point polar_point(const Point& center, double radius_deg) {
  const system::ArithmeticScope arithmetic;
  if (!is_radius(radius_deg)) throw InvalidInput(fault(radius_deg), 0);
  return system::apart([&] { return pole(center, radius_deg); });
}

Point polar_point(const LonLat& center, double radius_deg) {
  const system::ArithmeticScope arithmetic;
  return polar_point(unit_vector(center), radius_deg);
}

std::vector<Point> polar_points(std::span<const Point> centers, std::span<const double> radii_deg) {
  const system::ArithmeticScope arithmetic;
  require_radii(centers.size(), radii_deg);
  return system::apart([&] {
    std::vector<Point> result(centers.size());
    std::ranges::transform(centers, radii_deg, result.begin(), pole);
    return result;
  });
}

std::vector<Point> polar_points(std::span<const LonLat> centers,
                                std::span<const double> radii_deg) {
  const system::ArithmeticScope arithmetic;
  require_radii(centers.size(), radii_deg);
  return polar_points(unit_vectors(centers), radii_deg);
}

}  // namespace rondel
