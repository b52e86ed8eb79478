// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The arrays of a mesh against its definition: all triples of sites, one by one, and areas and lengths in
// long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "rondel/error.h"
#include "unit/meshing/support.h"

namespace rondel::test {
namespace {

using mesh::VoronoiMesh;

constexpr long double sphere_area = 4 * std::numbers::pi_v<long double>;

// The triangles without a site in their circle, each as the set of its corners.
std::set<std::set<Index>> empty_triples(const std::vector<Point>& sites) {
  std::set<std::set<Index>> result;
  const auto n = static_cast<Index>(sites.size());
  for (Index a = 0; a < n; ++a) {
    for (Index b = a + 1; b < n; ++b) {
      for (Index c = b + 1; c < n; ++c) {
        const LongPoint p = to_long(sites[a]);
        const LongPoint normal =
            outer(sum(to_long(sites[b]), times(-1, p)), sum(to_long(sites[c]), times(-1, p)));
        bool is_below = true;
        bool is_above = true;
        for (Index d = 0; d < n; ++d) {
          if (d == a || d == b || d == c) continue;
          const long double side = inner(normal, sum(to_long(sites[d]), times(-1, p)));
          is_below = is_below && side < 0;
          is_above = is_above && side > 0;
        }
        if (is_below || is_above) result.insert({a, b, c});
      }
    }
  }
  return result;
}

TEST(mesh_arrays, cells_and_vertices_are_those_of_all_empty_circles) {
  const auto sites = mesh_sites(60, 1);
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(sites));
  std::set<std::set<Index>> triples;
  for (const Triple& cells : arrays.cells_on_vertex) triples.insert({cells.begin(), cells.end()});
  EXPECT_EQ(triples, empty_triples(sites));
  EXPECT_EQ(arrays.num_edges(), 3 * sites.size() - 6);
  // Every pair of cells of a triangle is an edge, once.
  std::set<std::set<Index>> pairs;
  for (const auto& [a, b] : arrays.cells_on_edge) {
    EXPECT_LT(a, b);
    EXPECT_TRUE(pairs.insert({a, b}).second);
  }
  for (const Triple& cells : arrays.cells_on_vertex) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(pairs.contains({cells[i], cells[(i + 1) % 3]}));
    }
  }
}

TEST(mesh_arrays, lists_run_counterclockwise_and_fit_together) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(500, 2)));
  for (Index cell = 0; cell < arrays.num_cells(); ++cell) {
    const LongPoint z = to_long(arrays.cell_points[cell]);
    for (std::uint64_t at = arrays.edges_on_cell.offsets[cell];
         at < arrays.edges_on_cell.offsets[cell + 1]; ++at) {
      const std::uint64_t next = at + 1 < arrays.edges_on_cell.offsets[cell + 1]
                                     ? at + 1
                                     : arrays.edges_on_cell.offsets[cell];
      const std::uint64_t before =
          (at > arrays.edges_on_cell.offsets[cell] ? at : arrays.edges_on_cell.offsets[cell + 1]) -
          1;
      const auto& ends = arrays.cells_on_edge[arrays.edges_on_cell.values[at]];
      EXPECT_EQ((std::set<Index>{ends[0], ends[1]}),
                (std::set<Index>{cell, arrays.cells_on_cell[at]}));
      const auto& corners = arrays.vertices_on_edge[arrays.edges_on_cell.values[at]];
      EXPECT_EQ((std::set<Index>{corners[0], corners[1]}),
                (std::set<Index>{arrays.vertices_on_cell[before], arrays.vertices_on_cell[at]}));
      const LongPoint v = to_long(arrays.vertex_points[arrays.vertices_on_cell[at]]);
      const LongPoint w = to_long(arrays.vertex_points[arrays.vertices_on_cell[next]]);
      EXPECT_GT(inner(z, outer(v, w)), 0);
    }
  }
  for (Index v = 0; v < arrays.num_vertices(); ++v) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (const Index e : {arrays.edges_on_vertex[v][j], arrays.edges_on_vertex[v][(j + 1) % 3]}) {
        EXPECT_TRUE(std::ranges::count(arrays.vertices_on_edge[e], v) == 1);
        EXPECT_TRUE(std::ranges::count(arrays.cells_on_edge[e], arrays.cells_on_vertex[v][j]) == 1);
      }
    }
  }
}

