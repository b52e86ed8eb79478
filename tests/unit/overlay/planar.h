// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons in longitude and latitude: files of them, and areas between their straight lines.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/types.h"
#include "support/temporary_files.h"

namespace rondel::test {

using RingInPlane = std::vector<LonLat>;

inline std::string text_of(const RingInPlane& ring) {
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
inline std::string planar_polygon(const std::vector<RingInPlane>& rings) {
  std::string text = "[";
  for (std::size_t r = 0; r < rings.size(); ++r) text += (r > 0 ? "," : "") + text_of(rings[r]);
  return text + ']';
}

// Each feature is a MultiPolygon of its polygons.
inline CellTable planar_table(const std::vector<std::vector<std::string>>& features,
                              const PolygonOptions& options = {}) {
  std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  std::ranges::replace(test, '/', '_');
  const std::string path = temporary_path("plane_") + test + ".geojson";
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

inline std::string planar_message(const std::vector<std::vector<std::string>>& features,
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
inline long double area_below(const LonLat& p, const LonLat& q) {
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
inline double area_in_plane(const RingInPlane& ring) {
  long double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    sum += area_below(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]);
  }
  return static_cast<double>(std::abs(sum));
}
inline double planar_length(const RingInPlane& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LonLat& q = ring[k + 1 < ring.size() ? k + 1 : 0];
    sum += std::abs(ring[k].lon_deg - q.lon_deg) + std::abs(ring[k].lat_deg - q.lat_deg);
  }
  return sum * std::numbers::pi / 180;
}

inline RingInPlane planar_box(double w, double s, double e, double n) {
  return {{w, s}, {e, s}, {e, n}, {w, n}};
}

}  // namespace rondel::test
