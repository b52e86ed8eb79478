// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The promises of buffered(). Distances are computed in long double, by brute force over all sides;
// which places a buffer has is counted along an arc to a place that it has.
#include "rondel/buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
#include "rondel/set_operations.h"
#include "support/generators.h"
#include "support/thrown.h"

namespace rondel::test::of_buffers {
namespace {

using Line = std::vector<Point>;
using Long = exact::Vector3<long double>;

constexpr double pi = std::numbers::pi;

Long to_long(const Point& p) { return {p.x, p.y, p.z}; }

long double length(const Long& v) { return std::sqrt(exact::dot(v, v)); }

long double angle(const Long& a, const Long& b) {
  return 2 * std::atan2(length(a - b), length(a + b));
}

// The distance of a place from the shorter arc between two others.
long double distance_to_arc(const Point& place, const Point& from, const Point& to) {
  const Long p = to_long(place);
  const Long a = to_long(from);
  const Long b = to_long(to);
  const long double to_ends = std::min(angle(p, a), angle(p, b));
  const Long normal = exact::dot(a, b) > 0 ? exact::cross(a, b - a) : exact::cross(a, b + a);
  const long double size = length(normal);
  if (size == 0) return to_ends;
  // The foot of the perpendicular is within the arc.
  if (exact::dot(exact::cross(normal, a), p) < 0 || exact::dot(exact::cross(b, normal), p) < 0) {
    return to_ends;
  }
  const long double height = std::abs(exact::dot(normal, p)) / size;
  return std::min(to_ends, std::asin(std::min(1.0L, height / length(p))));
}

struct Feature {
  std::vector<Line> lines;
  std::vector<Line> rings;  // of a polygon
};

long double distance_to_border(const Point& place, const Feature& feature) {
  long double result = std::numeric_limits<long double>::infinity();
  const auto add = [&](const Line& line, bool is_closed) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      const bool is_last = k + 1 == line.size();
      if (is_last && !is_closed && line.size() > 1) break;
      result = std::min(result, distance_to_arc(place, line[k], line[is_last ? 0 : k + 1]));
    }
  };
  for (const Line& line : feature.lines) add(line, false);
  for (const Line& ring : feature.rings) add(ring, true);
  return result;
}

FeatureLines lines_of(const std::vector<Feature>& features) {
  FeatureLines lines;
  for (const Feature& feature : features) {
    for (const Line& line : feature.lines) lines.rows.append(line);
    lines.end_group();
  }
  return lines;
}

CellRings polygons_of(const std::vector<Feature>& features) {
  CellRings cells;
  for (const Feature& feature : features) {
    for (const Line& ring : feature.rings) {
      for (const Point& p : ring) {
        cells.corners.push_back(static_cast<Index>(cells.points.size()));
        cells.points.push_back(p);
      }
      cells.end_ring();
    }
    cells.end_cell();
  }
  return cells;
}

CellRings buffer_of(const Feature& feature, const BufferOptions& options) {
  return buffered(lines_of({feature}), polygons_of({feature}), options);
}

bool cross_inside(const Point& a, const Point& b, const Point& p, const Point& q) {
  const Sign first = orientation(a, b, p);
  return first != Sign::zero && orientation(a, b, q) == -first && orientation(p, q, a) == -first &&
         orientation(p, q, b) == first;
}

// True if an odd number of sides of a cell is between two places.
bool is_apart(const CellRings& cells, std::size_t cell, const Point& place, const Point& other) {
  bool result = false;
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    const auto ring = cells.corners_of(r);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      result ^= cross_inside(place, other, cells.points[ring[k]],
                             cells.points[ring[(k + 1) % ring.size()]]);
    }
  }
  return result;
}

double tolerance_of(const BufferOptions& options) {
  const double size = std::abs(options.distance);
  const double wanted = options.tolerance == 0 ? size / 1000 : options.tolerance;
  return std::min(std::max({wanted, 0x1p-48, 0x1p-30 * size}), size / 2);
}

