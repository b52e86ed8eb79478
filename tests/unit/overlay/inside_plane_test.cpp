// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The inside of hostile polygons of files, read with straight lines in longitude and latitude and
// with arcs, is right. Lines are judged in their plane, by rational numbers and by integrals, arcs
// by the oracle of oracle.h, and so are the pieces of what was read. RONDEL_TEST_SCALE
// multiplies the number of polygons.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "rondel/remap.h"
#include "support/generators.h"
#include "unit/overlay/planar.h"
#include "unit/overlay/trial.h"

namespace rondel::test {
namespace {

using PolygonInPlane = std::vector<RingInPlane>;  // a shell and holes

constexpr std::array<const char*, 13> kinds_in_plane = {
    "sliver",  "folded", "bow_tie", "bow_tie_with_a_corner",
    "keyhole", "spike",  "islands", "world_less_islands",
    "belt",    "octant", "pole",    "antimeridian",
    "tangle"};

// Polygons, and what is known of them.
struct ShapeInPlane {
  std::vector<PolygonInPlane> polygons;
  std::vector<RingInPlane> plus = {};   // the area is that of these
  std::vector<RingInPlane> minus = {};  // less that of these
  bool may_be_nothing = false;
};

class PlaneShapes {
 public:
  explicit PlaneShapes(std::uint64_t seed) : random_(seed) {}

  ShapeInPlane operator()(std::size_t kind);

