// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons that share sides, and their mirror images: what a sweep from west to east says does not depend on where the
// south is. Rings are boxes and triangles of a lattice; unit squares, cut by both diagonals and halved, tell what is inside of what.
// RONDEL_TEST_SCALE multiplies the number of polygons.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "rondel/regions.h"
#include "support/generators.h"
#include "unit/overlay/planar.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

struct LatticePoint {
  int x;
  int y;
};
using LatticeRing = std::vector<LatticePoint>;
using LatticePolygon = std::vector<LatticeRing>;  // a shell and holes

constexpr int lattice_size = 3;  // on both sides of the origin

long turn_on_lattice(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return static_cast<long>(b.x - a.x) * (c.y - a.y) - static_cast<long>(b.y - a.y) * (c.x - a.x);
}

class LatticePolygons {
 public:
  explicit LatticePolygons(std::uint64_t seed) : random_(seed) {}

  std::vector<LatticePolygon> operator()() {
    constexpr int s = lattice_size;
    std::vector<LatticePolygon> polygons = {{box(-s, -s, s, s)}};
    if (random_.below(4) == 0) polygons[0][0].insert(polygons[0][0].begin() + 3, {0, coordinate()});
    for (std::size_t k = random_.below(4); k > 0; --k) polygons[0].push_back(ring());
    for (std::size_t k = random_.below(3); k > 0; --k) {
      polygons.push_back({ring()});
      if (random_.below(3) == 0) polygons.back().push_back(ring());
    }
    return polygons;
  }

 private:
  int coordinate() { return static_cast<int>(random_.below(2 * lattice_size + 1)) - lattice_size; }
  static LatticeRing box(int w, int s, int e, int n) { return {{w, s}, {e, s}, {e, n}, {w, n}}; }
  LatticeRing ring() {
    for (;;) {
      if (random_.below(3) > 0) {
        const auto [w, e] = std::minmax({coordinate(), coordinate()});
        const auto [s, n] = std::minmax({coordinate(), coordinate()});
        if (w < e && s < n) return box(w, s, e, n);
      } else {
        LatticeRing corners = {{coordinate(), coordinate()},
                               {coordinate(), coordinate()},
                               {coordinate(), coordinate()}};
        if (turn_on_lattice(corners[0], corners[1], corners[2]) != 0) return corners;
      }
    }
  }
  Random random_;
};

bool sides_cross(const std::vector<LatticePolygon>& polygons) {
  std::vector<std::pair<LatticePoint, LatticePoint>> sides;
  for (const LatticePolygon& polygon : polygons) {
    for (const LatticeRing& ring : polygon) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        sides.emplace_back(ring[k], ring[(k + 1) % ring.size()]);
      }
    }
  }
  const auto are_apart = [](long s, long t) { return (s < 0 && t > 0) || (s > 0 && t < 0); };
  for (const auto& [a, b] : sides) {
    for (const auto& [c, d] : sides) {
      if (are_apart(turn_on_lattice(a, b, c), turn_on_lattice(a, b, d)) &&
          are_apart(turn_on_lattice(c, d, a), turn_on_lattice(c, d, b))) {
        return true;
      }
    }
  }
  return false;
}

// Whether a place that is on no side is inside, by the sides to the east of it.
bool is_inside(const LatticeRing& ring, double x, double y) {
  bool is_in = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LatticePoint& p = ring[k];
    const LatticePoint& q = ring[(k + 1) % ring.size()];
    if ((p.y > y) == (q.y > y)) continue;
    if (x < p.x + (y - p.y) * (q.x - p.x) / (q.y - p.y)) is_in = !is_in;
  }
  return is_in;
}

// Places of an irregular mesh, finer than what sides of the lattice can leave between them.
bool rings_fit(const std::vector<LatticePolygon>& polygons) {
  constexpr int steps = 40 * lattice_size;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double x = lattice_size * (2 * (i + 0.4142135) / steps - 1);
      const double y = lattice_size * (2 * (j + 0.7320508) / steps - 1);
      int num_inside = 0;
      for (const LatticePolygon& polygon : polygons) {
        int num_holes = 0;
        for (std::size_t r = 1; r < polygon.size(); ++r) num_holes += is_inside(polygon[r], x, y);
        const int in_shell = is_inside(polygon[0], x, y) ? 1 : 0;
        if (num_holes > in_shell) return false;
        num_inside += in_shell - num_holes;
      }
      if (num_inside > 1) return false;
    }
  }
  return true;
}

double twice_the_area(const LatticeRing& ring) {
  long sum = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    sum += turn_on_lattice(ring[0], ring[k], ring[k + 1]);
  }
  return static_cast<double>(std::abs(sum));
}

bool has_empty_polygon(const std::vector<LatticePolygon>& polygons) {
  return std::ranges::any_of(polygons, [](const LatticePolygon& polygon) {
    double left = twice_the_area(polygon[0]);
    for (std::size_t r = 1; r < polygon.size(); ++r) left -= twice_the_area(polygon[r]);
    return left <= 0;
  });
}

// The polygon by one of the eight symmetries of the square.
RingInPlane turned_ring(const LatticeRing& ring, unsigned symmetry) {
  constexpr double degrees = 8;
  RingInPlane result;
  for (auto [x, y] : ring) {
    if ((symmetry & 1U) != 0) x = -x;
    if ((symmetry & 2U) != 0) y = -y;
    if ((symmetry & 4U) != 0) std::swap(x, y);
    result.push_back({degrees * x, degrees * y});
  }
  return result;
}