class Places {
 public:
  explicit Places(std::uint64_t seed) : random_(seed) {}

  double number() { return std::uniform_real_distribution<>(-1, 1)(random_); }
  Point vector() { return {number(), number(), number()}; }
  Point anywhere() { return normalized(vector()); }
  Point near(const Point& p, double distance) { return normalized(p + distance * vector()); }
  // Returns a place at a distance in any direction.
  Point around(const Point& p, double distance) {
    const Point direction = normalized(cross(p, vector()));
    return normalized(std::cos(distance) * p + std::sin(distance) * direction);
  }
  std::size_t below(std::size_t count) { return random_() % count; }

 private:
  std::mt19937_64 random_;
};

// Expects that about 300 places of the border are at the distance from the feature.
void expect_border(const Feature& feature, const CellRings& result, double size, double tolerance,
                   Places& make) {
  for (std::uint64_t r = result.cells[0]; r < result.cells[1]; ++r) {
    const auto ring = result.corners_of(r);
    for (std::size_t k = 0; k < ring.size(); k += 1 + make.below(1 + ring.size() / 150)) {
      const Point& p = result.points[ring[k]];
      const Point& q = result.points[ring[(k + 1) % ring.size()]];
      for (const double part : {0.0, 0.2, 0.5}) {
        const Point place = normalized((1 - part) * p + part * q);
        const auto distance = static_cast<double>(distance_to_border(place, feature));
        ASSERT_NEAR(distance, size, tolerance) << r << ' ' << k << ' ' << part;
      }
    }
  }
}

// Expects that a buffer is valid, that its border is at the distance from the feature, and that it
// has the places that it should have. `inside` is a place of the polygon, if the feature has one.
void expect_buffer(const Feature& feature, const BufferOptions& options, const CellRings& result,
                   Places& make, const Point& inside = {}) {
  ASSERT_EQ(result.num_cells(), 1U);
  const CellRings polygons = polygons_of({feature});
  const double tolerance = tolerance_of(options);
  const double size = std::abs(options.distance);
  const bool is_whole = result.is_whole(0);
  const auto in_polygon = [&](const Point& p) {
    return !feature.rings.empty() && !is_apart(polygons, 0, p, inside);
  };
  // Negative if the place should not be in the buffer, positive if it should, in tolerances.
  const auto depth = [&](const Point& p) {
    const auto distance = static_cast<double>(distance_to_border(p, feature));
    const double outwards = in_polygon(p) ? -distance : distance;
    return (options.distance - outwards) / tolerance;
  };
  ASSERT_NO_FATAL_FAILURE(expect_border(feature, result, size, tolerance, make));
  // A place that is as deep in the buffer as any, or else far outside of it.
  std::vector<Point> places;
  for (int k = 0; k < 40; ++k) places.push_back(make.anywhere());
  std::vector<Point> corners = polygons.points;
  for (const Line& line : feature.lines) corners.insert(corners.end(), line.begin(), line.end());
  for (int k = 0; k < 150; ++k) {
    const Point& p = corners[make.below(corners.size())];
    places.push_back(make.near(p, 0.7 * size));
    places.push_back(make.around(p, size + 1.5 * tolerance * make.number()));
    places.push_back(make.around(p, size + 30 * tolerance * make.number()));
    if (result.points.empty()) continue;
    const Point& q = result.points[make.below(result.points.size())];
    places.push_back(make.around(q, 2.5 * tolerance * make.number()));
  }
  places.insert(places.end(), corners.begin(), corners.end());
  std::vector<double> depths;
  for (const Point& p : places) depths.push_back(depth(p));
  const auto deepest = static_cast<std::size_t>(std::ranges::max_element(depths) - depths.begin());
  const auto farthest = static_cast<std::size_t>(std::ranges::min_element(depths) - depths.begin());
  const std::size_t known = depths[deepest] > 1 ? deepest : farthest;
  ASSERT_GT(std::abs(depths[known]), 1);
  const bool is_known_inside = depths[known] > 1;
  if (result.cells[1] == 0) {
    for (const double d : depths) ASSERT_TRUE(is_whole ? d > -1.001 : d < 1.001) << d;
    return;
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (std::abs(depths[k]) <= 1.001) continue;
    const bool has = is_apart(result, 0, places[k], places[known]) != is_known_inside;
    ASSERT_EQ(has, depths[k] > 0) << "place " << k << ", depth " << depths[k];
  }
  const CellRings again = repaired(result);
  ASSERT_EQ(again.corners, result.corners);
  ASSERT_EQ(again.points, result.points);
}

