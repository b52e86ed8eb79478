// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons that are straight in longitude and latitude, against the integral of the sine of the latitude along their sides,
// and what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "overlay_support.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "support/random.h"

namespace rondel::test {
namespace {

using PlanarRing = std::vector<LonLat>;

std::string text_of(const PlanarRing& ring) {
  std::ostringstream text;
  text.precision(17);
  text << '[';
  for (std::size_t k = 0; k <= ring.size(); ++k) {
    const LonLat& p = ring[k < ring.size() ? k : 0];
    text << (k > 0 ? "," : "") << '[' << p.lon_deg << ',' << p.lat_deg << ']';
  }
  return text.str() + ']';
}

// A polygon of its rings.
std::string planar_polygon(const std::vector<PlanarRing>& rings) {
  std::string text = "[";
  for (std::size_t r = 0; r < rings.size(); ++r) text += (r > 0 ? "," : "") + text_of(rings[r]);
  return text + ']';
}

// Each feature is a MultiPolygon of its polygons.
PolygonTable planar_table(const std::vector<std::vector<std::string>>& features,
                          const PolygonOptions& options = {}) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string path = testing::TempDir() + "rondel_plane_" + test + ".geojson";
  std::string text = R"({"type":"FeatureCollection","features":[)";
  for (std::size_t f = 0; f < features.size(); ++f) {
    text += (f > 0 ? "," : "");
    text += R"({"type":"Feature","properties":{"name":"f)" + std::to_string(f) +
            R"("},"geometry":{"type":"MultiPolygon","coordinates":[)";
    for (std::size_t p = 0; p < features[f].size(); ++p) {
      text += (p > 0 ? "," : "") + features[f][p];
    }
    text += "]}}";
  }
  std::ofstream(path) << text << "]}";
  return read_polygons(path, options);
}

std::string planar_message(const std::vector<std::vector<std::string>>& features,
                           const PolygonOptions& options = {}) {
  try {
    (void)planar_table(features, options);
  } catch (const FileError& error) {
    const std::string message = error.what();
    return message.substr(message.find("geojson: ") + 9);
  }
  return "";
}

// Between the side and the equator: of the sine along a straight line, by Gauss's rule with twelve steps.
long double area_below(const LonLat& p, const LonLat& q) {
  constexpr long double degree = std::numbers::pi_v<long double> / 180;
  constexpr long double place = 0.7745966692414833770358531L;
  long double sum = 0;
  constexpr int steps = 12;
  for (int s = 0; s < steps; ++s) {
    for (const auto& [node, weight] :
         {std::pair{-place, 5.0L / 18}, std::pair{0.0L, 8.0L / 18}, std::pair{place, 5.0L / 18}}) {
      const long double t = (s + (1 + node) / 2) / steps;
      const long double lat = p.lat_deg + t * (static_cast<long double>(q.lat_deg) - p.lat_deg);
      sum += weight / steps * std::sin(lat * degree);
    }
  }
  return sum * (static_cast<long double>(p.lon_deg) - q.lon_deg) * degree;
}
double planar_area(const PlanarRing& ring) {
  long double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    sum += area_below(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]);
  }
  return static_cast<double>(std::abs(sum));
}
double planar_length(const PlanarRing& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LonLat& q = ring[k + 1 < ring.size() ? k + 1 : 0];
    sum += std::abs(ring[k].lon_deg - q.lon_deg) + std::abs(ring[k].lat_deg - q.lat_deg);
  }
  return sum * std::numbers::pi / 180;
}

PlanarRing planar_box(double w, double s, double e, double n) {
  return {{w, s}, {e, s}, {e, n}, {w, n}};
}

TEST(overlay_plane, slivers_have_their_area) {
  Random random(7);
  const std::vector<double> lengths = {10, 1, 0.1, 0.01};
  for (const double length : lengths) {
    for (int width = 3; width <= 12; ++width) {
      for (int i = 0; i < 6; ++i) {
        const double turn = random.uniform(0, 2 * std::numbers::pi);
        const LonLat p = {random.uniform(-170, 170), random.uniform(-70, 70)};
        const LonLat along = {std::cos(turn) * length, std::sin(turn) * length};
        const double side = std::pow(10.0, -width) * (i % 2 == 0 ? 1 : -1);
        const double t = random.uniform(0.1, 0.9);
        const PlanarRing ring = {p,
                                 {p.lon_deg + along.lon_deg, p.lat_deg + along.lat_deg},
                                 {p.lon_deg + t * along.lon_deg - side * std::sin(turn),
                                  p.lat_deg + t * along.lat_deg + side * std::cos(turn)}};
        const double area = areas(planar_table({{planar_polygon({ring})}}).cells)[0];
        // Corners are unit vectors of doubles; of wide ones the arcs are within the tolerance.
        const double rounding = planar_length(ring) * 4e-16;
        EXPECT_NEAR(area, planar_area(ring), rounding + 4e-6 * planar_length(ring))
            << length << ' ' << width;
        if (width > 4) EXPECT_NEAR(area, planar_area(ring), rounding + 1e-3 * planar_area(ring));
        EXPECT_GE(area, -rounding);
      }
    }
  }
}

}  // namespace
}  // namespace rondel::test
