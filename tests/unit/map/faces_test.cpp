// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Drawn faces and cells of sites at very different distances: how far their lines are from the arcs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "exact/vector.h"
#include "map/cell_map.h"
#include "map/face_map.h"
#include "rondel/delaunay.h"
#include "support/random.h"
#include "unit/map/cells_planar.h"

namespace rondel::test::of_faces {
namespace {

constexpr double face_degree = std::numbers::pi / 180;

Point at_position(const LonLat& p) {
  return {std::cos(p.lat_deg * face_degree) * std::cos(p.lon_deg * face_degree),
          std::cos(p.lat_deg * face_degree) * std::sin(p.lon_deg * face_degree),
          std::sin(p.lat_deg * face_degree)};
}

// Rows of sites that are near each other along a row and far from the next row, or the other way round.
std::vector<Point> sites_in_rows(Random& random, double along, double across) {
  std::vector<Point> sites;
  for (int row = 0; row < 8; ++row) {
    for (int k = 0; k < 12; ++k) {
      sites.push_back(at_position(
          {20 + along * (k + 0.3 * random.unit()), 40 + across * row * (1 + 0.2 * random.unit())}));
    }
  }
  return sites;
}

// A tenth of the least height of a triangle in degrees, from 1e-5 to 0.01.
double tolerance_of(const std::array<Point, 3>& corners) {
  const auto side = [&](std::size_t i) {
    const Point d = corners[(i + 1) % 3] - corners[i];
    return std::sqrt(dot(d, d));
  };
  const double a = side(0);
  const double b = side(1);
  const double c = side(2);
  const double s = (a + b + c) / 2;
  const double area = std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
  return std::clamp(2 * area / std::max({a, b, c}) / face_degree / 10, 1e-5, 0.01);
}

// Each side of a face is within the tolerances of the two faces at its arc, which are those of the narrower one.
TEST(face_map, sides_are_near_their_arcs) {
  Random random(76);
  int num_divided = 0;
  for (const auto& [along, across] : {std::array{4.0, 1.0}, {2.0, 0.05}, {0.2, 3.0}, {3.0, 3.0}}) {
    const Triangulation triangulation = delaunay(sites_in_rows(random, along, across));
    const std::span<const Point> sites = triangulation.sites().points();
    const map::FaceMap faces(triangulation, {.threads = 2});
    map::FaceMap::Pen pen;
    const auto corners_of = [&](Index face) {
      const Triple& t = triangulation.faces()[face];
      return std::array<Point, 3>{sites[t[0]], sites[t[1]], sites[t[2]]};
    };
    for (Index face = 0; face < triangulation.num_faces(); ++face) {
      if (triangulation.is_ghost(face)) continue;
      const std::array<Point, 3> corners = corners_of(face);
      const auto& polygons = faces.polygons(face, pen);
      ASSERT_EQ(polygons.size(), 1U);
      const std::vector<LonLat>& ring = polygons[0].ring;
      num_divided += ring.size() > 4 ? 1 : 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index neighbor = triangulation.neighbors()[face][(i + 2) % 3];
        double allowed = tolerance_of(corners);
        if (!triangulation.is_ghost(neighbor))
          allowed = std::min(allowed, tolerance_of(corners_of(neighbor)));
        const Point normal = normalized(cross(corners[i], corners[(i + 1) % 3]));
        for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
          const LonLat& p = ring[k];
          const LonLat& q = ring[k + 1];
          if (std::abs(dot(normal, at_position(p))) > 1e-13 ||
              std::abs(dot(normal, at_position(q))) > 1e-13)
            continue;
          for (const double t : {0.25, 0.5, 0.75}) {
            const LonLat place{std::lerp(p.lon_deg, q.lon_deg, t),
                               std::lerp(p.lat_deg, q.lat_deg, t)};
            EXPECT_LE(std::abs(dot(normal, at_position(place))) / face_degree, allowed * 1.0001)
                << face << ", side " << i;
          }
        }
      }
    }
  }
  EXPECT_GT(num_divided, 50);
}

// Each cell contains its site, also with a tolerance much larger than the distance of sites. Returns the number of positions
// of all cells.
std::size_t expect_sites_inside(const std::vector<Point>& sites, double tolerance_deg,
                                const char* name) {
  const Triangulation triangulation = delaunay(sites);
  const Cells diagram = cells(triangulation);
  const map::CellMap map(triangulation, diagram, tolerance_deg, {.threads = 1});
  map::CellMap::Pen pen;
  std::size_t num_positions = 0;
  for (std::size_t site = 0; site < sites.size(); ++site) {
    const auto& polygons = map.polygons(site, pen);
    for (const map::LonLatPolygon& polygon : polygons) num_positions += polygon.ring.size();
    EXPECT_EQ(fault(polygons), "") << name << ", site " << site;
    const Point& p = sites[site];
    const LonLat position{std::atan2(p.y, p.x) / face_degree, std::asin(p.z) / face_degree};
    EXPECT_TRUE(contains(polygons, position)) << name << ", site " << site;
  }
  return num_positions;
}

// Two sites are next to each other in the north and the south, so that the line between their cells may not be far from its
// arc, while the other lines of the cells may.
TEST(cell_map, lines_between_close_sites_are_near_their_arcs) {
  Random random(77);
  std::vector<Point> sites;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 5; ++y) {
      const LonLat p{30 + 4 * (x + 0.2 * random.unit()), 44 + 3 * (y + 0.2 * random.unit())};
      sites.push_back(at_position(p));
      sites.push_back(at_position({p.lon_deg, p.lat_deg + 0.002}));
    }
  }
  expect_sites_inside(sites, 1, "pairs");
  for (int round = 0; round < 4; ++round) {
    random.shuffle(sites);
    expect_sites_inside(sites, 1, "shuffled pairs");
  }
}

// Of sites on the equator or a meridian two are close: those at each place of the order of sites.
TEST(cell_map, two_sites_of_a_great_circle_are_close) {
  constexpr int count = 6;
  for (int close = 0; close < count; ++close) {
    std::size_t num_positions = 0;
    for (int first = 0; first < count; ++first) {
      std::vector<Point> sites;
      for (int k = 0; k < count; ++k) {
        const int place = (k + first) % count;
        const double next = place + 1 == count ? 2 * std::numbers::pi : place + 1;
        const double angle = place == close ? next - 1e-4 : place;
        sites.push_back({std::cos(angle), std::sin(angle), 0});
      }
      expect_sites_inside(sites, 5, "equator");
      for (Point& p : sites) p = {0, p.x, p.y};
      const std::size_t number = expect_sites_inside(sites, 5, "meridian");
      // The order of sites changes nothing.
      if (first > 0) {
        EXPECT_EQ(number, num_positions) << close << ' ' << first;
      }
      num_positions = number;
    }
  }
}

}  // namespace
}  // namespace rondel::test::of_faces