TEST(mesh_arrays, lengths_and_areas_are_those_of_long_double) {
  const double radius = 6371229;
  for (const auto& sites : {mesh_sites(400, 3), icosahedral_sites(0), mesh_sites(20, 5)}) {
    const Triangulation triangulation = delaunay(sites);
    if (triangulation.num_ghost_faces() > 0) continue;
    const VoronoiMesh arrays = mesh::make_mesh(triangulation, {.radius = radius});
    const auto at_one = [&](const Point& p) { return unit(to_long(p)); };
    for (std::size_t e = 0; e < arrays.num_edges(); ++e) {
      const auto [a, b] = arrays.cells_on_edge[e];
      const auto [v, w] = arrays.vertices_on_edge[e];
      const LongPoint from = at_one(arrays.cell_points[a]);
      const LongPoint to = at_one(arrays.cell_points[b]);
      const LongPoint right = at_one(arrays.vertex_points[v]);
      const LongPoint left = at_one(arrays.vertex_points[w]);
      EXPECT_NEAR(arrays.cell_distances[e], static_cast<double>(radius * arc(from, to)), 1e-8);
      EXPECT_NEAR(arrays.vertex_distances[e], static_cast<double>(radius * arc(right, left)), 1e-8);
      const LongPoint normal = outer(from, to);
      EXPECT_LT(inner(normal, right), inner(normal, left));
      const LongPoint middle = unit(sum(from, to));
      if (middle.x == 0 && middle.y == 0) continue;
      EXPECT_LT(arc(middle, at_one(arrays.edge_points[e])), 1e-15L);
      const LongPoint east = unit({-middle.y, middle.x, 0});
      const LongPoint north = outer(middle, east);
      const LongPoint along = sum(to, times(-1, from));
      EXPECT_NEAR(arrays.normal_angles[e],
                  static_cast<double>(std::atan2(inner(along, north), inner(along, east))), 1e-13);
    }
    for (std::size_t v = 0; v < arrays.num_vertices(); ++v) {
      const LongPoint center = at_one(arrays.vertex_points[v]);
      std::array<LongPoint, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = at_one(arrays.cell_points[arrays.cells_on_vertex[v][i]]);
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const LongPoint& z = corners[i];
        const LongPoint next = unit(sum(z, corners[(i + 1) % 3]));
        const LongPoint last = unit(sum(z, corners[(i + 2) % 3]));
        const long double kite = signed_area(z, next, center) + signed_area(z, center, last);
        EXPECT_NEAR(arrays.kite_areas[v][i] / (radius * radius), static_cast<double>(kite), 1e-15);
      }
      const long double area = signed_area(corners[0], corners[1], corners[2]);
      EXPECT_NEAR(arrays.triangle_areas[v] / (radius * radius), static_cast<double>(area), 2e-15);
    }
  }
}

TEST(mesh_arrays, kites_add_up_to_cells_and_the_sphere) {
  for (const auto& sites : {mesh_sites(20000, 4), icosahedral_sites(4)}) {
    const Triangulation triangulation = delaunay(sites);
    const VoronoiMesh arrays = mesh::make_mesh(triangulation);
    const std::vector<double> areas = rondel::areas(triangulation);
    long double kites = 0;
    for (const auto& of : arrays.kite_areas) kites += of[0] + of[1] + of[2];
    long double cells = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
      cells += arrays.cell_areas[i];
      EXPECT_NEAR(arrays.cell_areas[i] / areas[i], 1, 1e-14);
    }
    EXPECT_LT(std::abs(kites / sphere_area - 1), 1e-14L);
    EXPECT_LT(std::abs(cells / sphere_area - 1), 1e-14L);
  }
}

TEST(mesh_arrays, weights_do_no_work_and_turn_a_rotation) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(icosahedral_sites(4)));
  const mesh::TangentialWeights rows = mesh::tangential_weights(arrays);
  std::map<std::pair<Index, Index>, double> weights;
  for (Index e = 0; e < arrays.num_edges(); ++e) {
    for (std::uint64_t k = rows.edges.offsets[e]; k < rows.edges.offsets[e + 1]; ++k) {
      const Index other = rows.edges.values[k];
      weights[{e, other}] =
          rows.weights[k] * arrays.cell_distances[e] / arrays.vertex_distances[other];
    }
  }
  for (const auto& [edges, weight] : weights) {
    EXPECT_NEAR(weight, -weights.at({edges.second, edges.first}), 1e-14);
  }
  // The flow of a solid rotation about an axis: its part along the edges from that across them.
  const LongPoint axis = unit({1, 2, 3});
  long double worst = 0;
  const auto normal_of = [&](Index e) {
    const auto [a, b] = arrays.cells_on_edge[e];
    return unit(sum(to_long(arrays.cell_points[b]), times(-1, to_long(arrays.cell_points[a]))));
  };
  const auto flow = [&](Index e) { return outer(axis, to_long(arrays.edge_points[e])); };
  for (Index e = 0; e < arrays.num_edges(); ++e) {
    long double along = 0;
    for (std::uint64_t k = rows.edges.offsets[e]; k < rows.edges.offsets[e + 1]; ++k) {
      along += rows.weights[k] * inner(flow(rows.edges.values[k]), normal_of(rows.edges.values[k]));
    }
    const LongPoint tangent = outer(to_long(arrays.edge_points[e]), normal_of(e));
    worst = std::max(worst, std::abs(along - inner(flow(e), tangent)));
  }
  // First order, around the pentagons; a wrong sign costs 1 and more.
  EXPECT_LT(worst, 0.12L);
}