constexpr std::array<double, 18> distances = {1e-12, 1e-9, 1e-6, 1e-3, 0.01, 0.1,
                                              0.3,   0.7,  1,    1.3,  1.5,  pi / 2,
                                              1.57,  1.58, 2,    2.8,  3.1,  3.14159};

Line random_line(Places& make, double size) {
  // Some lines have so many points that several unions of pieces are needed.
  const std::size_t count = 1 + make.below(make.below(4) == 0 ? 150 : 12);
  const Point middle = make.anywhere();
  Line line = {make.near(middle, size)};
  const std::size_t smoothness = make.below(3);
  while (line.size() < count) {
    if (smoothness == 0 && line.size() > 2) {  // on, with a small turn
      const Point way = line.back() - line[line.size() - 2];
      line.push_back(make.near(normalized(line.back() + way), 0.1 * norm(way)));
      continue;
    }
    switch (make.below(8)) {
      case 0:
        line.push_back(Point(line.back()));
        break;
      case 1:  // back
        line.push_back(Point(line[make.below(line.size())]));
        break;
      case 2:  // nearly straight on, and hardly
        line.push_back(make.near(line.back(), 1e-3 * size));
        break;
      case 3:
        line.push_back(make.near(line.back(), 1e-15));
        break;
      case 4:  // nearly half around the sphere
        line.push_back(make.near(-1.0 * line.back(), std::pow(10, 4 * make.number() - 5)));
        break;
      default:
        line.push_back(make.near(middle, size));
    }
    if (norm(line.back() + line[line.size() - 2]) < 1e-9) line.pop_back();
  }
  return line;
}

TEST(buffered, has_the_places_near_lines) {
  const std::size_t count = scaled(80);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Places make(seed);
    BufferOptions options = {distances[make.below(distances.size())], 0};
    if (seed % 3 > 0)
      options.tolerance = std::pow(10, -2.2 + 1.8 * make.number()) * options.distance;
    const std::array<double, 4> sizes = {2, 0.3, 2 * options.distance, 0.1 * options.distance};
    Feature feature;
    for (std::size_t k = 0; k <= make.below(3); ++k) {
      feature.lines.push_back(random_line(make, sizes[seed / 3 % 4]));
    }
    const CellRings result = buffer_of(feature, options);
    ASSERT_NO_FATAL_FAILURE(expect_buffer(feature, options, result, make));
  }
}

// A ring around a place, with corners at any distances, counterclockwise.
Line star(Places& make, const Point& middle, double size, double roughness) {
  const Point right = normalized(cross(middle, Point{1, 2, 3}));
  const Point up = cross(middle, right);
  const std::size_t count = 3 + make.below(make.below(4) == 0 ? 150 : 12);
  Line ring;
  double shift = roughness * make.number();
  const bool is_smooth = make.below(2) == 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(count);
    shift = is_smooth ? std::clamp(shift + 0.01 * make.number(), -roughness, roughness)
                      : roughness * make.number();
    const double radius = size * (1 + shift);
    ring.push_back(normalized(std::cos(radius) * middle +
                              std::sin(radius) * (std::cos(angle) * right + std::sin(angle) * up)));
  }
  return ring;
}

// Divides a ring's corners in two, nearer to each other than buffers tell apart.
Line doubled(Places& make, const Line& ring, double distance) {
  Line result;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point& p = ring[k];
    const Point side = ring[(k + 1) % ring.size()] - p;
    const Point ahead = std::min(0.1 * norm(side), distance) * normalized(side);
    result.push_back(p);
    result.push_back(normalized(p + ahead + 0.3 * make.number() * cross(p, ahead)));
  }
  return result;
}

