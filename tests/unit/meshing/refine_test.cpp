// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Laws of refine() on hostile input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/refine_laws.h"
#include "support/thrown.h"

namespace rondel::test::of_refinement {
namespace {

using Ends = std::array<Index, 2>;
using mesh::refine;

struct Input {
  std::vector<Point> sites;
  std::vector<Ends> constraints;
};

// A point of a map around longitude and latitude 0, whose straight lines are arcs.
Point on_map(double x, double y) { return normalized({1, x, y}); }

void add_corners(Input& input) {
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) input.sites.push_back(on_map(x, y));
  }
}

bool do_cross(const Input& input, const Ends& e, const Ends& f) {
  const auto side = [&](const Ends& arc, Index v) {
    return static_cast<int>(orientation(input.sites[arc[0]], input.sites[arc[1]], input.sites[v]));
  };
  const int c = side(e, f[0]);
  return c != 0 && side(e, f[1]) == -c && side(f, e[0]) == -c && side(f, e[1]) == c;
}

void add_if_free(Input& input, const Ends& arc) {
  const bool is_free = std::ranges::none_of(
      input.constraints, [&](const Ends& other) { return do_cross(input, arc, other); });
  if (is_free) input.constraints.push_back(arc);
}

Input random_arcs(Random& random, double radius) {
  Input input;
  const std::size_t n = 4 + random.below(20);
  for (std::size_t i = 0; i < n; ++i) {
    input.sites.push_back(on_map(radius * random.signed_unit(), radius * random.signed_unit()));
  }
  for (std::size_t k = 0; k < 3 * n; ++k) {
    const auto a = static_cast<Index>(random.below(n));
    const auto b = static_cast<Index>(random.below(n));
    if (a != b) add_if_free(input, {a, b});
  }
  return input;
}

Input wide_arcs(Random& random) { return random_arcs(random, 0.5); }
Input small_arcs(Random& random) { return random_arcs(random, 1e-3); }
Input tiny_arcs(Random& random) { return random_arcs(random, 1e-8); }

Input nearly_parallel_arcs(Random& random) {
  Input input;
  const double apart = std::pow(10, -1.5 - 1.5 * random.unit());
  for (Index i = 0; i < 3; ++i) {
    const double y = i * apart;
    input.sites.push_back(on_map(-0.3 + 0.01 * random.unit(), y));
    input.sites.push_back(on_map(0.3 + 0.01 * random.unit(), y * (1 + 0.3 * random.unit())));
    input.constraints.push_back({2 * i, 2 * i + 1});
  }
  add_corners(input);
  return input;
}

// Arcs from one site.
void add_arms(Input& input, const std::vector<double>& angles, Random& random) {
  input.sites.push_back(on_map(0, 0));
  for (const double angle : angles) {
    const double length = 0.1 + 0.3 * random.unit();
    input.constraints.push_back({0, static_cast<Index>(input.sites.size())});
    input.sites.push_back(on_map(length * std::cos(angle), length * std::sin(angle)));
  }
}

Input small_angles(Random& random) {
  Input input;
  const double angle = std::pow(10, -1 - 8 * random.unit());
  add_arms(input, {0, angle, 2 * angle}, random);
  add_corners(input);
  return input;
}

Input star(Random& random) {
  Input input;
  std::vector<double> angles(3 + random.below(30));
  for (double& angle : angles) angle = 2 * std::numbers::pi * random.unit();
  add_arms(input, angles, random);
  add_corners(input);
  return input;
}

Input site_beside_arc(Random& random) {
  Input input;
  const double apart = std::pow(10, -6 - 7 * random.unit());
  input.sites = {on_map(-0.3, 0), on_map(0.3, 0), on_map(0.05, apart)};
  input.constraints = {{0, 1}};
  add_corners(input);
  return input;
}

Input whole_sphere(Random& random) {
  Input input;
  for (const double x : {1.0, -1.0}) {
    for (const Point& p : {Point{x, 0, 0}, Point{0, x, 0}, Point{0, 0, x}}) {
      input.sites.push_back(p);
    }
  }
  const std::size_t n = random.below(5);
  for (std::size_t i = 0; i < n; ++i) input.sites.push_back(random_direction(random));
  return input;
}

// Few sites on the whole sphere, two of them close, and their triangles are large.
Input close_pair(Random& random) {
  Input input;
  for (int i = 0; i < 5; ++i) input.sites.push_back(random_direction(random));
  input.sites.push_back({1, 0, 0});
  input.sites.push_back(normalized({1, 0, std::pow(10, -2 - 6 * random.unit())}));
  return input;
}

