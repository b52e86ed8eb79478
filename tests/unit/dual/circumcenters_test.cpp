// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "api/triangulation_impl.h"
#include "dual/face_batch.h"
#include "dual/face_normal.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "support/mpfr_oracle.h"
#include "unit/dual/support.h"

namespace rondel::test {
namespace {

// Faces that belong to no surface: circumcenters looks at corners only, of which each face has three.
Triangulation loose_faces(const std::vector<Point>& sites, Model model) {
  const std::size_t num_faces = sites.size() / 3;
  TriangulationArrays arrays;
  arrays.num_sites = sites.size();
  arrays.dimension = 2;
  for (Index f = 0; f < num_faces; ++f) arrays.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  arrays.neighbors.resize(num_faces);
  return api::make_triangulation(Sites::view(sites), std::move(arrays), {.model = model}, {});
}

// Whether no two corners are one site.
bool is_face(const std::array<Point, 3>& p, Model model) {
  return !is_same_site(p[0], p[1], model) && !is_same_site(p[1], p[2], model) &&
         !is_same_site(p[2], p[0], model);
}

// The largest error in ulps over faces made by make(random), which returns three points. At
// the smallest distances many are equal.
template <class F>
double worst_error(Model model, std::uint64_t seed, F make) {
  constexpr std::size_t num_faces = 100;
  Random random(seed);
  std::vector<Point> sites;
  for (std::size_t f = 0; f < num_faces; ++f) {
    auto corners = make(random);
    while (!is_face(corners, model)) corners = make(random);
    sites.insert(sites.end(), corners.begin(), corners.end());
  }
  const Triangulation triangulation = loose_faces(sites, model);
  const auto centers = circumcenters(triangulation);
  const DualOracle oracle(triangulation, sites);
  double worst = 0;
  for (std::size_t f = 0; f < num_faces; ++f) {
    if (const auto exact = oracle.circumcenter(triangulation.faces()[f])) {
      worst = std::max(worst, distance_in_ulps(centers[f], *exact));
    }
  }
  return worst;
}

TEST(circumcenters, are_right_to_4_ulp_for_every_generator) {
  for_each_case(12, 2, [](const DualCase& c) {
    const auto centers = circumcenters(c.triangulation);
    const DualOracle oracle(c.triangulation, c.sites);
    ASSERT_EQ(centers.size(), c.triangulation.num_faces());
    for (std::size_t f = 0; f < centers.size(); ++f) {
      const auto exact = oracle.circumcenter(c.triangulation.faces()[f]);
      if (!exact) continue;
      EXPECT_LE(distance_in_ulps(centers[f], *exact), 4) << c.name << " face " << f;
    }
  });
}

TEST(circumcenters, are_right_to_4_ulp_at_any_distance_of_the_corners) {
  for (int exponent = 0; exponent <= 15; ++exponent) {
    const double distance = std::pow(10.0, -exponent);
    const auto near_triple = [&](Random& random) {
      const Point pole = random_direction(random);
      return std::array{random_near(random, pole, distance), random_near(random, pole, distance),
                        random_near(random, pole, distance)};
    };
    EXPECT_LE(worst_error(Model::projected, 1, near_triple), 4) << distance;
    EXPECT_LE(worst_error(Model::weighted, 2, near_triple), 4) << distance;
  }
}

TEST(circumcenters, are_right_to_4_ulp_for_slivers) {
  for (int exponent = 0; exponent <= 15; ++exponent) {
    const double flatness = std::pow(10.0, -exponent);
    const auto sliver = [&](Random& random) {
      const Point a = random_direction(random);
      const Point b = random_near(random, a, 1e-3);
      const Point middle = 0.5 * (a + b) + (flatness * 1e-3) * random_direction(random);
      return std::array{a, b, middle};
    };
    EXPECT_LE(worst_error(Model::projected, 3, sliver), 4) << flatness;
    EXPECT_LE(worst_error(Model::weighted, 4, sliver), 4) << flatness;
  }
}

TEST(circumcenters, are_right_to_4_ulp_for_one_near_pair) {
  for (int exponent = 0; exponent <= 15; ++exponent) {
    const auto needle = [&](Random& random) {
      const Point a = random_direction(random);
      return std::array{a, random_near(random, a, std::pow(10.0, -exponent)),
                        random_direction(random)};
    };
    EXPECT_LE(worst_error(Model::projected, 5, needle), 4) << exponent;
    EXPECT_LE(worst_error(Model::weighted, 6, needle), 4) << exponent;
  }
}

TEST(circumcenters, see_directions_that_differ_by_1e_300) {
  const auto triple = [](Random& random) {
    return std::array{Point{1, 1e-300 * random.signed_unit(), 1e-300 * random.signed_unit()},
                      Point{1, 1e-300 * random.signed_unit(), 0}, Point{1, 0, 1e-299}};
  };
  EXPECT_LE(worst_error(Model::projected, 7, triple), 4);
  EXPECT_LE(worst_error(Model::weighted, 8, triple), 4);
}

TEST(circumcenters, do_not_overflow) {
  const auto triple = [](Random& random) {
    return std::array{1e300 * random_direction(random), 1e300 * random_direction(random),
                      1e-300 * random_direction(random)};
  };
  EXPECT_LE(worst_error(Model::projected, 9, triple), 4);
  EXPECT_LE(worst_error(Model::weighted, 10, triple), 4);
}

TEST(circumcenters, of_the_octahedron_are_the_corners_of_the_cube) {
  const auto sites = octahedron();
  const auto centers = circumcenters(triangulated(sites));
  ASSERT_EQ(centers.size(), 8U);
  for (const Point& n : centers) {
    for (const double x : {n.x, n.y, n.z}) EXPECT_DOUBLE_EQ(std::abs(x), 1 / std::sqrt(3.0));
  }
}

TEST(circumcenters, do_not_depend_on_the_number_of_threads) {
  const auto sites = generator("uniform").make(20000, 1).sites;
  const Triangulation t = triangulated(sites);
  EXPECT_EQ(circumcenters(t, {.threads = 1}), circumcenters(t, {.threads = 4}));
}

// Arrays of another triangulation with sites in one place, or at the center, where a caller has put
// those that are viewed: no number of digits tells them apart.
TEST(circumcenters, refuse_vertices_in_one_place) {
  for (const Model model : {Model::projected, Model::weighted}) {
    const std::vector<Point> same(6, Point{0.5, 0.25, 0.75});
    EXPECT_THROW(circumcenters(loose_faces(same, model)), InvalidInput);
    EXPECT_THROW(circumcenters(loose_faces(std::vector<Point>(6), model)), InvalidInput);
    const Triangulation octahedral = delaunay(octahedron(), {.model = model});
    const Triangulation taken = Triangulation::from_arrays(
        same, {.dimension = 2, .faces = octahedral.faces(), .neighbors = octahedral.neighbors()},
        {.model = model});
    EXPECT_THROW(diagram(taken), InvalidInput);
  }
}

double perimeter(const Cells& cells, std::size_t site) {
  const auto ring = ring_of(cells, site);
  double sum = 0;
  for (std::size_t j = 0; j < ring.size(); ++j) {
    const Point step = cells.points[ring[j]] - cells.points[ring[(j + 1) % ring.size()]];
    sum += std::sqrt(dot_product(step, step));
  }
  return sum;
}

TEST(centroids, agree_with_long_numbers_for_every_generator) {
  for_each_case(12, 2, [](const DualCase& c) {
    const Cells diagram = cells(c.triangulation);
    const auto result = centroids(c.triangulation);
    const auto area = areas(c.triangulation);
    const DualOracle oracle(c.triangulation, c.sites);
    for (Index i = 0; i < c.sites.size(); ++i) {
      if (ring_of(diagram, i).empty()) {
        EXPECT_EQ(result[i], Point{}) << c.name;
        continue;
      }
      EXPECT_NEAR(dot_product(result[i], result[i]), 1, 1e-15) << c.name;
      // A thin cell's center is uncertain along it; rounding errors of the circumcenters exceed
      // the width of the thinnest.
      const double length = perimeter(diagram, i);
      if (area[i] <= 1e-12 * length) continue;
      const auto exact = polygon_centroid(oracle.ring(diagram, i));
      ASSERT_TRUE(exact.has_value()) << c.name;
      EXPECT_LE(distance_in_ulps(result[i], *exact), 16 * length * length / area[i])
          << c.name << " site " << i;
    }
  });
}

TEST(centroids, of_the_octahedron_are_its_corners) {
  const auto sites = octahedron();
  const auto result = centroids(triangulated(sites));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_LE(distance_in_ulps(result[i], to_real(sites[i])), 4);
  }
}

TEST(centroids, of_tiny_cells_are_within_a_few_ulp) {
  const DualCase c = make_case(generator("patch_1e_9"), 60, 1, Model::projected);
  const Cells diagram = cells(c.triangulation);
  const auto result = centroids(c.triangulation);
  const auto area = areas(c.triangulation);
  const DualOracle oracle(c.triangulation, c.sites);
  int num_tiny = 0;
  for (Index i = 0; i < c.sites.size(); ++i) {
    if (area[i] > 1e-15) continue;
    ++num_tiny;
    const auto exact = polygon_centroid(oracle.ring(diagram, i));
    EXPECT_LE(distance_in_ulps(result[i], exact.value()), 8);
  }
  EXPECT_GT(num_tiny, 20);
}

TEST(centroids, of_hemispheres_and_lunes) {
  const std::vector<Point> two = {{0, 0, 1}, {0, 0, -1}};
  EXPECT_EQ(centroids(triangulated(two)), two);
  const std::vector<Point> four = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const auto result = centroids(triangulated(four));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LE(distance_in_ulps(result[i], to_real(four[i])), 4);
}

TEST(centroids, of_the_whole_sphere_is_its_center) {
  const std::vector<Point> sites = {{1, 2, 3}};
  EXPECT_EQ(centroids(triangulated(sites)), std::vector<Point>{Point{}});
}

// A batch gives the same bits as a face alone, wherever in it the face is.
TEST(dual_normals, are_the_same_in_batches_and_alone) {
  for_each_case(100, 1, [](const DualCase& c) {
    if (c.triangulation.dimension() < 2) return;
    const dual::SplitSites sites(c.triangulation, 1);
    const auto centers = circumcenters(c.triangulation);
    for (Index f = 0; f < centers.size(); ++f) {
      const auto [i, j, k] = sites.corners(f);
      EXPECT_EQ(centers[f], dual::unit_normal(sites, i, j, k)) << c.name << " face " << f;
    }
  });
}

TEST(kites, are_left_out_where_an_area_is_large) {
  const std::vector<Point> sites = octahedron();
  const Triangulation t = triangulated(sites);
  const dual::SplitSites split_sites(t, 1);
  std::vector<Point> points(t.num_faces());
  std::vector<dual::Kites> kites(t.num_faces());
  // A corner of the octant is 54.7 degrees from its middle, but the tangent is above 1/16.
  EXPECT_TRUE(dual::unit_normals(split_sites, 0, points, kites.data()));
  for (const dual::Kites& k : kites) EXPECT_TRUE(dual::is_careful(k));
}

TEST(kites, of_all_faces_add_up_to_the_sphere) {
  const auto sites = generator("uniform").make(500, 3).sites;
  const Triangulation t = triangulated(sites);
  const dual::SplitSites split_sites(t, 1);
  std::vector<Point> points(t.num_faces());
  std::vector<dual::Kites> kites(t.num_faces());
  EXPECT_FALSE(dual::unit_normals(split_sites, 0, points, kites.data()));
  double sum = 0;
  for (const dual::Kites& k : kites) sum += k[0] + k[1] + k[2];
  EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-13);
}

}  // namespace
}  // namespace rondel::test
