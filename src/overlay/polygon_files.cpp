// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/polygon_files.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "exact/vector.h"
#include "io/geojson_polygons.h"
#include "map/ring_area.h"
#include "overlay/border_rings.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/types.h"
#include "system/job.h"

namespace rondel {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

// Straight lines in longitude and latitude as arcs.
class LineDivider {
 public:
  explicit LineDivider(double tolerance) : squared_tolerance_(tolerance * tolerance) {}

  // Appends the points of the line from one position on, without the last one.
  void append(const LonLat& from, const LonLat& to, std::vector<Point>& points) const {
    append_between(from, unit_vector(from), to, unit_vector(to), 0, points);
  }

 private:
  // The middle is the same both ways.
  void append_between(const LonLat& from, const Point& p, const LonLat& to, const Point& q,
                      unsigned depth, std::vector<Point>& points) const {
    constexpr unsigned most_halvings = 30;
    const LonLat middle = {(from.lon_deg + to.lon_deg) / 2, (from.lat_deg + to.lat_deg) / 2};
    if (depth == most_halvings || is_straight(from, p, to, q, middle)) {
      points.push_back(p);
      return;
    }
    const Point m = unit_vector(middle);
    append_between(from, p, middle, m, depth + 1, points);
    append_between(middle, m, to, q, depth + 1, points);
  }

  [[nodiscard]] bool is_straight(const LonLat& from, const Point& p, const LonLat& to,
                                 const Point& q, const LonLat& middle) const {
    constexpr double most_degrees = 90;
    if (p == q && std::abs(from.lat_deg) == 90) return true;
    if (std::abs(to.lon_deg - from.lon_deg) > most_degrees ||
        std::abs(to.lat_deg - from.lat_deg) > most_degrees)
      return false;
    if (from.lon_deg == to.lon_deg) return true;
    const Point off = normalized(p + q) - unit_vector(middle);
    return dot(off, off) <= squared_tolerance_;
  }

  double squared_tolerance_;
};

double doubled_planar_area(const std::vector<LonLat>& ring) {
  double area = 0;
  const LonLat& o = ring.front();
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
    const LonLat& p = ring[k];
    const LonLat& q = ring[k + 1];
    area += (p.lon_deg - o.lon_deg) * (q.lat_deg - o.lat_deg) -
            (q.lon_deg - o.lon_deg) * (p.lat_deg - o.lat_deg);
  }
  return area;
}

// With the inside to the left.
std::vector<Point> corners_of(const io::LonLatRing& ring, const PolygonOptions& options) {
  std::vector<Point> corners;
  bool is_clockwise = false;
  if (options.edges == PolygonEdges::geodesic) {
    for (const LonLat& position : ring.positions) corners.push_back(unit_vector(position));
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    is_clockwise = map::area_on_left(corners) < 0;
  } else {
    const LineDivider divider(options.tolerance_deg * radians_per_degree);
    for (std::size_t k = 0; k < ring.positions.size(); ++k) {
      divider.append(ring.positions[k], ring.positions[k + 1 < ring.positions.size() ? k + 1 : 0],
                     corners);
    }
    is_clockwise = doubled_planar_area(ring.positions) < 0;
  }
  if (is_clockwise != ring.is_hole) std::ranges::reverse(corners);
  return corners;
}

io::PolygonFeatures features_of(const FileName& file, io::FeatureKinds kinds,
                                const PolygonOptions& options) {
  if (!(options.tolerance_deg > 0)) {
    throw InvalidInput(
        "the tolerance " + std::to_string(options.tolerance_deg) + " is not positive", 0);
  }
  return io::read_polygon_features(file, kinds);
}

CellRings cells_of_features(const io::PolygonFeatures& features, const PolygonOptions& options,
                            const Execution& execution) {
  std::vector<overlay::KeyedArc> arcs;
  for (std::size_t i = 0; i < features.rings.size(); ++i) {
    for (const io::LonLatRing& ring : features.rings[i]) {
      const std::vector<Point> corners = corners_of(ring, options);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        arcs.push_back(
            {static_cast<Index>(i), corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]});
      }
    }
  }
  return overlay::rings_around(arcs, features.rings.size(), execution.threads);
}

FeatureLines lines_of_features(const io::PolygonFeatures& features, const PolygonOptions& options) {
  FeatureLines all;
  const LineDivider divider(options.tolerance_deg * radians_per_degree);
  for (const auto& lines : features.lines) {
    for (const std::vector<LonLat>& line : lines) {
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        if (options.edges == PolygonEdges::geodesic) {
          all.points.push_back(unit_vector(line[k]));
        } else {
          divider.append(line[k], line[k + 1], all.points);
        }
      }
      all.points.push_back(unit_vector(line.back()));
      all.lines.push_back(all.points.size());
    }
    all.features.push_back(all.lines.size() - 1);
  }
  return all;
}

}  // namespace

PolygonTable read_polygons(const FileName& file, const PolygonOptions& options,
                           const Execution& execution) {
  const system::Call call(execution);
  io::PolygonFeatures features = features_of(file, io::FeatureKinds::polygons, options);
  CellRings cells = cells_of_features(features, options, execution);
  return {std::move(features.name), std::move(cells), std::move(features.columns)};
}

FeatureTable read_features(const FileName& file, const PolygonOptions& options,
                           const Execution& execution) {
  const system::Call call(execution);
  io::PolygonFeatures features = features_of(file, io::FeatureKinds::all, options);
  FeatureLines lines = lines_of_features(features, options);
  CellRings polygons = cells_of_features(features, options, execution);
  return {std::move(features.name), std::move(lines), std::move(polygons),
          std::move(features.columns)};
}

}  // namespace rondel