// Small angles at both ends of arcs.
Input zigzag(Random& random) {
  Input input;
  const auto n = static_cast<Index>(5 + random.below(8));
  for (Index i = 0; i < n; ++i) {
    input.sites.push_back(on_map(0.3 * i / n, 0.003 * (i % 2) * random.unit()));
  }
  for (Index i = 1; i < n; ++i) {
    add_if_free(input, {i - 1, i});
    if (i > 1) add_if_free(input, {i - 2, i});
  }
  add_corners(input);
  return input;
}

struct InputKind {
  std::string_view name;
  Input (*make)(Random& random);
  std::size_t count;
};

constexpr std::array<InputKind, 10> kinds = {{{"wide arcs", wide_arcs, 12},
                                              {"small arcs", small_arcs, 12},
                                              {"tiny arcs", tiny_arcs, 12},
                                              {"nearly parallel arcs", nearly_parallel_arcs, 5},
                                              {"small angles", small_angles, 12},
                                              {"site beside an arc", site_beside_arc, 12},
                                              {"star", star, 12},
                                              {"whole sphere", whole_sphere, 12},
                                              {"close pair", close_pair, 12},
                                              {"zigzag", zigzag, 12}}};

ConstrainedTriangulation triangulated(const Input& input) {
  return constrained_delaunay(input.sites, input.constraints);
}

std::vector<Index> one_region(const ConstrainedTriangulation& given) {
  std::vector<Index> regions(given.triangulation.num_faces(), 0);
  return regions;
}

mesh::RefinedMesh expect_laws(const ConstrainedTriangulation& given,
                              const std::vector<Index>& regions,
                              const mesh::RefineOptions& options = {}) {
  mesh::RefinedMesh mesh = refine(given, regions, options);
  EXPECT_EQ(RefineLaws(given, regions, options, mesh).flaw(), "");
  EXPECT_EQ(mesh.report.num_too_small, 0U);
  return mesh;
}