TEST(buffered, grows_and_shrinks_polygons) {
  const std::size_t count = scaled(200);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Places make(seed);
    BufferOptions options = {distances[make.below(distances.size())], 0};
    if (seed % 3 > 0)
      options.tolerance = std::pow(10, -2.2 + 1.8 * make.number()) * options.distance;
    if (seed % 2 == 0) options.distance = -options.distance;
    const std::array<double, 4> sizes = {1.2, 0.3, 3 * std::abs(options.distance),
                                         std::abs(options.distance)};
    const double size = std::min(1.2, sizes[seed / 2 % 4]);
    const Point middle = make.anywhere();
    Feature feature = {{}, {star(make, middle, size, 0.5)}};
    Point inside = middle;
    if (seed % 5 == 0) {  // a hole, and an island
      feature.rings.push_back(star(make, middle, 0.3 * size, 0.1));
      std::ranges::reverse(feature.rings.back());
      feature.rings.push_back(star(make, middle, 0.1 * size, 0.5));
    }
    if (seed % 4 == 0 && seed % 7 != 0) {  // rings may cross themselves then
      for (Line& ring : feature.rings) ring = doubled(make, ring, 0.01 * tolerance_of(options));
    }
    if (seed % 7 == 0) {  // what is outside of it
      for (Line& ring : feature.rings) std::ranges::reverse(ring);
      inside = -1.0 * middle;
    }
    const CellRings result = buffer_of(feature, options);
    ASSERT_NO_FATAL_FAILURE(expect_buffer(feature, options, result, make, inside));
  }
}

TEST(buffered, of_a_point_is_a_disk) {
  for (const double distance : distances) {
    if (distance > 3.14) continue;  // it is the whole sphere
    for (const Point& center :
         {Point{0, 0, 1}, Point{0, 0, -1}, Point{-1, 0, 0}, normalized(Point{1, -2, 3})}) {
      const CellRings disk = buffered(std::span(&center, 1), {distance});
      const double half = std::sin(distance / 2);
      EXPECT_NEAR(areas(disk)[0] / (4 * pi * half * half), 1, 2e-3 + 8e-15 / distance) << distance;
      EXPECT_EQ(disk.rings.size(), 2U);
      EXPECT_LE(disk.corners.size(), 52U);
    }
  }
}

