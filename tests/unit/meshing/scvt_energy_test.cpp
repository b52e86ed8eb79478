// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/scvt_energy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <set>

#include "meshing/scvt_levels.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/mesh.h"
#include "rondel/mesh_quality.h"
#include "rondel/scvt.h"

namespace rondel::mesh {
namespace {

std::vector<std::uint8_t> axes_of(const std::vector<Point>& sites) {
  std::vector<std::uint8_t> axes(sites.size());
  std::ranges::transform(sites, axes.begin(), far_axis);
  return axes;
}

// A spacing that varies by a factor of three.
SizeFunction smooth_size() {
  return SizeFunction::from_function(
      [](std::span<const Point> places, std::span<double> out) {
        for (std::size_t i = 0; i < places.size(); ++i) out[i] = 0.1 + 0.05 * places[i].x;
      },
      512);
}

struct Evaluated {
  EnergyReport report;
  std::vector<SiteSums> sums;
};

Evaluated evaluate(const std::vector<Point>& sites, const SizeFunction* size,
                   const std::vector<std::uint8_t>& axes) {
  KineticDelaunay surface(1);
  EXPECT_TRUE(surface.update(sites));
  Evaluated result;
  result.sums.resize(sites.size());
  result.report = CentroidalEnergy(size, 1)(surface, sites, axes, result.sums);
  return result;
}

TEST(scvt_energy, closed_form_and_quadrature_of_constant_density_agree) {
  const SizeFunction constant = SizeFunction::constant(0.1, 1);
  for (const std::size_t n : {std::size_t{500}, std::size_t{5000}}) {
    const std::vector<Point> sites = sampled_sites(n, nullptr, 7);
    const auto axes = axes_of(sites);
    const Evaluated exact = evaluate(sites, nullptr, axes);
    const Evaluated nodes = evaluate(sites, &constant, axes);
    // The rule's error falls with the sixth power of the spacing.
    const double error = n == 500 ? 3e-6 : 2e-8;
    EXPECT_NEAR(nodes.report.energy / exact.report.energy, 1, error);
    const double largest = exact.report.largest_offset;
    EXPECT_NEAR(nodes.report.largest_offset, largest, 0.01 * largest);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(nodes.sums[i].mass, exact.sums[i].mass, 0.01 * exact.sums[i].mass);
    }
  }
}

// Of short arcs, whose sines are replaced by a series, against another formula.
TEST(scvt_energy, closed_form_of_many_sites_is_that_of_the_report_on_quality) {
  const std::vector<Point> sites = sampled_sites(40000, nullptr, 3);
  const double energy = evaluate(sites, nullptr, axes_of(sites)).report.energy;
  const double wanted = quality(make_mesh(delaunay(sites))).energy;
  EXPECT_NEAR(energy_over_hexagons(energy, sites.size()) / wanted, 1, 1e-9);
}

// What the energy of constant density should be, from the areas and the centers of mass of the diagram,
// which know nothing of this layer.
TEST(scvt_energy, offsets_are_those_to_the_centroids_of_the_diagram) {
  const std::vector<Point> sites = sampled_sites(2000, nullptr, 3);
  const Triangulation triangulation = delaunay(sites);
  const std::vector<Point> centers = centroids(triangulation);
  const std::vector<double> cell_areas = areas(triangulation);
  double mean = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto z = exact::to_vector(sites[i]);
    const auto c = exact::to_vector(centers[i]);
    mean += norm(cross(z, c)) / dot(z, c) / std::sqrt(2 * cell_areas[i] / std::sqrt(3.0));
  }
  mean /= 2000;
  // The mass of a cell is less than its area by half of its energy.
  EXPECT_NEAR(evaluate(sites, nullptr, axes_of(sites)).report.mean_offset, mean, 1e-3 * mean);
}

