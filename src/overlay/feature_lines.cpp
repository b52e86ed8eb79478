// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "arrangement/arc_checks.h"
#include "overlay/feature_polygons.h"
#include "rondel/delaunay.h"

namespace rondel::overlay {
namespace {

// Appends a point to a line, unless the line is there already.
void append_point(const Point& point, std::size_t first_of_line, std::vector<Point>& points) {
  if (points.size() == first_of_line || points.back() != point) points.push_back(point);
}

// Calls visit(from, to) for each side of a line; for a line in one place with this place twice.
template <class Visit>
void visit_sides(const std::vector<LonLat>& line, const Visit& visit) {
  const bool is_place =
      std::ranges::all_of(line, [&](const LonLat& position) { return position == line.front(); });
  if (is_place) return visit(line.front(), line.front());
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    if (line[k] != line[k + 1]) visit(line[k], line[k + 1]);
  }
}

}  // namespace

void require_lines(const map::PolygonFeatures& features, std::size_t feature, bool is_repaired) {
  for (const std::vector<LonLat>& line : features.lines[feature]) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      if (std::abs(line[k].lon_deg) > max_turns * 360) {
        refuse_feature(
            features, feature,
            "longitude " + text_of_place(line[k]) + " is more than ten turns of the globe away");
      }
      if (k == 0 || is_repaired) continue;
      if (std::abs(line[k].lon_deg - line[k - 1].lon_deg) <= 180) continue;
      refuse_feature(features, feature,
                     "its line from " + text_of_place(line[k - 1]) + " to " +
                         text_of_place(line[k]) +
                         " spans more than 180 degrees of longitude: a line across the "
                         "antimeridian has to be cut there, or to be read with geodesic edges; if "
                         "the long way is meant, divide it by a position");
    }
  }
}

void append_line_sides(const map::PolygonFeatures& features, std::vector<PlaneSide>& sides) {
  for (const auto& lines : features.lines) {
    for (const std::vector<LonLat>& line : lines) {
      visit_sides(line, [&](const LonLat& from, const LonLat& to) {
        const bool is_long = std::abs(to.lon_deg - from.lon_deg) > 180;
        sides.push_back({from, is_long ? map::end_of_shorter(from, to) : to});
      });
    }
  }
}

FeatureLines divided_lines(const map::PolygonFeatures& features, const DividedSides& divided,
                           std::size_t first) {
  FeatureLines all;
  std::vector<Point>& points = all.rows.values;
  std::size_t side = first;
  for (const auto& lines : features.lines) {
    for (const std::vector<LonLat>& line : lines) {
      const std::size_t first_of_line = points.size();
      visit_sides(line, [&](const LonLat&, const LonLat&) {
        for (const LonLat& p : divided[side]) append_point(unit_vector(p), first_of_line, points);
        ++side;
      });
      append_point(unit_vector(line.back()), first_of_line, points);
      all.rows.end_row();
    }
    all.end_group();
  }
  return all;
}

FeatureLines geodesic_lines(const map::PolygonFeatures& features) {
  FeatureLines all;
  std::vector<Point>& points = all.rows.values;
  for (std::size_t f = 0; f < features.lines.size(); ++f) {
    for (const std::vector<LonLat>& line : features.lines[f]) {
      const std::size_t first_of_line = points.size();
      for (const LonLat& position : line) {
        const Point point = unit_vector(position);
        if (points.size() > first_of_line && arrangement::are_opposite(points.back(), point)) {
          refuse_feature(features, f,
                         "its line leads to the opposite place, " + text_of_place(position) +
                             ": divide it by a position");
        }
        append_point(point, first_of_line, points);
      }
      all.rows.end_row();
    }
    all.end_group();
  }
  return all;
}

}  // namespace rondel::overlay