TEST(buffered, knows_the_whole_sphere_and_nothing) {
  const Feature point = {{{{0, 0, 1}}}, {}};
  const Feature nothing = {};
  const std::vector<Feature> both = {point, nothing};
  for (const double distance : {pi, 4.0, 1e300}) {
    const CellRings result = buffered(lines_of(both), {}, {distance});
    EXPECT_EQ(result.whole, (std::vector<Index>{0}));
    EXPECT_EQ(result.num_cells(), 2U);
    EXPECT_TRUE(result.corners.empty());
  }
  for (const double distance : {0.0, -0.1, 1e-14, -4.0}) {
    const CellRings result = buffered(lines_of(both), {}, {distance});
    EXPECT_EQ(result.num_cells(), 2U);
    EXPECT_TRUE(result.whole.empty() && result.corners.empty());
  }
  // Six places that leave nothing out, at distances that hardly do.
  const Feature axes = {
      {{{1, 0, 0}}, {{-1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}}, {}};
  const double reach = std::acos(1 / std::sqrt(3.0));
  EXPECT_TRUE(buffer_of(axes, {1.002 * reach}).is_whole(0));
  EXPECT_EQ(buffer_of(axes, {0.998 * reach}).rings.size() - 1, 8U);
  EXPECT_TRUE(buffer_of(axes, {pi / 2}).is_whole(0));
  EXPECT_TRUE(buffer_of(axes, {3}).is_whole(0));
  // A polygon that is the whole sphere has no border.
  CellRings all;
  all.whole = {0};
  all.end_cell();
  for (const double distance : {1.0, -1.0, -10.0}) {
    EXPECT_TRUE(buffered(all, {distance}).is_whole(0));
  }
}

TEST(buffered, closes_holes_and_opens_necks) {
  const auto at = [](double x, double y) { return normalized(Point{1, 0.1 * x, 0.1 * y}); };
  // A frame, and two squares with a neck between them.
  const Feature frame = {
      {}, {{at(0, 0), at(4, 0), at(4, 4), at(0, 4)}, {at(1, 1), at(1, 3), at(3, 3), at(3, 1)}}};
  EXPECT_EQ(buffer_of(frame, {0.05}).rings.size() - 1, 2U);
  EXPECT_EQ(buffer_of(frame, {0.11}).rings.size() - 1, 1U);
  const Feature squares = {{},
                           {{at(0, 0), at(2, 0), at(2, 0.9), at(4, 0.9), at(4, 0), at(6, 0),
                             at(6, 2), at(4, 2), at(4, 1.1), at(2, 1.1), at(2, 2), at(0, 2)}}};
  EXPECT_EQ(buffer_of(squares, {-0.005}).rings.size() - 1, 1U);
  EXPECT_EQ(buffer_of(squares, {-0.02}).rings.size() - 1, 2U);
  EXPECT_EQ(buffer_of(squares, {-0.2}).rings.size() - 1, 0U);
}

// True if all of A is in B.
bool covers(const CellRings& b, const CellRings& a) {
  const CellRings rest = combine(a, b, SetOperation::difference);
  return rest.corners.empty() && rest.whole.empty();
}

TEST(buffered, adds_distances) {
  const std::size_t count = scaled(40);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Places make(seed);
    const CellRings polygon = polygons_of({{{}, {star(make, make.anywhere(), 0.3, 0.5)}}});
    const double t = 1e-3;
    const CellRings twice = buffered(buffered(polygon, {0.05, t}), {0.07, t});
    EXPECT_TRUE(covers(buffered(polygon, {0.12 + 4 * t, t}), twice));
    EXPECT_TRUE(covers(twice, buffered(polygon, {0.12 - 4 * t, t})));
    // Opening takes away, closing adds.
    const CellRings opened = buffered(buffered(polygon, {-0.05, t}), {0.05 - 2 * t, t});
    EXPECT_TRUE(covers(polygon, opened));
    const CellRings closed = buffered(buffered(polygon, {0.05, t}), {-0.05 + 2 * t, t});
    EXPECT_TRUE(covers(closed, polygon));
  }
}

TEST(buffered, of_smooth_borders_adds_few_corners) {
  const Point center = normalized(Point{1, 2, 3});
  CellRings disk = buffered(std::span(&center, 1), {0.1});
  for (int step = 0; step < 5; ++step) {
    disk = buffered(disk, {0.02});
    EXPECT_LE(disk.corners.size(), 110U);
  }
  EXPECT_NEAR(areas(disk)[0] / (2 * pi * (1 - std::cos(0.2))), 1, 1e-2);
}

TEST(buffered, keeps_features_apart) {
  Places make(1);
  std::vector<Feature> features;
  for (int k = 0; k < 30; ++k) {
    Feature& feature = features.emplace_back();
    if (k % 4 == 0) continue;
    if (k % 2 == 0) feature.lines.push_back(random_line(make, 0.5));
    if (k % 3 == 0) feature.rings.push_back(star(make, make.anywhere(), 0.3, 0.4));
  }
  const BufferOptions options = {0.2, 1e-3};
  const CellRings all = buffered(lines_of(features), polygons_of(features), options);
  const CellRings same = buffered(lines_of(features), polygons_of(features), options, {3});
  EXPECT_EQ(all.corners, same.corners);
  EXPECT_EQ(all.points, same.points);
  ASSERT_EQ(all.num_cells(), features.size());
  for (std::size_t f = 0; f < features.size(); ++f) {
    const CellRings one = buffer_of(features[f], options);
    EXPECT_EQ(areas(one)[0], areas(all)[f]);
  }
}