TEST(scvt_energy, gradient_is_the_slope_of_the_energy) {
  const SizeFunction size = smooth_size();
  for (const SizeFunction* density : {static_cast<const SizeFunction*>(nullptr), &size}) {
    const std::vector<Point> sites = sampled_sites(300, density, 5);
    const auto axes = axes_of(sites);
    const Evaluated here = evaluate(sites, density, axes);
    // A rule of degree 4 knows the density up to its fourth derivatives.
    const double allowed = density == nullptr ? 1e-5 : 3e-4;
    for (std::size_t i = 0; i < sites.size(); i += 10) {
      for (const TangentVector& unit : {TangentVector{1, 0}, TangentVector{0, 1}}) {
        constexpr double step = 1e-4;
        std::vector<Point> ahead = sites;
        std::vector<Point> behind = sites;
        ahead[i] = moved(sites[i], axes[i], {step * unit.u, step * unit.v});
        behind[i] = moved(sites[i], axes[i], {-step * unit.u, -step * unit.v});
        const double slope = (evaluate(ahead, density, axes).report.energy -
                              evaluate(behind, density, axes).report.energy) /
                             (2 * step);
        const SiteSums& sums = here.sums[i];
        EXPECT_NEAR(slope, dot(sums.gradient, unit),
                    2 * sums.mass * sums.spacing * allowed + 1e-10);
      }
    }
  }
}

std::set<Triple> faces_of(const KineticDelaunay& surface) {
  return {surface.faces().begin(), surface.faces().end()};
}

TEST(kinetic_delaunay, mended_triangulation_equals_one_built_anew_bit_for_bit) {
  std::vector<Point> sites = in_spatial_order(sampled_sites(4000, nullptr, 11), 1);
  const auto axes = axes_of(sites);
  KineticDelaunay moving(2);
  ASSERT_TRUE(moving.update(sites));
  for (int step = 0; step < 20; ++step) {
    // The longest steps turn faces over, and have them built anew.
    const double length = step < 15 ? 1e-4 * step : 0.02;
    const std::vector<Point> shifts =
        sampled_sites(4000, nullptr, static_cast<std::uint64_t>(step));
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const Point& shift = shifts[i * 37 % sites.size()];
      sites[i] = moved(sites[i], axes[i], {length * shift.x, length * shift.y});
    }
    ASSERT_TRUE(moving.update(sites));
    KineticDelaunay built(1);
    ASSERT_TRUE(built.update(sites));
    EXPECT_EQ(faces_of(moving), faces_of(built));
    std::vector<SiteSums> moved_sums(sites.size());
    std::vector<SiteSums> built_sums(sites.size());
    const CentroidalEnergy energy(nullptr, 2);
    EXPECT_EQ(energy(moving, sites, axes, moved_sums).energy,
              energy(built, sites, axes, built_sums).energy);
    EXPECT_EQ(std::memcmp(moved_sums.data(), built_sums.data(), sites.size() * sizeof(SiteSums)),
              0);
  }
  EXPECT_GT(moving.num_flips(), 300U);
  EXPECT_LT(moving.num_builds(), 12U);
}

// Sites of a cube's lattice: four on a circle everywhere.
TEST(kinetic_delaunay, ties_are_broken_as_a_build_breaks_them) {
  std::vector<Point> sites;
  for (int face = 0; face < 6; ++face) {
    for (int i = -9; i <= 9; i += 2) {
      for (int j = -9; j <= 9; j += 2) {
        const double s = face % 2 == 0 ? 10 : -10;
        const Point p = face / 2 == 0   ? Point{s, double(i), double(j)}
                        : face / 2 == 1 ? Point{double(i), s, double(j)}
                                        : Point{double(i), double(j), s};
        sites.push_back(exact::to_point(normalized(exact::to_vector(p))));
      }
    }
  }
  const std::vector<Point> lattice = sites;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites[i] = moved(sites[i], far_axis(sites[i]), {i % 2 == 0 ? 1e-3 : -1e-3, 1e-3});
  }
  KineticDelaunay moving(1);
  ASSERT_TRUE(moving.update(sites));
  ASSERT_TRUE(moving.update(lattice));
  EXPECT_EQ(moving.num_builds(), 1U);
  KineticDelaunay built(1);
  ASSERT_TRUE(built.update(lattice));
  EXPECT_EQ(faces_of(moving), faces_of(built));
}

TEST(kinetic_delaunay, sites_without_a_triangulation_around_the_center_are_refused) {
  KineticDelaunay surface(1);
  std::vector<Point> sites = icosahedron();
  EXPECT_TRUE(surface.update(sites));
  sites[3] = sites[4];
  EXPECT_FALSE(surface.update(sites));
  const std::vector<Point> octant = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0.8, 0}};
  EXPECT_FALSE(surface.update(octant));
}

}  // namespace
}  // namespace rondel::mesh