void expect_alike(const std::vector<LatticePolygon>& polygons) {
  const bool is_region =
      !sides_cross(polygons) && rings_fit(polygons) && !has_empty_polygon(polygons);
  for (unsigned symmetry = 0; symmetry < 8; ++symmetry) {
    SCOPED_TRACE(symmetry);
    std::vector<std::string> parts;
    double area = 0;
    for (const LatticePolygon& polygon : polygons) {
      std::vector<RingInPlane> rings;
      for (const LatticeRing& ring : polygon) rings.push_back(turned_ring(ring, symmetry));
      for (std::size_t r = 0; r < rings.size(); ++r) {
        area += (r > 0 ? -1 : 1) * area_in_plane(rings[r]);
      }
      parts.push_back(planar_polygon(rings));
      SCOPED_TRACE(parts.back());
    }
    const std::string message = planar_message({parts});
    EXPECT_EQ(message.empty(), is_region) << message << ' ' << parts[0] << ' ' << parts.back();
    if (!message.empty() || !is_region) continue;
    EXPECT_NEAR(areas(planar_table({parts}).cells)[0], area, 1e-3 * area);
  }
}

TEST(overlay_flips, rings_that_share_sides_are_read_alike_in_all_directions) {
  LatticePolygons polygons(1);
  for (std::size_t i = 0, n = scaled(40); i < n; ++i) expect_alike(polygons());
}

TEST(overlay_flips, a_hole_may_share_any_side_of_its_shell) {
  const auto box = [](int w, int s, int e, int n) {
    return LatticeRing{{w, s}, {e, s}, {e, n}, {w, n}};
  };
  const LatticeRing shell = box(-3, -3, 3, 3);
  expect_alike({{shell, box(-1, -3, 1, -2)}});
  expect_alike({{shell, box(-3, -3, -1, -2)}});
  expect_alike({{shell, box(-1, -1, 1, 0), box(-1, 0, 1, 1)}});
  expect_alike({{shell, box(-1, -3, 1, 3)}});
  expect_alike({{shell, box(-1, -3, 1, 0)}, {box(0, -3, 1, -1)}});
  expect_alike({{shell, box(-1, -3, 1, 0)}, {box(-1, -3, 1, 0)}});
  expect_alike({{box(-3, -3, 0, 3), box(0, -1, 2, 1)}});  // outside, side by side
  expect_alike({{shell, shell}});
}

// The world without the land around its southern pole.
TEST(overlay_flips, the_map_may_have_a_hole_along_its_edge) {
  for (const double pole : {-90.0, 90.0}) {
    const RingInPlane cap =
        planar_box(-180, std::min(pole, pole * 2 / 3), 180, std::max(pole, pole * 2 / 3));
    const CellTable table = planar_table({{planar_polygon({planar_box(-180, -90, 180, 90), cap})}});
    const double area = 4 * std::numbers::pi - area_in_plane(cap);
    EXPECT_NEAR(areas(table.cells)[0], area, 1e-5);
  }
}

TEST(overlay_flips, what_does_not_fit_is_named) {
  const RingInPlane box = planar_box(0, 0, 10, 10);
  const auto message = [](const std::vector<std::string>& parts) {
    return planar_message({parts});
  };
  EXPECT_EQ(message({planar_polygon({box, box})}),
            "feature 0 (f0): the holes of ring 0 of part 0 leave nothing of it");
  EXPECT_EQ(message({planar_polygon({box, planar_box(0, 0, 10, 4), planar_box(0, 4, 10, 10)})}),
            "feature 0 (f0): the holes of ring 0 of part 0 leave nothing of it");
  EXPECT_EQ(message({planar_polygon({box, planar_box(2, 10, 8, 12)})}),
            "feature 0 (f0): ring 1 of part 0, a hole, does not lie inside of its polygon at 2 10");
  EXPECT_EQ(message({planar_polygon({box, planar_box(2, 2, 8, 8), planar_box(2, 2, 8, 8)})}),
            "feature 0 (f0): ring 2 of part 0, a hole, does not lie inside of its polygon but in "
            "ring 1 of part 0 at 2 2");
}

// Triangles left and right of a side next to a pole, whose places are off by some roundings.
TEST(overlay_flips, neighbors_beside_a_pole_have_their_common_side_alike) {
  Random random(9);
  const auto between = [&](double low, double high) { return low + (high - low) * random.unit(); };
  const auto noisy = [&](double x) { return x + 1.4e-14 * std::round(between(-6, 6)); };
  for (std::size_t i = 0, n = scaled(60); i < n; ++i) {
    const double lon = std::round(between(80, 120)) + 0.25 * std::round(between(0, 4));
    const double z = i % 2 == 0 ? 1 : -1;
    const LonLat pole = {lon, z * 90};
    const LonLat end = {noisy(lon + 0.25), z * noisy(90 - 0.25 * std::round(between(1, 4)))};
    const LonLat east = {lon + 0.25 * std::round(between(2, 3)),
                         z * (90 - 0.25 * std::round(between(1, 4)))};
    const LonLat west = {lon - 0.25, z * (90 - 0.25 * std::round(between(0, 4)))};
    SCOPED_TRACE(text_of({pole, end, east}) + text_of({pole, end, west}));
    const auto side = [&](const LonLat& p) {
      return (end.lon_deg - pole.lon_deg) * (p.lat_deg - pole.lat_deg) -
             (end.lat_deg - pole.lat_deg) * (p.lon_deg - pole.lon_deg);
    };
    if (!(side(east) * side(west) < -1e-6)) continue;
    EXPECT_EQ(planar_message(
                  {{planar_polygon({{pole, end, east}})}, {planar_polygon({{pole, west, end}})}},
                  {.overlap = PolygonOverlap::error}),
              "");
  }
}

}  // namespace
}  // namespace rondel::test
