// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The report on quality against numbers that are known, and against sums by other means.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "rondel/error.h"
#include "rondel/mesh_quality.h"
#include "unit/meshing/support.h"

namespace rondel::test {
namespace {

using mesh::Quality;
using mesh::VoronoiMesh;

TEST(mesh_quality, an_icosahedron_is_perfect_but_for_its_pentagons) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(icosahedral_sites(0)), {.radius = 7});
  const Quality quality = mesh::quality(arrays);
  EXPECT_EQ(quality.sides, (std::vector<std::uint64_t>{0, 0, 0, 0, 0, 12}));
  EXPECT_LT(quality.max_centroid_offset.value, 1e-15);
  EXPECT_NEAR(quality.min_angle_deg.value, 60, 1e-12);
  EXPECT_NEAR(quality.max_angle_deg.value, 60, 1e-12);
  EXPECT_EQ(quality.num_obtuse, 0U);
  EXPECT_EQ(quality.share_40_to_80_deg, 1);
  // The dodecahedron's edge over the icosahedron's.
  const double edge = 2 * std::asin(2 / (std::sqrt(3.0) * (1 + std::sqrt(5.0))));
  EXPECT_NEAR(quality.min_edge_ratio.value, edge / std::atan(2.0), 1e-14);
  EXPECT_NEAR(quality.min_side_ratio.value, 1, 1e-14);
  EXPECT_NEAR(quality.max_distance_ratio.value, 1, 1e-14);
  EXPECT_LT(quality.max_gradient.value, 1e-14);
  EXPECT_LT(quality.max_staggering.value, 1e-14);
  EXPECT_LT(quality.kite_sum_error, 1e-14);
  EXPECT_LT(quality.cell_sum_error, 1e-14);
  EXPECT_LT(quality.max_kite_error, 1e-14);
  EXPECT_NEAR(quality.min_spacing, mesh::spacing_of(std::numbers::pi / 3), 1e-14);
}

// The integral of |x - z|^2 by the middles of the pieces of many small triangles.
double energy_by_points(const VoronoiMesh& arrays) {
  long double total = 0;
  constexpr int steps = 24;
  for (std::size_t v = 0; v < arrays.num_vertices(); ++v) {
    const LongPoint center = to_long(arrays.vertex_points[v]);
    for (std::size_t i = 0; i < 3; ++i) {
      const LongPoint z = to_long(arrays.cell_points[arrays.cells_on_vertex[v][i]]);
      for (std::size_t j = 1; j < 3; ++j) {
        const LongPoint other = to_long(arrays.cell_points[arrays.cells_on_vertex[v][(i + j) % 3]]);
        const LongPoint middle = unit(sum(z, other));
        // Negative where the vertex lies beyond the edge between z and the other site.
        const long double turn = inner(z, outer(middle, center)) * (j == 1 ? 1 : -1);
        const long double side = turn > 0 ? 1 : -1;
        for (int a = 0; a < steps; ++a) {
          for (int b = 0; b < steps - a; ++b) {
            for (int up = 0; up < (a + b < steps - 1 ? 2 : 1); ++up) {
              const auto corner = [&](int p, int q) {
                const long double s = static_cast<long double>(p) / steps;
                const long double t = static_cast<long double>(q) / steps;
                return unit(sum(times(1 - s - t, z), sum(times(s, middle), times(t, center))));
              };
              const LongPoint p = corner(a + up, b + up);
              const LongPoint q = corner(a + 1, b);
              const LongPoint r = corner(a, b + 1);
              const long double area = std::abs(signed_area(p, q, r));
              long double mean = 0;
              for (const auto& [e, f] : {std::pair{p, q}, std::pair{q, r}, std::pair{r, p}}) {
                mean += (2 - 2 * inner(unit(sum(e, f)), z)) / 3;
              }
              total += side * area * mean;
            }
          }
        }
      }
    }
  }
  return static_cast<double>(total);
}

TEST(mesh_quality, energy_is_the_integral_of_the_squared_distance) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(icosahedral_sites(1)));
  const Quality quality = mesh::quality(arrays);
  const double sphere = 4 * std::numbers::pi;
  const double of_hexagons = sphere * sphere / 42 * 5 / (18 * std::sqrt(3.0));
  EXPECT_NEAR(quality.energy, energy_by_points(arrays) / of_hexagons, 1e-6);
}

TEST(mesh_quality, the_limit_of_energy_is_that_of_hexagons) {
  const double fine = mesh::quality(mesh::make_mesh(delaunay(icosahedral_sites(5)))).energy;
  EXPECT_GT(fine, 1);
  EXPECT_LT(fine, 1.05);
  const double random = mesh::quality(mesh::make_mesh(delaunay(mesh_sites(10000, 8)))).energy;
  EXPECT_GT(random, 1.5);
}

