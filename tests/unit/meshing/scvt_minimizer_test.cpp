// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/scvt_minimizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "exact/vector.h"
#include "meshing/scvt_levels.h"
#include "meshing/scvt_repair.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_size.h"
#include "rondel/point_sets.h"

namespace rondel::mesh {
namespace {

constexpr double eps = 1e-12;

// The corners of an octahedron, each moved a little: together they go back to an octahedron.
//
//         z
//       / | \        The energy is the integral of the squared distance to the nearest site. It is least where each site is
//     -x--+--x       the center of mass of its cell, and the octahedron is such a place.
//       \ | /
//        -z
std::vector<Point> moved_octahedron(double by) {
  std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  double turn = 0;
  for (Point& p : sites) {
    turn += 1;
    p = normalized(p + by * Point{std::sin(turn), std::cos(3 * turn), std::sin(2 * turn)});
  }
  return sites;
}

// Expects that the sites are perpendicular or opposite to each other.
void expect_octahedron(const std::vector<Point>& sites, double error) {
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double cosine = std::abs(dot(sites[i], sites[k]));
      EXPECT_NEAR(cosine, i == k + 3 ? 1 : 0, error) << i << ' ' << k;
    }
  }
}

TEST(scvt_minimizer, has_nothing_to_do_where_sites_are_centers_of_mass) {
  const CentroidalEnergy energy(nullptr, 1);
  Minimizer minimizer(moved_octahedron(0), energy, 1);
  const auto never = [](int, const EnergyReport&) {
    ADD_FAILURE() << "a step";
    return true;
  };
  EXPECT_EQ(minimizer.run({.mean_offset = eps, .largest_offset = eps, .iterations = 9}, never),
            MinimizerEnd::converged);
  EXPECT_EQ(minimizer.iterations(), 0);
  EXPECT_EQ(minimizer.sites(), moved_octahedron(0));
  EXPECT_EQ(minimizer.surface().faces().size(), 8U);
  EXPECT_LT(minimizer.report().largest_offset, eps);
}

TEST(scvt_minimizer, moves_sites_to_an_octahedron) {
  const CentroidalEnergy energy(nullptr, 1);
  for (const bool lloyd : {false, true}) {
    Minimizer minimizer(moved_octahedron(0.3), energy, 1);
    double last = minimizer.report().energy;
    const auto seen = [&](int iteration, const EnergyReport& report) {
      EXPECT_EQ(iteration, minimizer.iterations());
      EXPECT_LE(report.energy, last + energy.noise(last));
      last = report.energy;
      return true;
    };
    const MinimizerLimits limits{
        .mean_offset = 1e-9, .largest_offset = 1e-9, .iterations = 200, .lloyd = lloyd};
    EXPECT_EQ(minimizer.run(limits, seen), MinimizerEnd::converged);
    EXPECT_GT(minimizer.iterations(), 2);
    EXPECT_LE(minimizer.report().largest_offset, 1e-9);
    expect_octahedron(minimizer.sites(), 1e-7);
  }
}

