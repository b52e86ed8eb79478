// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons with straight sides in longitude and latitude whose corner is a pole: sides that meet there
// lie on each other near the pole. What each polygon has for itself is known in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "support/random.h"
#include "support/temporary_files.h"

namespace rondel::test {
namespace {

constexpr double per_degree = std::numbers::pi / 180;

// A triangle between two lines to a pole, up to a distance from it. Slopes are degrees of longitude
// for each degree of latitude.
struct PoleWedge {
  double west;
  double east;
  double height_deg;
};

// Returns the integral of t sin t up to this distance from the pole: the area for a slope of 1.
double area_to(double height_deg) {
  const double t = height_deg * per_degree;
  return std::sin(t) - t * std::cos(t);
}

// Returns the area that each wedge has outside of those before it.
std::vector<double> areas_of_first(const std::vector<PoleWedge>& wedges) {
  std::vector<double> slopes;
  for (const PoleWedge& wedge : wedges) {
    slopes.push_back(wedge.west);
    slopes.push_back(wedge.east);
  }
  std::ranges::sort(slopes);
  std::vector<double> found(wedges.size());
  for (std::size_t k = 0; k + 1 < slopes.size(); ++k) {
    double covered = 0;
    for (std::size_t i = 0; i < wedges.size(); ++i) {
      const bool has_slopes = wedges[i].west <= slopes[k] && slopes[k + 1] <= wedges[i].east;
      if (!has_slopes || wedges[i].height_deg <= covered) continue;
      found[i] += (slopes[k + 1] - slopes[k]) * (area_to(wedges[i].height_deg) - area_to(covered));
      covered = wedges[i].height_deg;
    }
  }
  return found;
}

std::string polygon_of(const PoleWedge& wedge, double lon, double pole) {
  const double lat = std::copysign(90 - wedge.height_deg, pole);
  const auto position = [](double x, double y) {
    return "[" + std::to_string(x) + "," + std::to_string(y) + "]";
  };
  const std::string start = position(lon + wedge.west * wedge.height_deg, lat);
  return R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[)" +
         start + "," + position(lon + wedge.east * wedge.height_deg, lat) + "," +
         position(lon, pole) + "," + start + "]]}}";
}

TEST(overlay_poles, overlapping_polygons_with_a_corner_at_a_pole_have_the_areas_of_the_plane) {
  Random random(20);
  for (int trial = 0; trial < 40; ++trial) {
    const double pole = trial % 2 == 0 ? 90 : -90;
    const auto lon = static_cast<double>(random.below(36)) * 10 - 180;
    std::vector<PoleWedge> wedges;
    std::string text;
    const std::uint64_t count = 2 + random.below(3);
    for (std::uint64_t k = 0; k < count; ++k) {
      const double west = (static_cast<double>(random.below(33)) - 16) / 8;
      const double width = static_cast<double>(1 + random.below(16)) / 8;
      wedges.push_back({west, west + width, 5 * static_cast<double>(1 + random.below(5))});
      text += (k == 0 ? "" : ",") + polygon_of(wedges.back(), lon, pole);
    }
    const std::string path = temporary_path("poles.geojson");
    std::ofstream(path) << R"({"type":"FeatureCollection","features":[)" << text << "]}";
    const CellTable table = read_polygons(path, {.overlap = PolygonOverlap::first});
    const std::vector<double> found = areas(table.cells);
    const std::vector<double> wanted = areas_of_first(wedges);
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double own = (wedges[i].east - wedges[i].west) * area_to(wedges[i].height_deg);
      EXPECT_NEAR(found[i], wanted[i], 2e-3 * own) << text;
    }
    // The cells are sound: none crosses itself.
    EXPECT_NO_THROW((void)CellSet::polygons(table.cells).areas()) << text;
    EXPECT_NO_THROW(
        (void)intersection(CellSet::polygons(table.cells), CellSet::polygons(table.cells)))
        << text;
  }
}

}  // namespace
}  // namespace rondel::test
