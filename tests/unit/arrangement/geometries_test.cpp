// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The promises of the set operations on points, lines and polygons. Between the 26 directions whose
// coordinates are -1, 0 or 1, which places a result has is known in rational numbers: each node and
// each edge of the exact arrangement is asked by itself. Others are held to laws.
#include "rondel/geometries.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "rondel/arrangement.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "support/generators.h"
#include "support/thrown.h"
#include "unit/arrangement/arc_sets.h"
#include "unit/arrangement/set_rule.h"

namespace rondel::test::of_geometries {
namespace {

constexpr std::array<SetOperation, 5> operations = {
    SetOperation::unite, SetOperation::intersection, SetOperation::difference,
    SetOperation::symmetric_difference, SetOperation::identity};

using Exact = std::array<mpz_class, 3>;
using Ray = std::array<long, 3>;  // without a common factor

Exact exact(const Ray& ray) { return {ray[0], ray[1], ray[2]}; }

Exact cross_of(const Exact& a, const Exact& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpz_class dot_of(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
int side(const Exact& a, const Exact& b, const Exact& p) { return sgn(dot_of(cross_of(a, b), p)); }

// True if a place is on an arc or at its ends.
bool is_on(const Exact& p, const Exact& a, const Exact& b) {
  const Exact normal = cross_of(a, b);
  if (side(a, b, p) != 0) return false;
  return sgn(dot_of(cross_of(a, p), normal)) >= 0 && sgn(dot_of(cross_of(p, b), normal)) >= 0 &&
         (sgn(dot_of(a, p)) > 0 || sgn(dot_of(b, p)) > 0 ||
          sgn(dot_of(cross_of(a, p), normal)) > 0);
}
bool is_same(const Exact& p, const Exact& q) {
  const Exact normal = cross_of(p, q);
  return sgn(normal[0]) == 0 && sgn(normal[1]) == 0 && sgn(normal[2]) == 0 && sgn(dot_of(p, q)) > 0;
}

// Points, arcs and triangles, of which the interior is to the left of all sides.
struct ExactGeometry {
  std::vector<Ray> points;
  std::vector<std::vector<Ray>> lines;
  std::vector<std::array<Ray, 3>> triangles;

  [[nodiscard]] std::vector<std::array<Ray, 2>> arcs() const {
    std::vector<std::array<Ray, 2>> all;
    for (const auto& line : lines) {
      for (std::size_t k = 0; k + 1 < line.size(); ++k) all.push_back({line[k], line[k + 1]});
    }
    for (const auto& [a, b, c] : triangles) all.insert(all.end(), {{a, b}, {b, c}, {c, a}});
    return all;
  }
  // True if a triangle has the place; `is_closed` says whether sides belong to it.
  [[nodiscard]] bool has_area_at(const Exact& p, bool is_closed) const {
    return std::ranges::any_of(triangles, [&](const std::array<Ray, 3>& corners) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int s = side(exact(corners[k]), exact(corners[(k + 1) % 3]), p);
        if (s < 0 || (s == 0 && !is_closed)) return false;
      }
      return true;
    });
  }
  [[nodiscard]] bool has(const Exact& p) const {
    if (has_area_at(p, true)) return true;
    if (std::ranges::any_of(points, [&](const Ray& q) { return is_same(p, exact(q)); }))
      return true;
    return std::ranges::any_of(lines, [&](const std::vector<Ray>& line) {
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        if (is_on(p, exact(line[k]), exact(line[k + 1]))) return true;
      }
      return false;
    });
  }
};

Ray reduced(const Exact& from) {
  Ray ray = {from[0].get_si(), from[1].get_si(), from[2].get_si()};
  long factor = 0;
  for (const long x : ray) factor = std::gcd(factor, std::abs(x));
  for (long& x : ray) x /= factor;
  return ray;
}

Point point_of(const Ray& ray) {
  return normalized(
      Point{static_cast<double>(ray[0]), static_cast<double>(ray[1]), static_cast<double>(ray[2])});
}

// The nodes and edges of the exact arrangement of two geometries.
struct ExactArrangement {
  std::set<Ray> nodes;
  std::set<std::pair<Ray, Ray>> edges;