TEST(scvt_minimizer, ends_as_its_limits_say) {
  const CentroidalEnergy energy(nullptr, 1);
  const auto go_on = [](int, const EnergyReport&) { return true; };
  Minimizer three(moved_octahedron(0.3), energy, 1);
  EXPECT_EQ(three.run({.iterations = 3}, go_on), MinimizerEnd::iterations);
  EXPECT_EQ(three.iterations(), 3);
  EXPECT_EQ(three.run({.iterations = 0}, go_on), MinimizerEnd::iterations);
  EXPECT_EQ(three.iterations(), 3);
  // The second call goes on with the count of steps.
  EXPECT_EQ(three.run({.iterations = 2}, go_on), MinimizerEnd::iterations);
  EXPECT_EQ(three.iterations(), 5);
  Minimizer stopped(moved_octahedron(0.3), energy, 1);
  EXPECT_EQ(stopped.run({.iterations = 9}, [](int step, const EnergyReport&) { return step < 2; }),
            MinimizerEnd::stopped);
  EXPECT_EQ(stopped.iterations(), 2);
  // A change of the energy by less than all of it ends the work after one step.
  Minimizer change(moved_octahedron(0.3), energy, 1);
  EXPECT_EQ(change.run({.energy_change = 1, .iterations = 9}, go_on), MinimizerEnd::converged);
  EXPECT_EQ(change.iterations(), 1);
  EXPECT_THROW(Minimizer({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, energy, 1), InvalidInput);
}

// The sites +x and -z stay, bit by bit, and the others make an octahedron with them as well as they can.
TEST(scvt_minimizer, leaves_fixed_sites_where_they_are) {
  const CentroidalEnergy energy(nullptr, 1);
  std::vector<Point> sites = moved_octahedron(0.3);
  sites[0] = {1, 0, 0};
  sites[5] = {0, 0, -1};
  const auto go_on = [](int, const EnergyReport&) { return true; };
  for (const bool lloyd : {false, true}) {
    Minimizer minimizer(sites, energy, 1, {1, 0, 0, 0, 0, 1});
    minimizer.run({.mean_offset = 1e-9, .largest_offset = 1e-9, .iterations = 200, .lloyd = lloyd},
                  go_on);
    EXPECT_EQ(minimizer.sites()[0], sites[0]);
    EXPECT_EQ(minimizer.sites()[5], sites[5]);
    expect_octahedron(minimizer.sites(), 1e-6);
  }
}

// Nearly all of the mass is in the north, where the sites go until one more step would leave the center of the sphere outside
// of them. A step to the centroids is tried before the minimizer gives up, so another one leads no further.
TEST(scvt_minimizer, is_stuck_only_where_a_step_to_the_centroids_is) {
  const SizeFunction size = SizeFunction::from_function(
      [](std::span<const Point> places, std::span<double> out) {
        for (std::size_t i = 0; i < places.size(); ++i) out[i] = 0.1 * std::exp(-1.5 * places[i].z);
      },
      64);
  const CentroidalEnergy energy(&size, 1);
  const auto go_on = [](int, const EnergyReport&) { return true; };
  for (std::uint64_t seed = 1; seed < 8; ++seed) {
    Minimizer minimizer(sampled_sites(20, nullptr, seed), energy, 1);
    const double before = minimizer.report().energy;
    EXPECT_EQ(minimizer.run({.iterations = 500}, go_on), MinimizerEnd::stuck);
    EXPECT_GT(minimizer.iterations(), 1);
    EXPECT_LT(minimizer.report().energy, before);
    EXPECT_EQ(minimizer.surface().faces().size(), 36U);
    Minimizer again(minimizer.sites(), energy, 1);
    EXPECT_EQ(again.run({.iterations = 1, .lloyd = true}, go_on), MinimizerEnd::stuck);
  }
}

// The repair alone, of sites with one thing wrong.

using exact::to_point;
using exact::to_vector;

// Between 0.13 and 0.17 long are the edges of this icosahedral grid.
constexpr unsigned levels = 3;
constexpr double longest_edge = 0.17;

double farthest_move(const std::vector<Point>& before, const std::vector<Point>& after) {
  double most = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    most = std::max(most, norm(to_vector(before[i]) - to_vector(after[i])));
  }
  return most;
}

TEST(scvt_repair, an_obtuse_triangle_without_a_short_edge_is_made_acute) {
  std::vector<Point> sites = icosahedral_points(levels);
  const Triangulation triangulation = delaunay(sites);
  // A corner comes so near to the opposite edge that its angle is above 90 degrees.
  const Triple face = triangulation.faces()[100];
  const auto middle = 0.5 * (to_vector(sites[face[1]]) + to_vector(sites[face[2]]));
  const auto apex = to_vector(sites[face[0]]);
  sites[face[0]] = to_point(normalized(apex + 0.4 * (middle - apex)));
  const std::vector<Point> start = sites;
  const ScvtRepair done = repair(sites, {}, 1);
  EXPECT_EQ(done.before.short_edges, 0U);
  EXPECT_GT(done.before.obtuse_triangles, 0U);
  EXPECT_EQ(done.after.obtuse_triangles, 0U);
  EXPECT_GT(done.moved, 0U);
  EXPECT_LT(farthest_move(start, sites), 0.15 * longest_edge);
}

// Sites in the middle of triangles get three or four neighbors, which takes more to mend than is allowed.
TEST(scvt_repair, sites_move_no_farther_than_they_may) {
  std::vector<Point> sites = icosahedral_points(levels);
  const Triangulation triangulation = delaunay(sites);
  for (std::size_t f = 0; f < triangulation.num_faces(); f += 60) {
    const Triple face = triangulation.faces()[f];
    sites.push_back(to_point(normalized(1.01 * to_vector(sites[face[0]]) +
                                        to_vector(sites[face[1]]) + to_vector(sites[face[2]]))));
  }
  const std::vector<Point> start = sites;
  const ScvtRepair done = repair(sites, {}, 1);
  EXPECT_GT(done.before.odd_cells, 10U);
  EXPECT_LE(done.after.odd_cells, done.before.odd_cells);
  EXPECT_LT(farthest_move(start, sites), 0.15 * 1.3 * longest_edge);
}

}  // namespace
}  // namespace rondel::mesh