TEST(mesh_quality, random_sites_show_what_is_wrong_and_where) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(5000, 9)));
  const Quality quality = mesh::quality(arrays);
  const auto e = quality.min_edge_ratio.where;
  EXPECT_EQ(quality.min_edge_ratio.value, arrays.vertex_distances[e] / arrays.cell_distances[e]);
  for (std::size_t i = 0; i < arrays.num_edges(); ++i) {
    EXPECT_LE(quality.min_edge_ratio.value, arrays.vertex_distances[i] / arrays.cell_distances[i]);
  }
  // A triangle is obtuse where the circumcenter lies beyond an edge, which makes a kite's half negative.
  EXPECT_GT(quality.num_obtuse, 1000U);
  const mesh::CellQuality cells = mesh::cell_quality(arrays);
  EXPECT_EQ(quality.max_centroid_offset.value, *std::ranges::max_element(cells.centroid_offset));
  EXPECT_EQ(quality.max_gradient.value, *std::ranges::max_element(cells.gradient));
  EXPECT_EQ(quality.min_edge_ratio.value, *std::ranges::min_element(cells.edge_ratio));
  std::uint64_t angles = 0;
  for (const std::uint64_t count : quality.angles_deg.counts) angles += count;
  EXPECT_EQ(angles, 3 * arrays.num_vertices());
}

// The sums of several pieces.
TEST(mesh_quality, shares_and_spacings_are_those_of_all_cells) {
  const std::vector<Point> sites = mesh_sites(9000, 12);
  std::vector<double> density;
  for (const Point& p : sites) density.push_back(0.6 + 0.4 * p.x);
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(sites), {.density = density});
  const Quality quality = mesh::quality(arrays);
  std::size_t inside = 0;
  for (const Triple& cells : arrays.cells_on_vertex) {
    for (std::size_t i = 0; i < 3; ++i) {
      const LongPoint a = to_long(sites[cells[i]]);
      const LongPoint b = sum(to_long(sites[cells[(i + 1) % 3]]), times(-1, a));
      const LongPoint c = sum(to_long(sites[cells[(i + 2) % 3]]), times(-1, a));
      const long double degrees = arc(b, c) * 180 / std::numbers::pi_v<long double>;
      inside += degrees >= 40 && degrees <= 80 ? 1U : 0U;
    }
  }
  EXPECT_EQ(quality.share_40_to_80_deg,
            static_cast<double>(inside) / (3 * static_cast<double>(arrays.num_vertices())));
  std::vector<double> spacings;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    spacings.push_back(mesh::spacing_of(arrays.cell_areas[i]) * std::pow(density[i], 0.25));
  }
  std::ranges::sort(spacings);
  EXPECT_NEAR(quality.spacing_range[0], spacings[450] / spacings[4500], 1e-14);
  EXPECT_NEAR(quality.spacing_range[1], spacings[8549] / spacings[4500], 1e-14);
}

// Also where the equal values are in several pieces.
TEST(mesh_quality, the_first_of_equal_values_is_named) {
  VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(3000, 13)));
  std::ranges::fill(arrays.vertex_distances, 1);
  std::ranges::fill(arrays.cell_distances, 2);
  std::ranges::fill(arrays.cell_areas, 0.01);
  const Quality quality = mesh::quality(arrays);
  EXPECT_EQ(quality.min_edge_ratio.value, 0.5);
  EXPECT_EQ(quality.min_edge_ratio.where, 0U);
  EXPECT_EQ(quality.max_gradient.value, 0);
  EXPECT_EQ(quality.max_gradient.where, 0U);
}

TEST(mesh_quality, threads_do_not_change_a_bit) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(30000, 10)));
  EXPECT_EQ(mesh::quality_json(mesh::quality(arrays, {.threads = 1})),
            mesh::quality_json(mesh::quality(arrays, {.threads = 2})));
}

TEST(mesh_quality, reports_have_every_number) {
  const std::vector<double> density(200, 0.5);
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(200, 11)), {.density = density});
  const Quality quality = mesh::quality(arrays);
  const auto json = nlohmann::json::parse(mesh::quality_json(quality));
  EXPECT_TRUE(json["energy"].is_null());
  EXPECT_EQ(json["min_edge_ratio"]["value"], quality.min_edge_ratio.value);
  EXPECT_EQ(json["max_gradient"]["where"], quality.max_gradient.where);
  EXPECT_EQ(json["num_cells"], 200);
  EXPECT_EQ(mesh::quality_value(quality, "min-dv-dc"), quality.min_edge_ratio.value);
  EXPECT_EQ(mesh::quality_value(quality, "max-gradient"), quality.max_gradient.value);
  EXPECT_THROW(mesh::quality_value(quality, "beauty"), InvalidInput);
  EXPECT_NE(mesh::quality_text(quality).find("200 cells, 594 edges, 396 vertices"),
            std::string::npos);
  const std::string picture = mesh::quality_picture(arrays, quality, 3);
  std::size_t circles = 0;
  for (std::size_t at = 0; (at = picture.find("<circle", at)) != std::string::npos; ++at) ++circles;
  EXPECT_EQ(circles, 9U);
}

}  // namespace
}  // namespace rondel::test
