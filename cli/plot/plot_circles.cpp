// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "plot_circles.h"

#include <cmath>
#include <numbers>

namespace rondel::cli {
namespace {

// Returns the radius in degrees, which is 0 for a point on the sphere or inside. Coordinates are
// halved, so that a difference of huge ones is finite; the tangent is accurate for small circles
// too.
double radius_of(const Point& site, const Sphere& sphere) {
  const Point& c = sphere.center;
  const double distance =
      2 * std::hypot(site.x / 2 - c.x / 2, site.y / 2 - c.y / 2, site.z / 2 - c.z / 2);
  const double ratio = distance / std::sqrt(sphere.squared_radius);
  if (!(ratio > 1)) return 0;
  return std::atan(std::sqrt(ratio - 1) * std::sqrt(ratio + 1)) * (180 / std::numbers::pi);
}

}  // namespace

// A site without a direction is at the center of the sphere; its circle is imaginary.
std::vector<Circle> real_circles(const SiteTable& table, const Triangulation& triangulation,
                                 std::span<const Point> directions) {
  std::vector<bool> is_duplicate(directions.size()), is_hidden(directions.size());
  for (const Duplicate& duplicate : triangulation.duplicates()) is_duplicate[duplicate.site] = true;
  for (const Hidden& hidden : triangulation.hidden()) is_hidden[hidden.site] = true;
  std::vector<Circle> circles;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double radius_deg = table.radii_deg.empty()
                                  ? radius_of(table.sites[i], triangulation.sphere())
                                  : table.radii_deg[i];
    const bool has_direction = directions[i] != Point{};
    if (is_duplicate[i] || !has_direction || !(radius_deg > 0)) continue;
    circles.push_back({directions[i], radius_deg, is_hidden[i]});
  }
  return circles;
}

}  // namespace rondel::cli