 private:
  double uniform(double low, double high) { return low + (high - low) * random_.unit(); }
  double power(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  std::size_t below(std::size_t n) { return random_.below(n); }
  bool one_of(std::size_t n) { return below(n) == 0; }
  LonLat center() {
    const LonLat p = {uniform(-150, 150), uniform(-60, 60)};
    return one_of(3) ? LonLat{std::round(p.lon_deg), std::round(p.lat_deg)} : p;
  }
  RingInPlane circle(const LonLat& at, double radius, std::size_t n) {
    RingInPlane ring;
    const double first = uniform(0, 1);
    for (std::size_t k = 0; k < n; ++k) {
      const double angle =
          2 * std::numbers::pi * (static_cast<double>(k) + first) / static_cast<double>(n);
      ring.push_back(
          {at.lon_deg + radius * std::cos(angle), at.lat_deg + radius * std::sin(angle)});
    }
    if (one_of(2)) std::ranges::reverse(ring);
    return ring;
  }
  ShapeInPlane one(RingInPlane ring) {
    ShapeInPlane shape;
    shape.plus = {ring};
    shape.polygons = {{std::move(ring)}};
    return shape;
  }
  ShapeInPlane sliver();
  ShapeInPlane fold();
  ShapeInPlane bow_tie(bool has_corner);
  ShapeInPlane keyhole();
  ShapeInPlane spike();
  ShapeInPlane islands(bool is_world);
  ShapeInPlane belt();
  ShapeInPlane octant();
  ShapeInPlane pole();
  ShapeInPlane antimeridian();

  Random random_;
};

ShapeInPlane PlaneShapes::sliver() {
  const LonLat p = center();
  const double length = power(-5, 1.4);
  const double turn = uniform(0, 2 * std::numbers::pi);
  const double x = std::cos(turn);
  const double y = std::sin(turn);
  const double width = length * power(-13, 0);
  const std::size_t size = 1 + below(3);
  RingInPlane ring = {p, {p.lon_deg + x * length, p.lat_deg + y * length}};
  for (std::size_t k = 0; k < size; ++k) {
    const double t =
        length * (1 - (static_cast<double>(k) + uniform(0.2, 0.8)) / static_cast<double>(size));
    ring.push_back({p.lon_deg + x * t - y * width, p.lat_deg + y * t + x * width});
  }
  if (one_of(2)) std::ranges::reverse(ring);
  ShapeInPlane shape = one(ring);
  shape.may_be_nothing = width < 1e-12;
  return shape;
}

// To and fro along a line, to rounding.
ShapeInPlane PlaneShapes::fold() {
  const LonLat p = center();
  const double length = power(-4, 1.4);
  const bool is_whole = one_of(2);
  const LonLat along = {is_whole ? std::round(uniform(-9, 9)) : length * uniform(-1, 1),
                        is_whole ? std::round(uniform(-9, 9)) : length * uniform(-1, 1)};
  RingInPlane ring;
  for (std::size_t k = 3 + below(3); k > 0; --k) {
    const double t = is_whole ? std::round(uniform(0, 3)) : uniform(0, 1);
    ring.push_back({p.lon_deg + t * along.lon_deg, p.lat_deg + t * along.lat_deg});
  }
  ShapeInPlane shape = one(ring);
  shape.may_be_nothing = true;
  return shape;
}

ShapeInPlane PlaneShapes::bow_tie(bool has_corner) {
  const LonLat p =
      has_corner ? LonLat{std::round(uniform(-99, 99)), std::round(uniform(-50, 50))} : center();
  const double size = has_corner ? std::exp2(std::round(uniform(-20, 4))) : power(-6, 1);
  const RingInPlane box =
      planar_box(p.lon_deg - size, p.lat_deg - size, p.lon_deg + size, p.lat_deg + size);
  if (!has_corner) {
    RingInPlane ring = {box[0], box[2], box[1], box[3]};
    if (one_of(2)) ring[below(4)].lon_deg += size * uniform(-0.5, 0.5);
    return one(ring);
  }
  ShapeInPlane shape = one({box[0], p, box[2], box[1], p, box[3]});
  shape.plus = {{box[0], p, box[3]}, {box[2], box[1], p}};
  return shape;
}

ShapeInPlane PlaneShapes::keyhole() {
  const LonLat p = center();
  const double radius = power(-6, 1);
  const RingInPlane outer = circle(p, radius, 3 + below(5));
  RingInPlane hole = circle(p, radius / uniform(2.5, 30), 3 + below(5));
  ShapeInPlane shape = one(outer);
  shape.minus = {hole};
  if (one_of(2)) {
    shape.polygons = {{outer, hole}};
    return shape;
  }
  const auto square = [&](const LonLat& q) {
    return std::pow(q.lon_deg - outer[0].lon_deg, 2) + std::pow(q.lat_deg - outer[0].lat_deg, 2);
  };
  std::rotate(hole.begin(), std::ranges::min_element(hole, {}, square), hole.end());
  RingInPlane ring = outer;
  ring.push_back(outer[0]);
  ring.insert(ring.end(), hole.begin(), hole.end());
  ring.push_back(hole[0]);
  shape.polygons = {{ring}};
  return shape;
}

ShapeInPlane PlaneShapes::spike() {
  const LonLat p = center();
  const RingInPlane outer = circle(p, power(-6, 1), 3 + below(5));
  RingInPlane ring;
  for (const LonLat& q : outer) {
    ring.push_back(q);
    if (!one_of(2)) continue;
    const double t = one_of(2) ? uniform(0.1, 1) : uniform(-0.9, -0.1);
    ring.push_back(
        {q.lon_deg + t * (q.lon_deg - p.lon_deg), q.lat_deg + t * (q.lat_deg - p.lat_deg)});
    ring.push_back(q);
  }
  ShapeInPlane shape = one(ring);
  shape.plus = {outer};
  return shape;
}

// Islands, or the world without them, of which some have a lagoon's island.
ShapeInPlane PlaneShapes::islands(bool is_world) {
  const LonLat p = center();
  const double radius = power(-5, 1.2);
  const std::size_t n = 1 + below(one_of(10) ? 200 : 20);
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  const double step = radius / static_cast<double>(side);
  ShapeInPlane shape;
  PolygonInPlane world = {planar_box(-180, -90, 180, 90)};
  if (is_world) shape.plus = world;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t row = k / side;
    const std::size_t column = k % side;
    const LonLat at = {p.lon_deg - radius + step * static_cast<double>(2 * column + 1),
                       p.lat_deg - radius + step * static_cast<double>(2 * row + 1)};
    const double size = 0.9 * step * power(-3, 0);
    const RingInPlane island = circle(at, size, 3 + below(6));
    (is_world ? shape.minus : shape.plus).push_back(island);
    if (is_world) {
      world.push_back(island);
    } else {
      shape.polygons.push_back({island});
    }
    if (!one_of(5)) continue;
    const RingInPlane inner = circle(at, size / 3, 4);
    if (is_world) {
      shape.polygons.push_back({inner});
      shape.plus.push_back(inner);
    } else {
      shape.polygons.back().push_back(inner);
      shape.minus.push_back(inner);
    }
  }
  if (is_world) shape.polygons.push_back(world);
  return shape;
}

// Around the globe.
ShapeInPlane PlaneShapes::belt() {
  const double south = one_of(3) ? 0 : uniform(-80, 80);
  const double width = power(-9, 1);
  const double west = one_of(2) ? -180 : uniform(-170, 170);
  RingInPlane ring = planar_box(west, south, west + 360, south + width);
  if (one_of(2)) ring.insert(ring.begin() + 1, {west + uniform(1, 350), south - width / 3});
  ShapeInPlane shape = one(ring);
  return shape;
}

ShapeInPlane PlaneShapes::octant() {
  const double west = 90 * std::round(uniform(-2, 1));
  const double south = one_of(2) ? 0 : -90;
  return one(planar_box(west, south, west + 90 * (1.0 + static_cast<double>(below(3))),
                        one_of(2) ? south + 90 : 90));
}

// At a pole, along the edge of the map.
ShapeInPlane PlaneShapes::pole() {
  const double z = one_of(2) ? 1 : -1;
  const double west = one_of(2) ? -180 : uniform(-180, 0);
  const double width = one_of(2) ? 360 : uniform(1, 359);
  const double radius = power(-6, 2);
  RingInPlane ring;
  for (std::size_t k = 0, n = 2 + below(9); k <= n; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(n);
    const double lat = 90 - radius * (k == 0 || k == n ? 1 : uniform(0.3, 1));
    ring.push_back({k == n ? west + width : west + t * width, z * lat});
  }
  ring.push_back({west + width, z * 90});
  ring.push_back({west, z * 90});
  return one(ring);
}

// Cut there, or going on.
ShapeInPlane PlaneShapes::antimeridian() {
  const double lat = uniform(-80, 70);
  const double width = power(-6, 1);
  if (one_of(2)) {
    return one(circle({one_of(2) ? 180.0 : -180.0, lat}, std::min(width, 9.0), 3 + below(9)));
  }
  const double height = uniform(0.5, 1) * width;
  const RingInPlane west = {{180 - width, lat}, {180, lat}, {180, lat + height}};
  const RingInPlane east = {{-180, lat}, {-180 + width, lat + height / 2}, {-180, lat + height}};
  ShapeInPlane shape;
  shape.polygons = {{west}, {east}};
  shape.plus = {west, east};
  return shape;
}

ShapeInPlane PlaneShapes::operator()(std::size_t kind) {
  switch (kind) {
    case 0:
      return sliver();
    case 1:
      return fold();
    case 2:
    case 3:
      return bow_tie(kind == 3);
    case 4:
      return keyhole();
    case 5:
      return spike();
    case 6:
    case 7:
      return islands(kind == 7);
    case 8:
      return belt();
    case 9:
      return octant();
    case 10:
      return pole();
    case 11:
      return antimeridian();
    default: {
      const LonLat p = center();
      const double radius = power(-6, 1);
      RingInPlane ring;
      for (std::size_t k = 3 + below(4); k > 0; --k) {
        ring.push_back(
            {p.lon_deg + uniform(-radius, radius), p.lat_deg + uniform(-radius, radius)});
      }
      return one(ring);
    }
  }
}

// The sign of the turn from a by b to c, in rational numbers.
int turn_in_plane(const LonLat& a, const LonLat& b, const LonLat& c) {
  const auto q = [](double x) { return mpq_class(x); };
  const mpq_class value = (q(b.lon_deg) - q(a.lon_deg)) * (q(c.lat_deg) - q(a.lat_deg)) -
                          (q(b.lat_deg) - q(a.lat_deg)) * (q(c.lon_deg) - q(a.lon_deg));
  return sgn(value);
}

// Whether two sides cross in the inside of both.
bool has_crossing_in_plane(const std::vector<PolygonInPlane>& polygons) {
  std::vector<std::pair<LonLat, LonLat>> sides;
  for (const PolygonInPlane& polygon : polygons) {
    for (const RingInPlane& ring : polygon) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        sides.emplace_back(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]);
      }
    }
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto& [a, b] = sides[s];
    for (std::size_t t = s + 1; t < sides.size(); ++t) {
      const auto& [c, d] = sides[t];
      if (std::max(c.lon_deg, d.lon_deg) < std::min(a.lon_deg, b.lon_deg) ||
          std::min(c.lon_deg, d.lon_deg) > std::max(a.lon_deg, b.lon_deg)) {
        continue;
      }
      if (turn_in_plane(a, b, c) * turn_in_plane(a, b, d) < 0 &&
          turn_in_plane(c, d, a) * turn_in_plane(c, d, b) < 0) {
        return true;
      }
    }
  }
  return false;
}