TEST(buffered, follows_long_borders) {
  // A spiral with many sides, whose turns are nearer to each other than the distance.
  Line line;
  for (int k = 0; k < 500; ++k) {
    const double turn = 0.12 * k;
    const double height = std::cos(0.0018 * k);
    const double radius = std::sqrt(1 - height * height);
    line.push_back(normalized({radius * std::cos(turn), radius * std::sin(turn), height}));
  }
  Places make(1);
  const Feature feature = {{line}, {}};
  const BufferOptions options = {0.04, 1e-3};
  const CellRings result = buffer_of(feature, options);
  EXPECT_EQ(result.rings.size() - 1, 1U);
  ASSERT_NO_FATAL_FAILURE(expect_buffer(feature, options, result, make));
}

TEST(buffered, leaves_no_gaps_between_its_parts) {
  // Gaps of an ulp between unions of pieces would be rings of few corners near to the border.
  const std::size_t count = scaled(20);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Places make(seed);
    Feature feature = {{}, {{}}};
    Line& ring = feature.rings[0];
    const Point middle = make.anywhere();
    const Point right = normalized(cross(middle, Point{1, 2, 3}));
    const Point up = cross(middle, right);
    Line coarse;
    for (int k = 0; k < 100; ++k) {
      const double turn = 2 * pi * k / 100;
      const double radius = 0.1 + 0.03 * make.number();
      coarse.push_back(
          normalized(middle + radius * (std::cos(turn) * right + std::sin(turn) * up)));
    }
    // Sides that bend a little, as parallels do in files.
    for (std::size_t k = 0; k < coarse.size(); ++k) {
      const Point side = coarse[(k + 1) % coarse.size()] - coarse[k];
      const Point bend = (k % 2 == 0 ? 0.01 : -0.01) * cross(middle, side);
      for (int i = 0; i < 10; ++i) {
        const double part = 0.1 * i;
        ring.push_back(normalized(coarse[k] + part * side + part * (1 - part) * bend));
      }
    }
    for (const double distance : {0.005, 0.02, 0.06, -0.01}) {
      const CellRings result = buffer_of(feature, {distance});
      for (std::uint64_t r = result.cells[0]; r < result.cells[1]; ++r) {
        const auto corners = result.corners_of(r);
        if (corners.size() > 8) continue;
        for (const Index p : corners) {
          ASSERT_NEAR(static_cast<double>(distance_to_border(result.points[p], feature)),
                      std::abs(distance), 1e-3 * std::abs(distance));
        }
      }
    }
  }
}

TEST(buffered, refuses_what_is_no_feature) {
  const Point center = {0, 0, 1};
  const auto of_line = [](const Line& line, const BufferOptions& options) {
    return thrown_index([&] { return buffer_of({{{{0, 0, 1}}, line}, {}}, options); });
  };
  EXPECT_EQ(of_line({{0, 0, 2}}, {0.1}), 0U);
  EXPECT_EQ(of_line({center, {0, 0, -1}}, {0.1}), 0U);
  EXPECT_EQ(of_line({center}, {std::nan("")}), InvalidInput::no_index);
  EXPECT_EQ(of_line({center}, {0.1, -1}), InvalidInput::no_index);
  EXPECT_EQ(of_line({center}, {0.1, std::nan("")}), InvalidInput::no_index);
  CellRings two;
  two.end_cell();
  two.end_cell();
  EXPECT_EQ(thrown_index([&] { return buffered(lines_of({{}}), two, {0.1}); }),
            InvalidInput::no_index);
  FeatureLines lines = lines_of({{{{center}}, {}}});
  lines.rows.offsets.back() = 7;
  EXPECT_EQ(thrown_index([&] { return buffered(lines, {}, {0.1}); }), InvalidInput::no_index);
  const std::atomic<bool> stop = true;
  const Execution execution{.threads = 1, .stop = &stop};
  EXPECT_THROW(buffered(std::span(&center, 1), {0.1}, execution), Interrupted);
}

}  // namespace
}  // namespace rondel::test::of_buffers
