// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Laws of refined triangles, on hostile sites and constraints: they are those of
// constrained_delaunay(), which an oracle of its own proves, and as large and as wide as promised.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include "rondel/error.h"
#include "rondel/mesh_refine.h"
#include "rondel/predicates.h"
#include "support/random.h"
#include "support/thrown.h"

namespace rondel::test::of_refine {
namespace {

using mesh::refine;
using mesh::RefinedMesh;
using mesh::RefineOptions;
using mesh::SizeFunction;
using Ends = std::array<Index, 2>;

constexpr double degrees_per_radian = 180 / std::numbers::pi;

struct Scene {
  std::vector<Point> sites;
  std::vector<Ends> constraints;
};

// Returns a point of the plane that touches the sphere at (1, 0, 0), seen from the center.
Point at(double x, double y) {
  const double length = std::sqrt(1 + x * x + y * y);
  return {1 / length, x / length, y / length};
}

Point difference(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double product(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point cross_product(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double distance(const Point& a, const Point& b) {
  return std::sqrt(product(difference(a, b), difference(a, b)));
}

// The distance of a point from an arc, by a chord.
double distance(const Point& p, const Point& a, const Point& b) {
  const Point normal = cross_product(a, difference(b, a));
  const bool is_beside =
      product(cross_product(normal, a), p) > 0 && product(cross_product(normal, b), p) < 0;
  if (!is_beside) return std::min(distance(p, a), distance(p, b));
  return std::abs(product(normal, difference(p, a))) / std::sqrt(product(normal, normal));
}

double at_random(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.below(1U << 30U)) / (1U << 30U);
}

bool do_cross(const std::vector<Point>& sites, const Ends& e, const Ends& f) {
  const auto side = [&](const Ends& arc, Index v) {
    return static_cast<int>(orientation(sites[arc[0]], sites[arc[1]], sites[v]));
  };
  const int c = side(e, f[0]);
  return c != 0 && side(e, f[1]) == -c && side(f, e[0]) == -c && side(f, e[1]) == c;
}

// Adds a square around everything.
void add_frame(Scene& scene) {
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) scene.sites.push_back(at(x, y));
  }
}

// Sites within a distance of each other, and as many constraints as do not cross.
Scene cloud(Random& random, double radius) {
  Scene scene;
  const std::size_t n = 4 + random.below(16);
  for (std::size_t i = 0; i < n; ++i) {
    scene.sites.push_back(
        at(at_random(random, -radius, radius), at_random(random, -radius, radius)));
  }
  for (std::size_t k = 0; k < 3 * n; ++k) {
    const Ends ends = {static_cast<Index>(random.below(n)), static_cast<Index>(random.below(n))};
    if (ends[0] == ends[1]) continue;
    const bool is_free = std::ranges::none_of(
        scene.constraints, [&](const Ends& other) { return do_cross(scene.sites, ends, other); });
    if (is_free) scene.constraints.push_back(ends);
  }
  return scene;
}

// Rivers that are nearly parallel.
Scene rivers(Random& random) {
  Scene scene;
  const double gap = std::pow(10, at_random(random, -3, -2));
  for (Index i = 0; i < 3; ++i) {
    const double y = gap * i;
    scene.sites.push_back(at(-0.3 + at_random(random, 0, 0.01), y));
    scene.sites.push_back(at(0.3 + at_random(random, 0, 0.01), y * at_random(random, 1, 1.3)));
    scene.constraints.push_back({2 * i, 2 * i + 1});
  }
  add_frame(scene);
  return scene;
}

// Rivers that meet at an angle of down to 1e-9.
Scene confluence(Random& random) {
  Scene scene;
  const double angle = std::pow(10, at_random(random, -9, -1));
  scene.sites.push_back(at(0, 0));
  for (Index i = 0; i < 3; ++i) {
    const double length = at_random(random, 0.1, 0.4);
    scene.sites.push_back(at(length * std::cos(angle * i), length * std::sin(angle * i)));
    scene.constraints.push_back({0, i + 1});
  }
  add_frame(scene);
  return scene;
}

// A site that is up to 1e-13 from a coast.
Scene near_coast(Random& random) {
  Scene scene{{at(-0.3, 0), at(0.3, 0)}, {{0, 1}}};
  scene.sites.push_back(at(0.05, std::pow(10, at_random(random, -13, -6))));
  add_frame(scene);
  return scene;
}

// Many constraints from one site.
Scene star(Random& random) {
  Scene scene{{at(0, 0)}, {}};
  const auto n = static_cast<Index>(3 + random.below(30));
  for (Index i = 0; i < n; ++i) {
    const double angle = at_random(random, 0, 2 * std::numbers::pi);
    const double length = at_random(random, 0.05, 0.35);
    scene.sites.push_back(at(length * std::cos(angle), length * std::sin(angle)));
    scene.constraints.push_back({0, i + 1});
  }
  add_frame(scene);
  return scene;
}

// Sites around the whole sphere.
Scene everywhere(Random& random) {
  Scene scene;
  for (const double x : {-1.0, 1.0}) {
    scene.sites.insert(scene.sites.end(), {{x, 0, 0}, {0, x, 0}, {0, 0, x}});
  }
  for (std::size_t i = 0; i < random.below(6); ++i) {
    const double z = at_random(random, -1, 1);
    const double angle = at_random(random, 0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    scene.sites.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  return scene;
}

using Corners = std::array<std::tuple<double, double, double>, 3>;

std::set<Corners> places_of(std::span<const Point> nodes, std::span<const Triple> triangles) {
  std::set<Corners> places;
  for (const Triple& triangle : triangles) {
    Corners corners;
    for (unsigned i = 0; i < 3; ++i) {
      const Point& p = nodes[triangle[i]];
      corners[i] = {p.x, p.y, p.z};
    }
    std::ranges::sort(corners);
    places.insert(corners);
  }
  return places;
}

// The smallest angle between chords, in degrees, and the shortest edge.
struct Measures {
  double angle_deg = 180;
  double shortest = 9;
  std::size_t num_narrow = 0;
};

Measures measures_of(const RefinedMesh& made, double smallest_angle_deg) {
  Measures result;
  for (const auto& [a, b, c] : made.triangles) {
    const std::array<double, 3> sides = {distance(made.nodes[b], made.nodes[c]),
                                         distance(made.nodes[c], made.nodes[a]),
                                         distance(made.nodes[a], made.nodes[b])};
    double least = 180;
    for (unsigned i = 0; i < 3; ++i) {
      const double p = sides[(i + 1) % 3];
      const double q = sides[(i + 2) % 3];
      const double cosine = (p * p + q * q - sides[i] * sides[i]) / (2 * p * q);
      least = std::min(least, std::acos(std::clamp(cosine, -1.0, 1.0)) * degrees_per_radian);
      result.shortest = std::min(result.shortest, sides[i]);
    }
    result.angle_deg = std::min(result.angle_deg, least);
    // Sides of 1e-13 have three digits.
    const double tolerance = 1e-9 + 1e-13 / *std::ranges::min_element(sides);
    if (least < smallest_angle_deg - tolerance) ++result.num_narrow;
  }
  return result;
}

// The segments of a triangulation: constrained edges, and those of the hull.
std::vector<Ends> segments_of(const ConstrainedTriangulation& given) {
  std::vector<Ends> segments = given.edges;
  const Triangulation& t = given.triangulation;
  for (Index f = 0; f < t.num_faces(); ++f) {
    for (unsigned i = 0; i < 3; ++i) {
      if (t.is_ghost(f) || !t.is_ghost(t.neighbors()[f][i])) continue;
      segments.push_back({t.faces()[f][(i + 1) % 3], t.faces()[f][(i + 2) % 3]});
    }
  }
  return segments;
}

// The smallest distance of two sites, or of a site and a segment that does not end there.
double smallest_distance(const std::vector<Point>& sites, const std::vector<Ends>& segments) {
  double least = 9;
  for (Index i = 0; i < sites.size(); ++i) {
    for (Index j = 0; j < i; ++j) least = std::min(least, distance(sites[i], sites[j]));
    for (const auto& [a, b] : segments) {
      if (i != a && i != b) least = std::min(least, distance(sites[i], sites[a], sites[b]));
    }
  }
  return least;
}

// True if two segments meet at less than 60 degrees.
bool has_small_angle(const std::vector<Point>& sites, const std::vector<Ends>& segments) {
  const auto direction = [&](Index from, Index to) {
    const Point d = difference(sites[to], sites[from]);
    const double length = std::sqrt(product(d, d));
    return Point{d.x / length, d.y / length, d.z / length};
  };
  for (std::size_t k = 0; k < segments.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      for (const Index v : segments[k]) {
        if (segments[j][0] != v && segments[j][1] != v) continue;
        const Index p = segments[k][0] == v ? segments[k][1] : segments[k][0];
        const Index q = segments[j][0] == v ? segments[j][1] : segments[j][0];
        if (p != q && product(direction(v, p), direction(v, q)) > 0.5) return true;
      }
    }
  }
  return false;
}

ConstrainedTriangulation triangulated(const Scene& scene) {
  return constrained_delaunay(Sites(scene.sites), scene.constraints);
}

std::vector<Index> one_region(const ConstrainedTriangulation& given) {
  std::vector<Index> regions(given.triangulation.num_faces(), 0);
  for (const Index f : given.triangulation.ghost_faces()) regions[f] = no_index;
  return regions;
}

// The triangles are faces of the constrained triangulation of all nodes, and cover as much.
void expect_constrained_delaunay(const RefinedMesh& made) {
  const auto again = constrained_delaunay(Sites(made.nodes), made.edges);
  const std::set<Corners> all = places_of(made.nodes, again.triangulation.faces());
  for (const Corners& triangle : places_of(made.nodes, made.triangles)) {
    ASSERT_TRUE(all.contains(triangle));
  }
  for (const auto& [a, b, c] : made.triangles) {
    ASSERT_EQ(orientation(made.nodes[a], made.nodes[b], made.nodes[c]), Sign::positive);
  }
}

// Each edge that is said to be a part of a constrained edge is close to it.
void expect_sources(const ConstrainedTriangulation& given, const RefinedMesh& made) {
  ASSERT_EQ(made.sources.size(), made.edges.size());
  const std::span<const Point> sites = given.triangulation.sites().points();
  std::vector<double> lengths(given.edges.size());
  for (std::size_t k = 0; k < made.edges.size(); ++k) {
    if (made.sources[k] == no_index) continue;
    const auto [a, b] = given.edges[made.sources[k]];
    for (const Index node : made.edges[k]) {
      EXPECT_LT(distance(made.nodes[node], sites[a], sites[b]), 0x1p-50);
    }
    lengths[made.sources[k]] +=
        std::asin(distance(made.nodes[made.edges[k][0]], made.nodes[made.edges[k][1]]) / 2);
  }
  for (std::size_t e = 0; e < lengths.size(); ++e) {
    const auto [a, b] = given.edges[e];
    EXPECT_NEAR(lengths[e], std::asin(distance(sites[a], sites[b]) / 2), 1e-13);
  }
}

void expect_laws(const Scene& scene, const RefineOptions& options, double spacing) {
  const ConstrainedTriangulation given = triangulated(scene);
  const RefinedMesh made = refine(given, one_region(given), options);
  expect_constrained_delaunay(made);
  expect_sources(given, made);
  const Measures measures = measures_of(made, options.smallest_angle_deg);
  const std::vector<Ends> segments = segments_of(given);
  const bool is_sharp = has_small_angle(scene.sites, segments);
  EXPECT_LE(measures.num_narrow, made.report.num_near_small_angles + made.report.num_too_small);
  EXPECT_EQ(made.report.num_too_small, 0U);
  if (!is_sharp) {
    EXPECT_EQ(made.report.num_near_small_angles, 0U);
    const double least = std::min(smallest_distance(scene.sites, segments), spacing);
    EXPECT_GT(measures.shortest, least / 4);
  }
  const double longest = 1.5 * 2 * std::sin(std::min(spacing, 3.0) / 2) * (1 + 1e-12);
  for (const auto& [a, b, c] : made.triangles) {
    if (spacing > 3) break;
    for (const auto& [p, q] : {Ends{a, b}, Ends{b, c}, Ends{c, a}}) {
      EXPECT_LE(distance(made.nodes[p], made.nodes[q]), longest);
    }
  }
}

void expect_laws_of(const std::function<Scene(Random&)>& make, int seeds) {
  for (int seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const Scene scene = make(random);
    expect_laws(scene, {}, 9);
    RefineOptions options;
    options.smallest_angle_deg = seed % 2 == 0 ? 28.6 : 20;
    const double spacing = 0.05;
    options.spacing = SizeFunction::constant(spacing, 16);
    expect_laws(scene, options, spacing);
  }
}

TEST(refine, clouds_with_many_constraints) {
  for (const double radius : {0.5, 1e-3, 1e-8}) {
    expect_laws_of([radius](Random& random) { return cloud(random, radius); }, 8);
  }
}
TEST(refine, rivers_that_are_nearly_parallel) { expect_laws_of(rivers, 4); }
TEST(refine, rivers_that_meet_at_a_small_angle) { expect_laws_of(confluence, 25); }
TEST(refine, a_site_close_to_a_coast) { expect_laws_of(near_coast, 20); }
TEST(refine, stars) { expect_laws_of(star, 15); }
TEST(refine, the_whole_sphere) { expect_laws_of(everywhere, 10); }

TEST(refine, order_and_threads_change_nothing) {
  for (int seed = 1; seed <= 10; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    Scene scene = cloud(random, 0.3);
    const ConstrainedTriangulation given = triangulated(scene);
    const RefinedMesh first = refine(given, one_region(given));
    const auto last = static_cast<Index>(scene.sites.size() - 1);
    std::ranges::reverse(scene.sites);
    std::ranges::reverse(scene.constraints);
    for (Ends& ends : scene.constraints) ends = {last - ends[1], last - ends[0]};
    const ConstrainedTriangulation turned = triangulated(scene);
    const RefinedMesh second = refine(turned, one_region(turned), {}, {.threads = 2});
    EXPECT_TRUE(places_of(first.nodes, first.triangles) ==
                places_of(second.nodes, second.triangles));
  }
}

// The two sides of a square in two regions, and what is around them in none.
TEST(refine, regions_are_kept) {
  Scene scene;
  scene.sites = {at(-0.1, -0.1), at(0.1, -0.1), at(0.1, 0.1), at(-0.1, 0.1)};
  scene.constraints = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}};
  add_frame(scene);
  const ConstrainedTriangulation given = triangulated(scene);
  const std::span<const Triple> faces = given.triangulation.faces();
  std::vector<Index> regions(faces.size(), no_index);
  for (Index f = 0; f < faces.size(); ++f) {
    Triple corners = faces[f];
    std::ranges::sort(corners);
    if (corners == Triple{0, 1, 2}) regions[f] = 7;
    if (corners == Triple{0, 2, 3}) regions[f] = 3;
  }
  const RefinedMesh made = refine(given, regions, {.spacing = SizeFunction::constant(0.03, 16)});
  ASSERT_EQ(made.regions.size(), made.triangles.size());
  EXPECT_GT(std::ranges::count(made.regions, 7U), 20);
  for (std::size_t k = 0; k < made.triangles.size(); ++k) {
    Point middle = {0, 0, 0};
    for (const Index node : made.triangles[k]) {
      middle = {middle.x + made.nodes[node].x, middle.y + made.nodes[node].y,
                middle.z + made.nodes[node].z};
    }
    const bool is_below = orientation(scene.sites[0], scene.sites[2], middle) == Sign::negative;
    EXPECT_EQ(made.regions[k], is_below ? 7U : 3U);
    EXPECT_LE(std::abs(middle.y / middle.x), 0.1);
    EXPECT_LE(std::abs(middle.z / middle.x), 0.1);
  }
  EXPECT_EQ(std::ranges::count(made.sites, no_index),
            static_cast<std::ptrdiff_t>(made.nodes.size()) - 4);
}

TEST(refine, errors) {
  Random random(1);
  const ConstrainedTriangulation given = triangulated(everywhere(random));
  const std::vector<Index> regions = one_region(given);
  const auto message = [&](std::span<const Index> of, const RefineOptions& options) {
    return thrown_message<InvalidInput>([&] { return refine(given, of, options); });
  };
  EXPECT_EQ(
      message(std::span(regions).first(3), {}),
      "there is one region for each face, not 3 for " + std::to_string(regions.size()) + " faces");
  EXPECT_EQ(message(regions, {.smallest_angle_deg = 34}),
            "the smallest angle is from 0 to 33 degrees, not 34");
  EXPECT_EQ(message(regions, {.smallest_angle_deg = std::numeric_limits<double>::quiet_NaN()}),
            "the smallest angle is from 0 to 33 degrees, not nan");
  EXPECT_EQ(message(regions, {.spacing = SizeFunction::constant(0.01, 16), .most_vertices = 100}),
            "a mesh with these spacings and angles has more than 100 vertices");
  const std::vector<Point> shifted = {{2, 0, 0}, {0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1}};
  const auto elsewhere = constrained_delaunay(Sites(shifted), {}, {.sphere = {{1, 0, 0}, 1}});
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              return refine(elsewhere, std::vector<Index>(elsewhere.triangulation.num_faces(), 0));
            }),
            "triangles are refined around the origin only");
}

TEST(refine, nothing_asked_for) {
  Random random(1);
  const ConstrainedTriangulation given = triangulated(everywhere(random));
  const RefinedMesh made =
      refine(given, std::vector<Index>(given.triangulation.num_faces(), no_index));
  EXPECT_TRUE(made.nodes.empty());
  EXPECT_TRUE(made.triangles.empty());
}

}  // namespace
}  // namespace rondel::test::of_refine