std::string text_of_polygon(const PolygonInPlane& polygon) { return planar_polygon(polygon); }

CellTable table_of(const ShapeInPlane& shape, PolygonEdges edges) {
  std::vector<std::string> parts;
  std::ranges::transform(shape.polygons, std::back_inserter(parts), text_of_polygon);
  return planar_table({parts}, {.edges = edges});
}

std::vector<RingOfPoints> rings_of_cell(const CellRings& cells) {
  std::vector<RingOfPoints> rings;
  for (std::size_t r = 0; r + 1 < cells.rings.size(); ++r) {
    RingOfPoints& ring = rings.emplace_back();
    for (auto k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
      ring.push_back(cells.points[cells.corners[k]]);
    }
  }
  return rings;
}

// As wide as the widest of arcs of this length may be beside their lines, at most the tolerance, and at most a thousandth of the area.
double tolerance_of(const ShapeInPlane& shape, double area) {
  double length = 0;
  for (const auto& rings : {shape.plus, shape.minus}) {
    for (const RingInPlane& ring : rings) length += planar_length(ring);
  }
  const double arc = std::min(1e-4 * std::numbers::pi / 180, length * length);
  const double rounding = 1e-14 * length;
  return rounding + std::min(1e-3 * area, 2 * arc * length);
}

