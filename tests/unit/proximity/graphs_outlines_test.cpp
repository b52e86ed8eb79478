// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Hulls, alpha shapes and empty circles against faces and sites one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/outlines.h"
#include "rondel/predicates.h"
#include "rondel/query.h"
#include "support/generators.h"
#include "support/random.h"

namespace rondel::test {
namespace {

using std::numbers::pi;
using Side = std::array<Index, 2>;

template <class Visit>
void for_each_case(const Visit& visit) {
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || generator.has_long_integers) continue;
    for (const std::size_t n : {1U, 3U, 9U, 60U}) {
      SCOPED_TRACE(std::string(generator.name) + " " + std::to_string(n));
      const SiteSet set = generator.make(n, 5);
      visit(delaunay(set.sites, {.sphere = set.sphere}));
    }
  }
}

// The sides between a set of faces and the other faces.
template <class IsIn>
std::multiset<Side> border_of(const Triangulation& t, const IsIn& is_in) {
  std::multiset<Side> sides;
  for (Index f = 0; f < t.num_faces(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!is_in(f) || is_in(t.neighbors()[f][i])) continue;
      sides.insert({t.faces()[f][(i + 1) % 3], t.faces()[f][(i + 2) % 3]});
    }
  }
  return sides;
}

std::multiset<Side> sides_of(const Outline& outline) {
  std::multiset<Side> sides;
  for (std::size_t r = 0; r < outline.rows.size(); ++r) {
    const std::span<const Index> ring = outline.rows[r];
    const std::size_t size = ring.size();
    EXPECT_GE(size, 3U);
    std::set<Index> corners;
    for (std::size_t i = 0; i < size; ++i) {
      const Index a = ring[i];
      EXPECT_TRUE(corners.insert(a).second);
      sides.insert({a, ring[(i + 1) % size]});
    }
  }
  return sides;
}

// How many sets of faces that hang together by edges.
template <class IsIn>
std::size_t num_parts(const Triangulation& t, const IsIn& is_in) {
  std::vector<bool> is_found(t.num_faces());
  std::size_t parts = 0;
  for (Index first = 0; first < t.num_faces(); ++first) {
    if (!is_in(first) || is_found[first]) continue;
    ++parts;
    std::vector<Index> stack{first};
    is_found[first] = true;
    while (!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for (const Index g : t.neighbors()[f]) {
        if (!is_in(g) || is_found[g]) continue;
        is_found[g] = true;
        stack.push_back(g);
      }
    }
  }
  return parts;
}

TEST(hull_polygon, is_the_border_of_the_solid_faces) {
  for_each_case([](const Triangulation& t) {
    const Outline hull = hull_polygon(t);
    EXPECT_EQ(hull.size(), t.dimension() == 2 ? 1U : 0U);
    EXPECT_EQ(sides_of(hull), border_of(t, [&](Index f) { return !t.is_ghost(f); }));
    // To the left of each side, or on its great circle, are all sites: it is convex.
    for (const Side& side : sides_of(hull)) {
      for (const Point& p : t.sites().points()) {
        EXPECT_NE(orientation(t.sites()[side[0]], t.sites()[side[1]], p, t.sphere()),
                  Sign::negative);
      }
    }
  });
}

TEST(hull_polygon, is_the_sphere_around_the_center) {
  const SiteSet set = generator("uniform").make(100, 1);
  const Outline hull = hull_polygon(delaunay(set.sites));
  EXPECT_EQ(hull.offsets, (std::vector<std::uint64_t>{0, 0}));
  EXPECT_TRUE(hull.rows.values.empty());
}