TEST(mesh_arrays, threads_do_not_change_a_bit) {
  const Triangulation triangulation = delaunay(mesh_sites(30000, 6));
  EXPECT_EQ(mesh::make_mesh(triangulation, {}, {.threads = 1}),
            mesh::make_mesh(triangulation, {}, {.threads = 2}));
}

TEST(mesh_arrays, angles_at_the_poles_are_those_of_longitude_zero) {
  // A ring of four around the north pole with an edge through it, and others.
  std::vector<Point> sites = {unit_vector_deg(0, 80), unit_vector_deg(180, 80)};
  for (const double lat : {60.0, 0.0, -40.0, -80.0}) {
    for (int i = 0; i < 5; ++i) sites.push_back(unit_vector_deg(72.0 * i + lat + 3, lat + i));
  }
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(sites));
  const auto at = std::ranges::find(arrays.cells_on_edge, std::array<Index, 2>{0, 1});
  ASSERT_NE(at, arrays.cells_on_edge.end());
  const auto e = static_cast<std::size_t>(at - arrays.cells_on_edge.begin());
  EXPECT_NEAR(arrays.edge_points[e].z, 1, 1e-15);
  // From (0, 80) to (180, 80): at longitude 0 northward, which is toward longitude 180 at the pole.
  const double lon = std::atan2(arrays.edge_points[e].y, arrays.edge_points[e].x);
  const double expected = std::numbers::pi / 2 + lon;
  EXPECT_NEAR(std::remainder(arrays.normal_angles[e] - expected, 2 * std::numbers::pi), 0, 1e-12);
}

std::string refusal(const std::vector<Point>& sites, const mesh::MeshOptions& options = {},
                    const Options& build = {}) {
  try {
    mesh::make_mesh(delaunay(sites, build), options);
  } catch (const InvalidInput& error) {
    return error.what() + (" at " + std::to_string(error.index()));
  }
  return "";
}

TEST(mesh_arrays, what_makes_no_mesh_is_refused_by_name) {
  auto sites = mesh_sites(100, 7);
  EXPECT_EQ(refusal(sites), "");
  EXPECT_NE(refusal(sites, {}, {.model = Model::weighted}).find("without weights"),
            std::string::npos);
  EXPECT_NE(refusal(sites, {.radius = -1}).find("radius"), std::string::npos);
  const std::vector<double> density(100, 0.5);
  EXPECT_EQ(refusal(sites, {.density = density}), "");
  EXPECT_NE(refusal(sites, {.density = std::span(density).first(99)}).find("99 densities"),
            std::string::npos);
  sites.push_back(sites[17]);
  EXPECT_EQ(refusal(sites),
            "a mesh has a cell for each site, but site 100 is where site 17 is at 100");
  std::erase_if(sites, [](const Point& p) { return p.z < 0; });
  sites.pop_back();
  EXPECT_NE(refusal(sites).find("does not surround"), std::string::npos);
}

TEST(mesh_arrays, cocircular_sites_are_named_or_allowed) {
  std::vector<Point> cube;
  for (int i = 0; i < 8; ++i) {
    cube.push_back({i % 2 == 0 ? -1.0 : 1.0, i / 2 % 2 == 0 ? -1.0 : 1.0, i < 4 ? -1.0 : 1.0});
  }
  EXPECT_NE(refusal(cube).find("lie on one circle"), std::string::npos);
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(cube), {.allow_zero_edges = true});
  EXPECT_EQ(std::ranges::count(arrays.vertex_distances, 0.0), 6);
  for (const double area : arrays.cell_areas) EXPECT_NEAR(area, std::numbers::pi / 2, 1e-15);
  // Three of the circles go through the last corner; lengths are then below what rounding makes of 0.
  cube.back().x += 0x1p-49;
  const VoronoiMesh moved = mesh::make_mesh(delaunay(cube), {.allow_zero_edges = true});
  EXPECT_EQ(std::ranges::count(moved.vertex_distances, 0.0), 3);
}

TEST(mesh_arrays, radii_are_from_the_least_to_the_largest) {
  const Triangulation triangulation = delaunay(mesh_sites(20, 1));
  for (const double radius : {mesh::min_radius, mesh::largest_radius}) {
    EXPECT_EQ(mesh::make_mesh(triangulation, {.radius = radius}).radius, radius);
  }
  for (const double radius : {mesh::min_radius / 2, mesh::largest_radius * 2, 0.0, -1.0}) {
    EXPECT_THROW((void)mesh::make_mesh(triangulation, {.radius = radius}), InvalidInput);
  }
}

}  // namespace
}  // namespace rondel::test
