// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts of the steps of a tessellation: springs along its edges, and sums of a density over its
// cells.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "meshing/density_nodes.h"
#include "meshing/edge_springs.h"
#include "meshing/scvt_levels.h"
#include "meshing/seeded_random.h"
#include "rondel/scvt.h"

namespace rondel::mesh {
namespace {

using Field = std::vector<TangentVector>;

double product(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

// Sites with all that their springs are made of.
struct SpringSites {
  explicit SpringSites(std::vector<Point> given, unsigned threads = 1)
      : sites(std::move(given)),
        axes(sites.size()),
        sums(sites.size()),
        surface(threads),
        springs(threads) {
    std::ranges::transform(sites, axes.begin(), far_axis);
    EXPECT_TRUE(surface.update(sites));
    (void)CentroidalEnergy(nullptr, threads)(surface, sites, axes, sums);
    springs.measure(surface, sites, sums);
  }

  Field yielded(Field forces) {
    springs.yield(sites, axes, forces);
    return forces;
  }
  // Of the energy where each site is moved by that many times the field.
  [[nodiscard]] Field gradient(const Field& field, double step) const {
    std::vector<Point> there;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      there.push_back(moved(sites[i], axes[i], {step * field[i].u, step * field[i].v}));
    }
    KineticDelaunay moved_surface(1);
    EXPECT_TRUE(moved_surface.update(there));
    std::vector<SiteSums> moved_sums(sites.size());
    (void)CentroidalEnergy(nullptr, 1)(moved_surface, there, axes, moved_sums);
    Field result;
    for (const SiteSums& s : moved_sums) result.push_back(s.gradient);
    return result;
  }

  std::vector<Point> sites;
  std::vector<std::uint8_t> axes;
  std::vector<SiteSums> sums;
  KineticDelaunay surface;
  EdgeSprings springs;
};

Field random_field(std::size_t size, std::uint64_t seed) {
  SeededRandom random(seed);
  Field field(size);
  for (TangentVector& v : field) v = {random() - 0.5, random() - 0.5};
  return field;
}

// Also of random sites, where the energy's own second derivative is negative in many directions.
TEST(edge_springs, what_forces_do_is_symmetric_and_positive) {
  SpringSites made(in_spatial_order(sampled_sites(3000, nullptr, 3), 1));
  for (std::uint64_t seed = 1; seed < 10; ++seed) {
    const Field a = random_field(3000, seed);
    const Field b = random_field(3000, 100 + seed);
    const Field of_a = made.yielded(a);
    const Field of_b = made.yielded(b);
    EXPECT_GT(product(a, of_a), 0);
    EXPECT_NEAR(product(a, of_b), product(b, of_a), 1e-6 * product(a, of_a));
  }
}

// A wave of eight spacings, and the forces that hold it, by finite differences of the energy's gradient.
TEST(edge_springs, forces_of_a_wave_give_the_wave_back) {
  SpringSites made(scvt({.count = 2562}).sites);
  Field wave;
  for (std::size_t i = 0; i < made.sites.size(); ++i) {
    const TangentFrame frame = frame_at(made.sites[i], made.axes[i]);
    const double height = std::sin(11 * made.sites[i].z);
    wave.push_back({height * frame.u.z, height * frame.v.z});
  }
  constexpr double step = 1e-5;
  const Field ahead = made.gradient(wave, step);
  const Field behind = made.gradient(wave, -step);
  Field left = wave;
  Field left_by_lloyd = wave;
  Field forces;
  for (std::size_t i = 0; i < wave.size(); ++i) {
    forces.push_back(
        {(ahead[i].u - behind[i].u) / (2 * step), (ahead[i].v - behind[i].v) / (2 * step)});
    const double lloyd = 1 / (2 * made.sums[i].mass);
    left_by_lloyd[i] = {wave[i].u - lloyd * forces[i].u, wave[i].v - lloyd * forces[i].v};
  }
  const Field found = made.yielded(forces);
  for (std::size_t i = 0; i < wave.size(); ++i) {
    left[i] = {wave[i].u - found[i].u, wave[i].v - found[i].v};
  }
  const double square = product(wave, wave);
  EXPECT_LT(product(left, left), 0.1 * square);
  EXPECT_GT(product(left_by_lloyd, left_by_lloyd), 0.6 * square);
}

TEST(edge_springs, bytes_do_not_depend_on_threads) {
  const std::vector<Point> sites = in_spatial_order(sampled_sites(9000, nullptr, 5), 1);
  const Field forces = random_field(9000, 6);
  const Field one = SpringSites(sites, 1).yielded(forces);
  const Field three = SpringSites(sites, 3).yielded(forces);
  EXPECT_EQ(std::memcmp(one.data(), three.data(), one.size() * sizeof(TangentVector)), 0);
}

// The rule node by node, with the density that the size function gives at each.
CellSums sums_of_triangle(const SizeFunction& size, const Vector& z, const Vector& a,
                          const Vector& b) {
  CellSums sums{};
  const std::array<std::array<double, 2>, 2> orbits = {
      {{0.223381589678011, 0.445948490915965}, {0.109951743655322, 0.091576213509771}}};
  for (const auto& [weight, near] : orbits) {
    const double far = 1 - 2 * near;
    const std::array<std::array<double, 3>, 3> nodes = {
        {{near, near, far}, {near, far, near}, {far, near, near}}};
    for (const auto& node : nodes) {
      const Vector p = node[0] * z + node[1] * (z + a) + node[2] * (z + b);
      const double length = norm(p);
      const double area = weight * 0.5 * det(z, a, b) / (length * length * length);
      const Vector away = p / length - z;
      const double mass = area * size.density(exact::to_point(p));
      sums.area += area;
      sums.mass += mass;
      sums.moment = sums.moment + mass * away;
      sums.energy += mass * dot(away, away);
    }
  }
  return sums;
}

// Triangles everywhere: on all faces of the raster's cube, across its edges, small ones and large ones.
TEST(density_nodes, sums_are_those_of_the_nodes_one_by_one) {
  const SizeFunction size = SizeFunction::from_function(
      [](std::span<const Point> places, std::span<double> out) {
        for (std::size_t i = 0; i < places.size(); ++i) {
          out[i] = 0.1 + 0.03 * places[i].x + 0.04 * places[i].y * places[i].z;
        }
      },
      16);
  DensityNodes nodes(size);
  SeededRandom random(8);
  const std::vector<Point> sites = sampled_sites(50 * DensityNodes::lanes, nullptr, 4);
  for (std::size_t begin = 0; begin < sites.size(); begin += DensityNodes::lanes) {
    std::array<std::array<Vector, 3>, DensityNodes::lanes> triangles;
    for (std::size_t k = 0; k < DensityNodes::lanes; ++k) {
      const double length = k % 2 == 0 ? 0.01 : 0.5;
      const Point& z = sites[begin + k];
      const auto corner = [&] {
        const Point to = moved(z, far_axis(z), {length * random(), length * random()});
        return exact::to_vector(to) - exact::to_vector(z);
      };
      triangles[k] = {exact::to_vector(z), corner(), corner()};
      nodes.set(k, triangles[k][0], triangles[k][1], triangles[k][2]);
    }
    nodes.integrate();
    for (std::size_t k = 0; k < DensityNodes::lanes; ++k) {
      const auto& [z, a, b] = triangles[k];
      const CellSums wanted = sums_of_triangle(size, z, a, b);
      const CellSums found = nodes[k];
      const double allowed = 1e-13 * std::abs(wanted.area);
      EXPECT_NEAR(found.area, wanted.area, allowed);
      EXPECT_NEAR(found.mass, wanted.mass, allowed);
      EXPECT_NEAR(found.energy, wanted.energy, allowed);
      EXPECT_NEAR(norm(found.moment - wanted.moment), 0, allowed);
    }
  }
}

}  // namespace
}  // namespace rondel::mesh