TEST(alpha_shape, is_the_border_of_the_faces_with_small_circles) {
  for_each_case([](const Triangulation& t) {
    const std::vector<EmptyCircle> circles =
        largest_empty_circles(t, t.num_faces(), CircleCenters::anywhere);
    // The two circles around both sides of a flat hull have the same sites.
    const bool is_flat =
        circles.size() == 2 && std::abs(circles[0].radius + circles[1].radius - pi) < 1e-12;
    // Between the radii of two circles.
    for (std::size_t i = 0; !is_flat && i + 1 < circles.size(); i += 1 + circles.size() / 5) {
      const double radius = (circles[i].radius + circles[i + 1].radius) / 2;
      if (!(circles[i + 1].radius <= radius && radius < circles[i].radius)) continue;
      const auto is_in = [&](Index f) {
        if (t.is_ghost(f)) return false;
        const Triple& c = t.faces()[f];
        // Of one of the larger circles?
        return std::none_of(circles.begin(), circles.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                            [&](const EmptyCircle& circle) {
                              const auto& s = circle.sites;
                              return std::ranges::all_of(c, [&](Index p) {
                                return side_of_circle(t.sites()[s[0]], t.sites()[s[1]],
                                                      t.sites()[s[2]], t.sites()[p],
                                                      Model::projected, t.sphere()) == Sign::zero;
                              });
                            });
      };
      const Outline shape = alpha_shape(t, radius);
      EXPECT_EQ(sides_of(shape), border_of(t, is_in));
      EXPECT_EQ(shape.size(), num_parts(t, is_in));
    }
    const Outline hull = hull_polygon(t);
    EXPECT_EQ(alpha_shape(t, pi).rows.values, hull.rows.values);
    EXPECT_EQ(alpha_shape(t, std::numeric_limits<double>::infinity()).rows.values,
              hull.rows.values);
  });
}

TEST(alpha_shape, has_a_hole_and_meets_itself_in_sites) {
  // The faces of a bipyramid around a missing pole, and two triangles that share a corner.
  std::vector<Point> sites;
  for (int i = 0; i < 12; ++i) {
    sites.push_back(unit_vector_deg(30 * i, 70));
    sites.push_back(unit_vector_deg(30 * i + 15, 62));
  }
  const Outline ring = alpha_shape(delaunay(sites), 0.18);
  EXPECT_EQ(ring.size(), 1U);
  EXPECT_EQ(ring.rows.size(), 2U);
  const std::vector<Point> bow_tie = {unit_vector_deg(0, 0), unit_vector_deg(3, 1),
                                      unit_vector_deg(3, -1), unit_vector_deg(-3, 1),
                                      unit_vector_deg(-3, -1)};
  const Outline two = alpha_shape(delaunay(bow_tie), 0.03);
  EXPECT_EQ(two.size(), 2U);
  EXPECT_EQ(two.rows.values.size(), 6U);
}

TEST(alpha_shape, refuses_radii_that_are_none_and_weights) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  const Triangulation t = delaunay(sites);
  EXPECT_THROW((void)alpha_shape(t, -1), InvalidInput);
  EXPECT_THROW((void)alpha_shape(t, std::nan("")), InvalidInput);
  const Triangulation weighted = delaunay(sites, {.model = Model::weighted});
  EXPECT_THROW((void)alpha_shape(weighted, 1), InvalidInput);
  EXPECT_THROW((void)largest_empty_circles(weighted, 1), InvalidInput);
}

TEST(empty_circles, touch_their_sites_and_have_none_inside) {
  for_each_case([](const Triangulation& t) {
    const auto circles = largest_empty_circles(t, t.num_faces(), CircleCenters::anywhere);
    const Locator locator(t);
    const Point o = t.sphere().center;
    if (std::hypot(o.x, o.y, o.z) > 1) return;  // the centers' rays are rounded
    for (const EmptyCircle& circle : circles) {
      const Point p{o.x + circle.center.x, o.y + circle.center.y, o.z + circle.center.z};
      EXPECT_NEAR(locator.distance(p, circle.sites[0]), circle.radius, 1e-13);
      EXPECT_NEAR(locator.distance(p, locator.nearest(p)), circle.radius, 1e-13);
    }
    EXPECT_TRUE(std::ranges::is_sorted(circles, std::ranges::greater{}, &EmptyCircle::radius));
  });
}

TEST(empty_circles, of_sites_on_a_great_circle_are_around_its_poles) {
  std::vector<Point> sites;
  for (const double lon : {0., 100., 170., 280.}) sites.push_back(unit_vector_deg(lon, 0));
  const auto circles = largest_empty_circles(delaunay(sites), 20, CircleCenters::anywhere);
  ASSERT_EQ(circles.size(), 2U);
  for (const EmptyCircle& circle : circles) {
    EXPECT_EQ(circle.radius, pi / 2);
    EXPECT_NEAR(std::abs(circle.center.z), 1, 1e-15);
  }
  EXPECT_NEAR(circles[0].center.z + circles[1].center.z, 0, 1e-15);
  EXPECT_EQ(largest_empty_circles(delaunay(sites), 1, CircleCenters::anywhere).size(), 1U);
  EXPECT_TRUE(largest_empty_circles(delaunay(sites), 20).empty());
  sites.pop_back();  // the others are within less than half
  EXPECT_TRUE(largest_empty_circles(delaunay(sites), 20, CircleCenters::anywhere).empty());
}