void expect_pieces_of_cells(const CellRings& cells, std::uint64_t seed) {
  const std::vector<Cover>& covers = known_covers(seed % num_cover_sets);
  if (!cells.whole.empty()) return;
  Trial trial(rings_of_cell(cells), false);
  EXPECT_LE(trial.oracle().excess(), 1e-14) << "what was read bounds nothing";
  const Cover& cover = covers[(seed / num_cover_sets) % covers.size()];
  SCOPED_TRACE(cover.name);
  trial.expect_pieces(cover, seed);
}

void expect_lines(const ShapeInPlane& shape, std::uint64_t seed) {
  SCOPED_TRACE("lines");
  std::optional<CellTable> table;
  try {
    table = table_of(shape, PolygonEdges::lonlat);
  } catch (const FileError& error) {
    EXPECT_TRUE(has_crossing_in_plane(shape.polygons) || shape.may_be_nothing) << error.what();
    return;
  }
  // Corners within rounding of a side become its corners, so lines may cross in what is told to be nothing.
  EXPECT_TRUE(!has_crossing_in_plane(shape.polygons) || !table->facts.remarks.empty())
      << "lines cross";
  double area = 0;
  for (const RingInPlane& ring : shape.plus) area += area_in_plane(ring);
  for (const RingInPlane& ring : shape.minus) area -= area_in_plane(ring);
  const double found = areas(table->cells)[0];
  EXPECT_NEAR(found, area, tolerance_of(shape, area));
  EXPECT_GE(found, 0);
  expect_pieces_of_cells(table->cells, seed);
}

// Each ring around its smaller side, holes less that.
std::vector<RingOfPoints> rings_of_arcs(const std::vector<PolygonInPlane>& polygons) {
  std::vector<RingOfPoints> rings;
  for (const PolygonInPlane& polygon : polygons) {
    for (std::size_t r = 0; r < polygon.size(); ++r) {
      RingOfPoints ring;
      for (const LonLat& p : polygon[r]) {
        const Point q = unit_vector(p);
        if (ring.empty() || !(ring.back() == q)) ring.push_back(q);
      }
      while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
      if (ring.size() < 3) continue;
      const RegionOracle alone({ring});
      const bool is_larger = alone.area(true).area > 2 * std::numbers::pi;
      if (is_larger != (r > 0)) std::ranges::reverse(ring);
      rings.push_back(std::move(ring));
    }
  }
  return rings;
}

void expect_arcs(const ShapeInPlane& shape, std::uint64_t seed) {
  SCOPED_TRACE("arcs");
  const std::vector<RingOfPoints> rings = rings_of_arcs(shape.polygons);
  const RegionOracle oracle(rings);
  constexpr double of_moves = 1e-45;
  const double rounding = 3e-14 * oracle.length();
  std::optional<CellTable> table;
  try {
    table = table_of(shape, PolygonEdges::geodesic);
  } catch (const FileError& error) {
    EXPECT_TRUE(oracle.excess() > of_moves || has_crossing(rings) ||
                std::string(error.what()).find("antipodes") != std::string::npos ||
                oracle.num_sides() == 0 || shape.may_be_nothing)
        << error.what();
    return;
  }
  if (oracle.excess() > rounding) {
    // Rings that go around nothing twice are refused by whoever lays them over something.
    EXPECT_THROW((void)remap(CellSet::polygons(table->cells), known_covers(0)[0].cells),
                 InvalidInput)
        << oracle.excess();
    return;
  }
  if (oracle.num_sides() > 0) {
    EXPECT_NEAR(areas(table->cells)[0], oracle.area(true).area, rounding + oracle.excess());
  }
  expect_pieces_of_cells(table->cells, seed);
}

class OverlayInsidePlane : public testing::TestWithParam<std::size_t> {};

TEST_P(OverlayInsidePlane, polygons_of_files_are_what_their_sides_say) {
  const std::size_t num_shapes = scaled(5);
  for (std::uint64_t seed = 0; seed < num_shapes; ++seed) {
    SCOPED_TRACE(std::string(kinds_in_plane.at(GetParam())) + ' ' + std::to_string(seed));
    const ShapeInPlane shape = PlaneShapes(64 * seed + GetParam())(GetParam());
    expect_lines(shape, seed);
    expect_arcs(shape, seed);
    constexpr int max_failures = 30;
    if (testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count() >
        max_failures)
      break;
  }
}

INSTANTIATE_TEST_SUITE_P(overlay, OverlayInsidePlane,
                         testing::Range(std::size_t{0}, kinds_in_plane.size()),
                         [](const auto& test) { return kinds_in_plane.at(test.param); });

}  // namespace
}  // namespace rondel::test