  ExactArrangement(const ExactGeometry& first, const ExactGeometry& second) {
    std::vector<std::array<Ray, 2>> arcs = first.arcs();
    const auto more = second.arcs();
    arcs.insert(arcs.end(), more.begin(), more.end());
    for (const ExactGeometry* geometry : {&first, &second}) {
      nodes.insert(geometry->points.begin(), geometry->points.end());
    }
    for (const auto& [a, b] : arcs) {
      nodes.insert({a, b});
      for (const auto& [c, d] : arcs) {
        Exact line = cross_of(cross_of(exact(a), exact(b)), cross_of(exact(c), exact(d)));
        if (sgn(line[0]) == 0 && sgn(line[1]) == 0 && sgn(line[2]) == 0) continue;
        for (int k = 0; k < 2; ++k) {
          if (is_on(line, exact(a), exact(b)) && is_on(line, exact(c), exact(d))) {
            nodes.insert(reduced(line));
          }
          for (mpz_class& x : line) x = -x;
        }
      }
    }
    for (const auto& [a, b] : arcs) {
      std::vector<Ray> chain;
      for (const Ray& node : nodes) {
        if (is_on(exact(node), exact(a), exact(b))) chain.push_back(node);
      }
      const Exact normal = cross_of(exact(a), exact(b));
      std::ranges::sort(chain, [&](const Ray& p, const Ray& q) {
        return sgn(dot_of(cross_of(exact(p), exact(q)), normal)) > 0;
      });
      for (std::size_t k = 1; k < chain.size(); ++k) {
        edges.insert(std::minmax(chain[k - 1], chain[k]));
      }
    }
  }
};

// The lines and points that a result has.
struct ExactLines {
  std::set<std::pair<Ray, Ray>> edges;
  std::set<Ray> points;
};

ExactLines expected_lines(const ExactGeometry& first, const ExactGeometry& second,
                          SetOperation operation) {
  const ExactArrangement arranged(first, second);
  const auto is_wanted = [&](const Exact& p) {
    return result_of(operation, first.has(p), second.has(p));
  };
  const auto is_area = [&](const Exact& p) {
    return result_of(operation, first.has_area_at(p, false), second.has_area_at(p, false));
  };
  ExactLines result;
  std::set<Ray> covered;
  for (const auto& [a, b] : arranged.edges) {
    const Exact p = exact(a);
    const Exact q = exact(b);
    const Exact middle = {p[0] + q[0], p[1] + q[1], p[2] + q[2]};
    const Exact normal = cross_of(p, q);
    bool is_beside = false;
    for (const int sign : {1, -1}) {
      Exact place = middle;
      for (std::size_t k = 0; k < 3; ++k) place[k] = middle[k] * 1'000'000 + normal[k] * sign;
      is_beside = is_beside || is_area(place);
    }
    if (!is_beside && is_wanted(middle)) result.edges.insert({a, b});
    if (is_beside || is_wanted(middle)) covered.insert({a, b});
  }
  for (const Ray& node : arranged.nodes) {
    const bool is_inside = is_area(exact(node));
    if (is_wanted(exact(node)) && !covered.contains(node) && !is_inside) result.points.insert(node);
  }
  return result;
}

// Appends a geometry; further triangles, which may overlap the first one, are further geometries.
void append(const ExactGeometry& geometry, Geometries& all) {
  for (const auto& line : geometry.lines) {
    std::vector<Point> points;
    for (const Ray& ray : line) points.push_back(point_of(ray));
    all.lines.rows.append(points);
  }
  for (const Ray& ray : geometry.points) {
    const Point p = point_of(ray);
    all.lines.rows.append(std::span(&p, 1));
  }
  for (std::size_t t = 0; t < std::max<std::size_t>(1, geometry.triangles.size()); ++t) {
    all.lines.end_group();
    if (t < geometry.triangles.size()) {
      for (const Ray& ray : geometry.triangles[t]) {
        all.polygons.corners.push_back(static_cast<Index>(all.polygons.points.size()));
        all.polygons.points.push_back(point_of(ray));
      }
      all.polygons.end_ring();
    }
    all.polygons.end_cell();
  }
}

Geometries geometries_of(const std::vector<ExactGeometry>& all) {
  Geometries result;
  for (const ExactGeometry& geometry : all) append(geometry, result);
  return result;
}

// Returns the edges and points of the first geometry; a node is known by its exact place.
ExactLines lines_of(const Geometries& geometries, std::size_t g, const ExactArrangement& arranged) {
  const auto ray_at = [&](const Point& p) {
    constexpr double near = 1e-13;
    for (const Ray& ray : arranged.nodes) {
      if (norm(point_of(ray) - p) < near) return ray;
    }
    return Ray{0, 0, 0};
  };
  ExactLines result;
  for (std::uint64_t i = geometries.lines.offsets[g]; i < geometries.lines.offsets[g + 1]; ++i) {
    const auto line = geometries.lines.rows[i];
    if (line.size() == 1) {
      EXPECT_TRUE(result.points.insert(ray_at(line[0])).second);
    }
    for (std::size_t k = 1; k < line.size(); ++k) {
      EXPECT_TRUE(result.edges.insert(std::minmax(ray_at(line[k - 1]), ray_at(line[k]))).second);
    }
  }
  return result;
}

// Checks that lines end where one edge or more than two edges meet, and nowhere else.
void expect_merged(const FeatureLines& lines, std::size_t g) {
  using Key = std::array<double, 3>;
  std::map<Key, int> degrees;
  const auto key = [](const Point& p) { return Key{p.x, p.y, p.z}; };
  const auto is_loop = [&](std::span<const Point> line) { return line.front() == line.back(); };
  for (std::uint64_t i = lines.offsets[g]; i < lines.offsets[g + 1]; ++i) {
    const auto line = lines.rows[i];
    for (std::size_t k = 1; k < line.size(); ++k) {
      ++degrees[key(line[k - 1])];
      ++degrees[key(line[k])];
    }
  }
  for (std::uint64_t i = lines.offsets[g]; i < lines.offsets[g + 1]; ++i) {
    const auto line = lines.rows[i];
    if (line.size() == 1) continue;
    for (std::size_t k = 1; k + 1 < line.size(); ++k) ASSERT_EQ(degrees[key(line[k])], 2);
    if (!is_loop(line)) {
      ASSERT_NE(degrees[key(line.front())], 2);
      ASSERT_NE(degrees[key(line.back())], 2);
    }
  }
}

bool is_equal(const Geometries& a, const Geometries& b) {
  return a.lines == b.lines && a.polygons.cells == b.polygons.cells &&
         a.polygons.rings == b.polygons.rings && a.polygons.corners == b.polygons.corners &&
         a.polygons.points == b.polygons.points && a.polygons.whole == b.polygons.whole;
}

class ExactGeometries : public testing::Test {
 protected:
  ExactGeometries() {
    for (long x = -1; x <= 1; ++x) {
      for (long y = -1; y <= 1; ++y) {
        for (long z = -1; z <= 1; ++z) {
          if (x != 0 || y != 0 || z != 0) rays_.push_back({x, y, z});
        }
      }
    }
  }