TEST(empty_circles, of_a_cube_are_six_and_those_inside_a_hull_less) {
  std::vector<Point> cube;
  for (int i = 0; i < 8; ++i)
    cube.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.});
  const auto circles = largest_empty_circles(delaunay(cube), 100);
  ASSERT_EQ(circles.size(), 6U);
  EXPECT_NEAR(circles[0].radius, std::acos(1 / std::sqrt(3)), 1e-15);
  EXPECT_EQ(largest_empty_circles(delaunay(cube), 2).size(), 2U);
  // The center of a triangle with an obtuse angle is outside of it.
  const Triangulation obtuse = delaunay(
      std::vector<Point>{unit_vector_deg(0, 0), unit_vector_deg(10, 0), unit_vector_deg(5, 1)});
  EXPECT_TRUE(largest_empty_circles(obtuse, 5).empty());
  const auto both_sides = largest_empty_circles(obtuse, 5, CircleCenters::anywhere);
  ASSERT_EQ(both_sides.size(), 2U);
  EXPECT_GT(both_sides[0].radius, pi / 2);
  EXPECT_NEAR(both_sides[0].radius + both_sides[1].radius, pi, 1e-14);
}

// The radii of the empty circles of all triples of sites, both sides of each, the largest first. Circles of more than three sites
// count once.
std::vector<double> radii_by_triples(const std::vector<Point>& sites) {
  std::vector<std::array<double, 4>> circles;  // center and radius
  const auto add = [&](const Point& normal) {
    const double length = std::hypot(normal.x, normal.y, normal.z);
    const Point u{normal.x / length, normal.y / length, normal.z / length};
    double nearest = pi;
    for (const Point& p : sites) {
      const double cosine = u.x * p.x + u.y * p.y + u.z * p.z;
      nearest = std::min(nearest, std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
    return std::array<double, 4>{u.x, u.y, u.z, nearest};
  };
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t j = i + 1; j < sites.size(); ++j) {
      for (std::size_t k = j + 1; k < sites.size(); ++k) {
        const Point& a = sites[i];
        const Point b{sites[j].x - a.x, sites[j].y - a.y, sites[j].z - a.z};
        const Point c{sites[k].x - a.x, sites[k].y - a.y, sites[k].z - a.z};
        const Point n{b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x};
        for (const Point& normal : {n, Point{-n.x, -n.y, -n.z}}) {
          const std::array<double, 4> circle = add(normal);
          const double to_corner =
              std::acos(std::clamp(circle[0] * a.x + circle[1] * a.y + circle[2] * a.z, -1.0, 1.0));
          if (circle[3] < to_corner - 1e-9) continue;  // a site is inside
          const bool is_known = std::ranges::any_of(circles, [&](const auto& known) {
            return std::hypot(known[0] - circle[0], known[1] - circle[1], known[2] - circle[2]) <
                   1e-9;
          });
          if (!is_known) circles.push_back(circle);
        }
      }
    }
  }
  std::vector<double> radii;
  for (const auto& circle : circles) radii.push_back(circle[3]);
  std::ranges::sort(radii, std::ranges::greater{});
  return radii;
}

TEST(empty_circles, of_few_sites_are_those_of_all_triples) {
  Random random(31);
  const auto expect_all = [](const std::vector<Point>& sites) {
    const auto circles = largest_empty_circles(delaunay(sites), 100, CircleCenters::anywhere);
    const std::vector<double> expected = radii_by_triples(sites);
    ASSERT_EQ(circles.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(circles[i].radius, expected[i], 1e-9);
    }
  };
  for (int turn = 0; turn < 60; ++turn) {
    SCOPED_TRACE(turn);
    const int n = 3 + turn % 5;
    const double widest = turn % 2 == 0 ? 80 : 20;  // on one side of the sphere
    std::vector<Point> scattered;
    std::vector<Point> on_one_circle;
    for (int i = 0; i < n; ++i) {
      scattered.push_back(
          unit_vector_deg(widest * random.signed_unit(), widest * random.signed_unit()));
      on_one_circle.push_back(unit_vector_deg(360.0 * (i + 0.4 * random.signed_unit()) / n, 0));
    }
    for (Point& p : on_one_circle) p = {0.6 * p.x, 0.6 * p.y, 0.8};  // off the sphere by rounding
    expect_all(scattered);
    if (n == 3) expect_all(on_one_circle);
  }
}