// False if a region is so thin over so long a way that it takes too many triangles, which the border
// of one beside an arc may be.
bool has_room(const ConstrainedTriangulation& given, const std::vector<Index>& regions) {
  try {
    static_cast<void>(refine(given, regions, {.most_vertices = 20'000}));
  } catch (const InvalidInput&) {
    return false;
  }
  return true;
}

// Calls for each input of each kind.
template <class Check>
void for_each_input(const Check& check) {
  for (const InputKind& kind : kinds) {
    for (std::size_t seed = 0; seed < scaled(kind.count); ++seed) {
      SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(seed));
      Random random(seed);
      check(kind.make(random), random);
    }
  }
}

TEST(refine, laws_hold_for_hostile_input) {
  for_each_input([](const Input& input, Random& random) {
    const auto given = triangulated(input);
    constexpr std::array<double, 4> angles = {20, 26.5, 30, 0};
    expect_laws(given, one_region(given), {.smallest_angle_deg = angles.at(random.below(4))});
  });
}

TEST(refine, laws_hold_for_regions) {
  for_each_input([](const Input& input, Random& random) {
    const auto given = triangulated(input);
    const auto left_out = static_cast<Index>(random.below(4));
    const auto regions = regions_by_sign(given.triangulation, &Point::y, left_out);
    if (has_room(given, regions)) expect_laws(given, regions);
  });
}

TEST(refine, laws_hold_for_spacings) {
  for_each_input([](const Input& input, Random& random) {
    const auto given = triangulated(input);
    const double far = given.triangulation.num_ghost_faces() == 0 ? 0.3 : 0.05;
    mesh::SizeFunction spacing = mesh::SizeFunction::constant(far, 64);
    if (random.coin()) {
      spacing = spacing.refined(std::vector<Point>{{1, 0, 0}}, far / 4, 0.2).limited(0.2);
    }
    expect_laws(given, one_region(given), {.spacing = spacing});
  });
}

TEST(refine, order_and_threads_change_nothing_but_numbers) {
  for_each_input([](const Input& input, Random& random) {
    const auto given = triangulated(input);
    const auto regions = regions_by_sign(given.triangulation, &Point::z, 2);
    if (!has_room(given, regions)) return;
    const RefinedPoints points = points_of(refine(given, regions, {}, {.threads = 1}));
    std::vector<Index> old(input.sites.size());
    for (Index i = 0; i < old.size(); ++i) old[i] = i;
    random.shuffle(old);
    Input other;
    std::vector<Index> now(old.size());
    for (Index i = 0; i < old.size(); ++i) {
      other.sites.push_back(input.sites[old[i]]);
      now[old[i]] = i;
    }
    for (const auto& [a, b] : input.constraints) other.constraints.push_back({now[b], now[a]});
    random.shuffle(other.constraints);
    const auto again = triangulated(other);
    const auto mesh =
        refine(again, regions_by_sign(again.triangulation, &Point::z, 2), {}, {.threads = 2});
    EXPECT_TRUE(points_of(mesh) == points);
  });
}

// The distance of a point from an arc, by the chord.
double distance_from_arc(const Point& p, const Point& a, const Point& b) {
  const Point normal = normalized(cross_product(a, b - a));
  const bool is_beside =
      dot_product(cross_product(normal, a), p) > 0 && dot_product(cross_product(normal, b), p) < 0;
  return is_beside ? std::abs(dot_product(normal, p - a))
                   : std::min(chord_length(p, a), chord_length(p, b));
}

// The constrained edges and those of the hull.
std::vector<Ends> segments_of(const ConstrainedTriangulation& given) {
  std::vector<Ends> segments = given.edges;
  const Triangulation& t = given.triangulation;
  for (Index f = 0; f < t.num_faces(); ++f) {
    for (std::size_t i = 0; i < 3 && !t.is_ghost(f); ++i) {
      if (!t.is_ghost(t.neighbors()[f].at(i))) continue;
      segments.push_back({t.faces()[f].at((i + 1) % 3), t.faces()[f].at((i + 2) % 3)});
    }
  }
  return segments;
}

bool has_angle_below_60(const std::vector<Point>& sites, const std::vector<Ends>& segments) {
  for (const Ends& e : segments) {
    for (const Ends& f : segments) {
      for (const std::size_t i : {0U, 1U}) {
        for (const std::size_t j : {0U, 1U}) {
          const Index b = e.at(1 - i);
          const Index c = f.at(1 - j);
          if (e.at(i) != f.at(j) || b == c) continue;
          const Point& a = sites[e.at(i)];
          const Point p = normalized(cross_product(a, sites[b]));
          const Point q = normalized(cross_product(a, sites[c]));
          if (dot_product(p, q) > 0.5) return true;
        }
      }
    }
  }
  return false;
}

double smallest_distance(const Input& input, const std::vector<Ends>& segments) {
  double smallest = 2;
  for (Index v = 0; v < input.sites.size(); ++v) {
    const Point& p = input.sites[v];
    for (Index w = 0; w < v; ++w) smallest = std::min(smallest, chord_length(p, input.sites[w]));
    for (const auto& [a, b] : segments) {
      if (v == a || v == b) continue;
      smallest = std::min(smallest, distance_from_arc(p, input.sites[a], input.sites[b]));
    }
  }
  return smallest;
}

TEST(refine, edges_are_not_shorter_than_distances_of_the_input) {
  std::size_t count = 0;
  for_each_input([&](const Input& input, Random&) {
    const auto given = triangulated(input);
    const std::vector<Ends> segments = segments_of(given);
    if (has_angle_below_60(input.sites, segments)) return;
    ++count;
    const auto mesh = refine(given, one_region(given));
    EXPECT_EQ(mesh.report.num_near_small_angles, 0U);
    double shortest = 2;
    for (const auto& [a, b, c] : mesh.triangles) {
      for (const auto& [v, w] : {Ends{a, b}, Ends{b, c}, Ends{c, a}}) {
        shortest = std::min(shortest, chord_length(mesh.nodes[v], mesh.nodes[w]));
      }
    }
    EXPECT_GE(shortest, 0.5 * smallest_distance(input, segments));
  });
  EXPECT_GE(count, scaled(20));
}

TEST(refine, good_triangles_remain) {
  Random random(1);
  Input octahedron = whole_sphere(random);
  octahedron.sites.resize(6);
  const auto given = triangulated(octahedron);
  const auto mesh = expect_laws(given, one_region(given));
  EXPECT_EQ(mesh.nodes.size(), 6U);
  EXPECT_EQ(mesh.triangles.size(), 8U);
  EXPECT_TRUE(mesh.edges.empty());
  EXPECT_EQ(mesh.report.num_inserted, 0U);
}

// Two arcs at 1 degree: the triangle between them near their common end is left, and counted.
TEST(refine, triangles_near_small_angles_are_counted) {
  Input input;
  input.sites = {on_map(0, 0), on_map(0.3, 0), on_map(0.3, 0.3 * std::numbers::pi / 180)};
  input.constraints = {{0, 1}, {0, 2}};
  add_corners(input);
  const auto given = triangulated(input);
  const auto mesh = expect_laws(given, one_region(given));
  EXPECT_GE(mesh.report.num_near_small_angles, 1U);
  EXPECT_LE(mesh.report.num_near_small_angles, 20U);
}

// Sites that are closer than the least distance between vertices leave triangles that are counted.
TEST(refine, triangles_that_are_too_small_are_counted) {
  Input input;
  input.sites = {on_map(0, 0), on_map(1e-14, 0), on_map(0, 3e-13)};
  add_corners(input);
  const auto given = triangulated(input);
  const auto regions = one_region(given);
  const mesh::RefineOptions options;
  const auto mesh = refine(given, regions, options);
  EXPECT_EQ(RefineLaws(given, regions, options, mesh).flaw(), "");
  EXPECT_GE(mesh.report.num_too_small, 1U);
}

TEST(refine, nothing_is_asked_for) {
  Random random(2);
  const auto given = triangulated(wide_arcs(random));
  const std::vector<Index> none(given.triangulation.num_faces(), no_index);
  EXPECT_TRUE(refine(given, none).nodes.empty());
  const auto ring = constrained_delaunay(std::vector<Point>{{1, 0, 0}, {0, 1, 0}}, {});
  EXPECT_TRUE(refine(ring, {}).triangles.empty());
}

// Two constraints with one end, whose others are in nearly one direction: nobody asks for the face between them, which is
// narrower than rounding. The chain of one must not cross that of the other.
TEST(refine, chains_do_not_cross_where_the_face_between_them_is_narrow) {
  Random random(11);
  std::size_t num_narrow = 0;
  for (int round = 0; round < 300; ++round) {
    const Point p = random.direction();
    const double factor = 5;
    std::vector<Point> sites = {p, {factor * p.x, factor * p.y, factor * p.z}, random.direction()};
    for (const Point& more :
         {Point{1, 0, 0}, Point{-1, 1, 0}, Point{-1, -1, 1}, Point{-1, -1, -1}}) {
      sites.push_back(more);
    }
    const auto given = constrained_delaunay(Sites(sites), std::vector<Ends>{{0, 2}, {1, 2}});
    std::vector<Index> regions;
    for (const Triple& face : given.triangulation.faces()) {
      const bool is_between = std::ranges::all_of(face, [](Index v) { return v < 3; });
      if (is_between) ++num_narrow;
      regions.push_back(is_between ? no_index : 0);
    }
    const mesh::RefineOptions options{.smallest_angle_deg = 20,
                                      .spacing = mesh::SizeFunction::constant(0.3, 4)};
    const mesh::RefinedMesh made = refine(given, regions, options);
    EXPECT_EQ(RefineLaws(given, regions, options, made).flaw(), "");
  }
  EXPECT_GT(num_narrow, 100U);
}

TEST(refine, segments_between_nearly_opposite_points_stay_in_their_plane) {
  const Point p = {0.6, 0.48, 0.64};
  for (const double away : {0x1p-20, 0x1p-40, 0x1p-51}) {
    const Point q = {-0.6 - 0.8 * away, -0.48 + 0.36 * away, -0.64 + 0.48 * away};
    const std::vector<Point> sites = {p,          q,         {0, 1, 0}, {0, -1, 0},
                                      {0, 0, -1}, {0, 0, 1}, {1, 0, 0}};
    const auto given =
        constrained_delaunay(Sites(sites), std::vector<std::array<Index, 2>>{{0, 1}});
    const std::vector<Index> regions(given.triangulation.num_faces(), 0);
    const auto made = refine(given, regions, {.spacing = mesh::SizeFunction::constant(0.3, 16)});
    const Point normal = cross_product(p, p + q);  // the sum is exact
    std::size_t parts = 0;
    for (std::size_t e = 0; e < made.edges.size(); ++e) {
      if (made.sources[e] == no_index) continue;
      ++parts;
      for (const Index node : made.edges[e]) {
        EXPECT_LE(std::abs(dot_product(normal, made.nodes[node])), 0x1p-51 * length_of(normal));
        EXPECT_GE(dot_product(p + q, made.nodes[node]), -0x1p-51);
      }
    }
    EXPECT_GE(parts, 8U);
  }
}

TEST(refine, errors_say_what_is_wrong) {
  Random random(3);
  const auto given = triangulated(whole_sphere(random));
  const auto regions = one_region(given);
  const auto message = [&](const mesh::RefineOptions& options) {
    return thrown_message<InvalidInput>([&] { return refine(given, regions, options); });
  };
  EXPECT_EQ(
      thrown_message<InvalidInput>([&] { return refine(given, {}); }),
      "there is one region for each face, not 0 for " + std::to_string(regions.size()) + " faces");
  for (const double angle : {-1.0, 33.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(message({.smallest_angle_deg = angle}).substr(0, 44),
              "the smallest angle is from 0 to 33 degrees, ");
  }
  EXPECT_EQ(message({.spacing = mesh::SizeFunction::constant(0.1, 64), .most_vertices = 100}),
            "a mesh with these spacings and angles has more than 100 vertices");
  const auto moved =
      constrained_delaunay(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}}, {},
                           {.sphere = {.center = {0.125, 0, 0}}});
  EXPECT_EQ(thrown_message<InvalidInput>([&] { return refine(moved, one_region(moved)); }),
            "triangles are refined around the origin only");
}

}  // namespace
}  // namespace rondel::test::of_refinement