  Ray ray() { return rays_[random_() % rays_.size()]; }
  // Returns a ray that is neither the same nor opposite.
  Ray ray_beside(const Ray& other) {
    for (;;) {
      const Ray found = ray();
      const Exact normal = cross_of(exact(found), exact(other));
      if (sgn(normal[0]) != 0 || sgn(normal[1]) != 0 || sgn(normal[2]) != 0) return found;
    }
  }
  std::array<Ray, 3> triangle() {
    for (;;) {
      const std::array<Ray, 3> found = {ray(), ray(), ray()};
      if (side(exact(found[0]), exact(found[1]), exact(found[2])) > 0) return found;
    }
  }
  ExactGeometry geometry(std::size_t max_triangles) {
    ExactGeometry made;
    for (std::size_t k = random_() % 3; k > 0; --k) made.points.push_back(ray());
    for (std::size_t k = random_() % 3; k > 0; --k) {
      std::vector<Ray> line = {ray()};
      for (std::size_t i = 1 + random_() % 3; i > 0; --i) line.push_back(ray_beside(line.back()));
      made.lines.push_back(std::move(line));
    }
    for (std::size_t k = random_() % (max_triangles + 1); k > 0; --k)
      made.triangles.push_back(triangle());
    return made;
  }

  std::mt19937_64 random_{5};
  std::vector<Ray> rays_;
};

TEST_F(ExactGeometries, results_have_the_exact_edges_and_points) {
  const std::size_t count = scaled(2'000);
  for (std::size_t trial = 0; trial < count; ++trial) {
    const ExactGeometry a = geometry(2);
    const ExactGeometry b = geometry(2);
    const Geometries first = geometries_of({a});
    const Geometries second = geometries_of({b});
    const ExactArrangement arranged(a, b);
    for (const SetOperation operation : operations) {
      const Geometries result = combine(first, second, operation, {1});
      ASSERT_EQ(result.size(), 1U);
      const ExactLines expected = expected_lines(a, b, operation);
      const ExactLines found = lines_of(result, 0, arranged);
      ASSERT_EQ(found.edges, expected.edges) << trial << ' ' << name_of(operation);
      ASSERT_EQ(found.points, expected.points) << trial << ' ' << name_of(operation);
      expect_merged(result.lines, 0);
      const CellRings alone = combine(first.polygons, second.polygons, operation, {1});
      ASSERT_NEAR(areas(result.polygons)[0], areas(alone)[0], 1e-12);
      const std::array<Index, 2> pair = {0, 0};
      if (first.size() == 1 && second.size() == 1) {
        ASSERT_TRUE(is_equal(combine_pairs(first, second, {&pair, 1}, operation, {1}), result));
      }
      // A result is its own union.
      ASSERT_TRUE(is_equal(unite(result, {1}), result)) << trial;
    }
  }
}

TEST_F(ExactGeometries, pieces_are_those_of_pairs) {
  const std::size_t count = scaled(400);
  for (std::size_t trial = 0; trial < count; ++trial) {
    const std::vector<ExactGeometry> a = {geometry(1), geometry(1)};
    const std::vector<ExactGeometry> b = {geometry(1), geometry(1)};
    const GeometryPieces made =
        overlay_pieces(geometries_of(a), geometries_of(b), SetOperation::identity, {1});
    std::map<std::pair<Index, Index>, std::size_t> places;
    for (std::size_t k = 0; k < made.first.size(); ++k) {
      places[{made.first[k], made.second[k]}] = k;
      ASSERT_NO_FATAL_FAILURE(expect_merged(made.pieces.lines, k));
    }
    // Nodes of pieces are those of all geometries, so lengths are compared.
    const std::vector<double> sizes = lengths(made.pieces.lines);
    for (Index i = 0; i < 2; ++i) {
      for (Index k = 0; k < 2; ++k) {
        const Geometries pair =
            combine(geometries_of({a[i]}), geometries_of({b[k]}), SetOperation::intersection, {1});
        const auto place = places.find({i, k});
        const double length = place == places.end() ? 0 : sizes[place->second];
        ASSERT_NEAR(length, lengths(pair.lines)[0], 1e-12) << trial;
      }
      const Geometries rest =
          combine(geometries_of({a[i]}), geometries_of(b), SetOperation::difference, {1});
      const auto place = places.find({i, no_index});
      ASSERT_NEAR(place == places.end() ? 0 : sizes[place->second], lengths(rest.lines)[0], 1e-12);
    }
  }
}

TEST_F(ExactGeometries, polygons_alone_keep_their_bits) {
  const std::size_t count = scaled(500);
  for (std::size_t trial = 0; trial < count; ++trial) {
    ExactGeometry a = geometry(2);
    ExactGeometry b = geometry(2);
    for (ExactGeometry* one : {&a, &b}) {
      one->points.clear();
      one->lines.clear();
    }
    const Geometries first = geometries_of({a});
    const Geometries second = geometries_of({b});
    for (const SetOperation operation : operations) {
      const Geometries result = combine(first, second, operation, {1});
      const CellRings cells = combine(first.polygons, second.polygons, operation, {1});
      ASSERT_EQ(result.polygons.points, cells.points);
      ASSERT_EQ(result.polygons.corners, cells.corners);
      if (operation != SetOperation::intersection) {
        ASSERT_EQ(result.lines.rows.size(), 0U);
      }
    }
  }
}

// Lines of hostile arcs, three to a line.
Geometries lines_of(const ArcSet& set, std::size_t begin, std::size_t end) {
  Geometries made;
  for (std::size_t k = begin; k < end; ++k) {
    const auto [a, b] = set.arcs[k];
    const std::array<Point, 2> arc = {set.points[a], set.points[b]};
    made.lines.rows.append(arc);
    if (k % 3 == 2) {
      made.lines.end_group();
      made.polygons.end_cell();
    }
  }
  made.lines.end_group();
  made.polygons.end_cell();
  return made;
}

double length_of(const Geometries& geometries) {
  const std::vector<double> all = lengths(geometries.lines);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

TEST(geometries, lines_of_hostile_arcs_keep_the_laws) {
  for (const std::string& kind : kinds_of_arc_sets()) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      SCOPED_TRACE(kind);
      const ArcSet set = arc_set(kind, 40, seed);
      const Geometries a = lines_of(set, 0, set.arcs.size() / 2);
      const Geometries b = lines_of(set, set.arcs.size() / 2, set.arcs.size());
      const auto of = [&](SetOperation operation) { return combine(a, b, operation, {1}); };
      const Geometries both = of(SetOperation::intersection);
      const Geometries rest = of(SetOperation::difference);
      const Geometries all = of(SetOperation::unite);
      const double scale = 1 + length_of(a) + length_of(b);
      ASSERT_NEAR(length_of(both) + length_of(rest), length_of(of(SetOperation::identity)),
                  1e-14 * scale);
      ASSERT_NEAR(length_of(both) + length_of(of(SetOperation::symmetric_difference)),
                  length_of(all), 1e-14 * scale);
      ASSERT_TRUE(is_equal(unite(all, {1}), all));
      ASSERT_TRUE(is_equal(combine(a, b, SetOperation::unite, {4}), all));
      ASSERT_NO_FATAL_FAILURE(expect_merged(all.lines, 0));
      // No two edges of a result cross, after rounding.
      std::vector<Point> points;
      std::vector<std::array<Index, 2>> arcs;
      for (std::size_t i = 0; i < all.lines.rows.size(); ++i) {
        const auto line = all.lines.rows[i];
        for (std::size_t k = 0; k < line.size(); ++k) {
          const auto at = static_cast<Index>(points.size());
          points.push_back(line[k]);
          if (k > 0) arcs.push_back({at - 1, at});
        }
      }
      const Arrangement arranged = arrange(points, arcs, {1});
      ASSERT_EQ(arranged.edges.size(), arcs.size());
    }
  }
}

Geometries line_between(std::vector<Point> points) {
  Geometries made;
  made.lines.rows.append(points);
  made.lines.end_group();
  made.polygons.end_cell();
  return made;
}

Geometries cap(double lat_deg) {
  Geometries made;
  made.lines.end_group();
  for (Index k = 0; k < 4; ++k) {
    made.polygons.points.push_back(unit_vector_deg(90.0 * k, lat_deg));
    made.polygons.corners.push_back(k);
  }
  made.polygons.end_ring();
  made.polygons.end_cell();
  return made;
}

TEST(geometries, a_line_over_the_pole_is_cut_by_a_cap) {
  const Geometries line =
      line_between({unit_vector_deg(180, 10), unit_vector_deg(180, 80), unit_vector_deg(0, 10)});
  const Geometries inside = combine(line, cap(60), SetOperation::intersection, {1});
  ASSERT_EQ(inside.lines.rows.size(), 1U);
  EXPECT_NEAR(length_of(inside), std::numbers::pi / 3, 1e-15);
  // It keeps its direction.
  EXPECT_EQ(inside.lines.rows[0].front(), unit_vector_deg(180, 60));
  EXPECT_EQ(inside.lines.rows[0].back(), unit_vector_deg(0, 60));
  const Geometries outside = combine(line, cap(60), SetOperation::difference, {1});
  EXPECT_EQ(outside.lines.rows.size(), 2U);
  EXPECT_NEAR(length_of(inside) + length_of(outside), length_of(line), 1e-15);
}

TEST(geometries, points_are_found_in_faces_on_sides_and_in_corners) {
  Geometries points;
  for (const Point& p : {unit_vector_deg(30, 85), unit_vector_deg(90, 60), unit_vector_deg(0, -90),
                         unit_vector_deg(10, 10), unit_vector_deg(0, 90)}) {
    points.lines.rows.append(std::span(&p, 1));
    points.lines.end_group();
    points.polygons.end_cell();
  }
  const GeometryPieces pieces = overlay_pieces(points, cap(60), SetOperation::identity, {1});
  EXPECT_EQ(pieces.first, (std::vector<Index>{0, 1, 2, 3, 4}));
  EXPECT_EQ(pieces.second, (std::vector<Index>{0, 0, no_index, no_index, 0}));
  Geometries sphere;
  sphere.lines.end_group();
  sphere.polygons.end_cell();
  sphere.polygons.whole = {0};
  EXPECT_EQ(combine(points, sphere, SetOperation::intersection, {1}).lines.rows.size(), 5U);
  EXPECT_EQ(combine(points, sphere, SetOperation::difference, {1}).lines.rows.size(), 0U);
  EXPECT_EQ(combine(points, sphere, SetOperation::unite, {1}).lines.rows.size(), 0U);
}

TEST(geometries, a_closed_line_is_closed_again) {
  std::vector<Point> ring;
  for (int k = 0; k <= 4; ++k) ring.push_back(unit_vector_deg(90.0 * (k % 4), 70));
  const Geometries line = line_between(ring);
  const Geometries inside = combine(line, cap(60), SetOperation::intersection, {1});
  ASSERT_EQ(inside.lines.rows.size(), 1U);
  EXPECT_EQ(inside.lines.rows[0].size(), 5U);
  EXPECT_EQ(inside.lines.rows[0].front(), inside.lines.rows[0].back());
}

TEST(geometries, lengths_of_many_arcs_do_not_drift) {
  Geometries meridians;
  for (int lon = 0; lon < 360; ++lon) {
    for (int lat = -89; lat <= 89; ++lat) {
      meridians.lines.rows.values.push_back(unit_vector_deg(lon, lat));
    }
    meridians.lines.rows.end_row();
  }
  meridians.lines.end_group();
  meridians.polygons.end_cell();
  const double expected = 360 * 178 * (std::numbers::pi / 180);
  EXPECT_NEAR(length_of(meridians), expected, 1e-12);
  const Geometries inside = combine(meridians, cap(33.3), SetOperation::intersection, {1});
  const Geometries outside = combine(meridians, cap(33.3), SetOperation::difference, {1});
  EXPECT_NEAR(length_of(inside) + length_of(outside), expected, 1e-11);
}

TEST(geometries, what_does_not_fit_is_refused) {
  const Geometries good = cap(60);
  Geometries bad = line_between({{1, 0, 0}, {-1, 0, 0}});
  EXPECT_EQ(thrown_index([&] { return combine(good, bad, SetOperation::unite); }), 1U);
  bad = line_between({{2, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(thrown_index([&] { return unite(bad); }), 0U);
  bad = good;
  bad.polygons.end_cell();
  EXPECT_THROW((void)unite(bad), InvalidInput);
  bad = line_between({});
  EXPECT_THROW((void)unite(bad), InvalidInput);
  const std::array<Index, 2> pair = {0, 1};
  EXPECT_THROW((void)combine_pairs(good, good, {&pair, 1}, SetOperation::unite), InvalidInput);
}

}  // namespace
}  // namespace rondel::test::of_geometries