// All sites are on one circle, and one of its two sides has no center in the hull.
TEST(empty_circles, of_a_flat_hull_are_two) {
  const std::vector<Point> square = {{2, 1, 2}, {-1, 2, 2}, {-2, -1, 2}, {1, -2, 2}};
  const auto circles = largest_empty_circles(delaunay(square), 9, CircleCenters::anywhere);
  ASSERT_EQ(circles.size(), 2U);
  EXPECT_NEAR(circles[0].radius, pi - std::acos(2.0 / 3), 1e-15);
  EXPECT_NEAR(circles[1].radius, std::acos(2.0 / 3), 1e-15);
  EXPECT_NEAR(circles[0].center.z, -1, 1e-15);
  const auto inside = largest_empty_circles(delaunay(square), 9);
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_NEAR(inside[0].center.z, 1, 1e-15);
}

// The upper and the lower face of a prism, and eight on its sides; in which corners their triangles meet depends on the order.
TEST(empty_circles, of_a_prism_are_ten_in_any_order) {
  std::vector<Point> prism;
  for (const double z : {-1.0, 1.0}) {
    for (const auto& [x, y] : {std::pair{1, 2}, {2, 1}}) {
      for (int quarter = 0; quarter < 4; ++quarter) {
        prism.push_back(
            {quarter & 1 ? -double(x) : double(x), quarter & 2 ? -double(y) : double(y), z});
      }
    }
  }
  Random random(5);
  for (int turn = 0; turn < 20; ++turn) {
    for (std::size_t i = prism.size(); i > 1; --i) std::swap(prism[i - 1], prism[random.below(i)]);
    EXPECT_EQ(largest_empty_circles(delaunay(prism), 100).size(), 10U);
  }
}

// Seen from the middle of a cap, its corners lie around a hull, whose sides say what is inside; the center may be anywhere.
TEST(empty_circles, inside_are_those_whose_centers_are_in_the_hull) {
  for (const Point& origin : {Point{}, Point{3, -7, 5}}) {
    Random random(11);
    std::vector<Point> sites;
    for (int i = 0; i < 60; ++i) {
      sites.push_back(
          {origin.x + random.signed_unit(), origin.y + random.signed_unit(), origin.z + 1.5});
    }
    const Triangulation t = delaunay(sites, {.sphere = {origin, 1}});
    const std::multiset<Side> hull = sides_of(hull_polygon(t));
    const auto is_inside = [&](const Point& u) {
      return std::ranges::all_of(hull, [&](const Side& side) {
        const Point& p = t.sites()[side[0]];
        const Point& q = t.sites()[side[1]];
        const Point a{p.x - origin.x, p.y - origin.y, p.z - origin.z};
        const Point b{q.x - origin.x, q.y - origin.y, q.z - origin.z};
        return (a.y * b.z - a.z * b.y) * u.x + (a.z * b.x - a.x * b.z) * u.y +
                   (a.x * b.y - a.y * b.x) * u.z >
               0;
      });
    };
    std::vector<double> expected;
    const auto anywhere = largest_empty_circles(t, t.num_faces(), CircleCenters::anywhere);
    for (const EmptyCircle& circle : anywhere) {
      if (is_inside(circle.center)) expected.push_back(circle.radius);
    }
    std::vector<double> found;
    for (const EmptyCircle& circle : largest_empty_circles(t, t.num_faces())) {
      found.push_back(circle.radius);
    }
    EXPECT_EQ(found, expected);
    EXPECT_GT(found.size(), 50U);
    EXPECT_GT(anywhere.size(), found.size() + 5);
  }
}

}  // namespace
}  // namespace rondel::test
