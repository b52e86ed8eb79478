// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes with a border: against lists made by brute force from the mesh before, and what files give back. Points in
// regions: against sums of angles in long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>
#include <string>

#include "exact/vector.h"
#include "io/netcdf_reader.h"
#include "rondel/cell_set.h"
#include "rondel/error.h"
#include "rondel/mesh_cull.h"
#include "rondel/mesh_formats.h"
#include "rondel/mesh_quality.h"
#include "rondel/polygon_files.h"
#include "rondel/read_cells.h"
#include "support/temporary_files.h"
#include "support/thrown.h"
#include "unit/meshing/support.h"

namespace rondel::test {
namespace {

using exact::cross;
using exact::dot;
using mesh::Culled;
using mesh::MeshFormat;
using mesh::VoronoiMesh;

std::vector<std::uint8_t> mask_of(std::size_t n, std::uint64_t seed, double share) {
  Random random(seed);
  std::vector<std::uint8_t> mask(n);
  for (std::uint8_t& one : mask) one = random.unit() < share ? 1 : 0;
  return mask;
}
// Cells whose sites are farther than this from the first one.
std::vector<std::uint8_t> cap_mask(const VoronoiMesh& arrays, double cosine) {
  std::vector<std::uint8_t> mask;
  for (const Point& p : arrays.cell_points) {
    mask.push_back(dot(p, arrays.cell_points[0]) < cosine * arrays.radius * arrays.radius ? 1 : 0);
  }
  return mask;
}

// All that stays, and how it is numbered, from lists of cells alone.
class CullingOracle {
 public:
  CullingOracle(const VoronoiMesh& arrays, const std::vector<std::uint8_t>& mask)
      : arrays_(arrays), mask_(mask) {
    for (Index i = 0; i < arrays.num_cells(); ++i) {
      if (mask[i] == 0) cells_.push_back(i);
    }
    for (Index e = 0; e < arrays.num_edges(); ++e) {
      if (stays(arrays.cells_on_edge[e])) edges_.push_back(e);
    }
    for (Index v = 0; v < arrays.num_vertices(); ++v) {
      if (stays(arrays.cells_on_vertex[v])) vertices_.push_back(v);
    }
  }

  void expect(const Culled& culled) const {
    ASSERT_EQ(culled.arrays.num_cells(), cells_.size());
    ASSERT_EQ(culled.arrays.num_edges(), edges_.size());
    ASSERT_EQ(culled.arrays.num_vertices(), vertices_.size());
    for (Index i = 0; i < cells_.size(); ++i) expect_cell(culled, i);
    for (Index e = 0; e < edges_.size(); ++e) expect_edge(culled, e);
    for (Index v = 0; v < vertices_.size(); ++v) expect_vertex(culled, v);
  }

 private:
  template <class Cells>
  [[nodiscard]] bool stays(const Cells& cells) const {
    return std::ranges::any_of(cells, [&](Index c) { return mask_[c] == 0; });
  }
  static Index before(const std::vector<Index>& old, Index now) {
    return now == no_index ? no_index : old[now];
  }
  [[nodiscard]] Index left(Index cell) const { return mask_[cell] == 0 ? cell : no_index; }

  void expect_cell(const Culled& culled, Index i) const {
    const VoronoiMesh& found = culled.arrays;
    const Index old = cells_[i];
    EXPECT_EQ(culled.cells[old], i);
    EXPECT_EQ(found.cell_points[i], arrays_.cell_points[old]);
    EXPECT_EQ(found.cell_areas[i], arrays_.cell_areas[old]);
    const std::uint64_t size = found.edges_on_cell.offsets[i + 1] - found.edges_on_cell.offsets[i];
    ASSERT_EQ(size, arrays_.edges_on_cell.offsets[old + 1] - arrays_.edges_on_cell.offsets[old]);
    for (std::uint64_t j = 0; j < size; ++j) {
      const std::uint64_t at = found.edges_on_cell.offsets[i] + j;
      const std::uint64_t old_at = arrays_.edges_on_cell.offsets[old] + j;
      EXPECT_EQ(before(cells_, found.cells_on_cell[at]), left(arrays_.cells_on_cell[old_at]));
      EXPECT_EQ(edges_[found.edges_on_cell.values[at]], arrays_.edges_on_cell.values[old_at]);
      EXPECT_EQ(vertices_[found.vertices_on_cell[at]], arrays_.vertices_on_cell[old_at]);
    }
  }

  void expect_edge(const Culled& culled, Index e) const {
    const VoronoiMesh& found = culled.arrays;
    const Index old = edges_[e];
    EXPECT_EQ(culled.edges[old], e);
    const bool is_turned = mask_[arrays_.cells_on_edge[old][0]] != 0;
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t from = is_turned ? 1 - side : side;
      EXPECT_EQ(before(cells_, found.cells_on_edge[e][side]),
                left(arrays_.cells_on_edge[old][from]));
      EXPECT_EQ(vertices_[found.vertices_on_edge[e][side]], arrays_.vertices_on_edge[old][from]);
    }
    EXPECT_EQ(found.vertex_distances[e], arrays_.vertex_distances[old]);
    EXPECT_EQ(found.cell_distances[e], arrays_.cell_distances[old]);
    const double turn = std::abs(found.normal_angles[e] - arrays_.normal_angles[old]);
    EXPECT_NEAR(turn, is_turned ? std::numbers::pi : 0, 1e-15);
    EXPECT_LE(std::abs(found.normal_angles[e]), std::numbers::pi);
  }

  void expect_vertex(const Culled& culled, Index v) const {
    const VoronoiMesh& found = culled.arrays;
    const Index old = vertices_[v];
    EXPECT_EQ(culled.vertices[old], v);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index cell = arrays_.cells_on_vertex[old][k];
      EXPECT_EQ(before(cells_, found.cells_on_vertex[v][k]), left(cell));
      EXPECT_EQ(found.kite_areas[v][k], mask_[cell] == 0 ? arrays_.kite_areas[old][k] : 0);
      sum += found.kite_areas[v][k];
      const Index edge = arrays_.edges_on_vertex[old][k];
      EXPECT_EQ(before(edges_, found.edges_on_vertex[v][k]),
                stays(arrays_.cells_on_edge[edge]) ? edge : no_index);
    }
    EXPECT_EQ(found.triangle_areas[v], sum);
  }

  const VoronoiMesh& arrays_;
  const std::vector<std::uint8_t>& mask_;
  std::vector<Index> cells_;
  std::vector<Index> edges_;
  std::vector<Index> vertices_;
};

void expect_culled(const VoronoiMesh& arrays, const std::vector<std::uint8_t>& mask) {
  CullingOracle(arrays, mask).expect(mesh::cull(arrays, mask));
}

TEST(mesh_cull, keeps_what_touches_a_kept_cell) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(700, 31)), {.radius = 3});
  for (const double share : {0.0, 0.02, 0.5, 0.97}) expect_culled(arrays, mask_of(700, 5, share));
  expect_culled(arrays, cap_mask(arrays, 0.3));
}

TEST(mesh_cull, without_removed_cells_is_the_same_mesh) {
  std::vector<double> density(300, 0.5);
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(300, 32)), {.density = density});
  EXPECT_EQ(mesh::cull(arrays, std::vector<std::uint8_t>(300, 0)).arrays, arrays);
}

TEST(mesh_cull, in_two_steps_is_in_one) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(500, 33)));
  const std::vector<std::uint8_t> first = mask_of(500, 1, 0.3);
  const std::vector<std::uint8_t> second = mask_of(500, 2, 0.3);
  std::vector<std::uint8_t> both(500);
  std::vector<std::uint8_t> rest;
  for (std::size_t i = 0; i < 500; ++i) {
    both[i] = first[i] | second[i];
    if (first[i] == 0) rest.push_back(second[i]);
  }
  EXPECT_EQ(mesh::cull(mesh::cull(arrays, first).arrays, rest).arrays,
            mesh::cull(arrays, both).arrays);
}

TEST(mesh_cull, what_does_not_fit_is_refused) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(50, 34)));
  EXPECT_THROW(mesh::cull(arrays, std::vector<std::uint8_t>(49)), InvalidInput);
  EXPECT_THROW(mesh::cull(arrays, std::vector<std::uint8_t>(50, 1)), InvalidInput);
  VoronoiMesh bad = arrays;
  bad.cells_on_edge[7][0] = no_index;
  EXPECT_THROW(mesh::cull(bad, std::vector<std::uint8_t>(50)), InvalidInput);
}

class CulledFiles : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const char* name) const { return folder_.file(name); }

 private:
  TemporaryDirectory folder_;
};

TEST_F(CulledFiles, mpas_comes_back_bit_for_bit) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(600, 35)), {.radius = 6371229});
  for (const double share : {0.1, 0.5, 0.9}) {
    const VoronoiMesh culled = mesh::cull(arrays, mask_of(600, 9, share)).arrays;
    mesh::write(path("m.nc"), culled);
    EXPECT_EQ(mesh::read_mpas(path("m.nc")), culled);
  }
  std::vector<std::uint8_t> all_but_one(600, 1);
  all_but_one[17] = 0;
  const VoronoiMesh one = mesh::cull(arrays, all_but_one).arrays;
  mesh::write(path("m.nc"), one);
  EXPECT_EQ(mesh::read_mpas(path("m.nc")), one);
}

TEST_F(CulledFiles, cells_of_every_format_are_those_that_are_left) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(icosahedral_sites(3)));
  const VoronoiMesh culled = mesh::cull(arrays, cap_mask(arrays, 0.2)).arrays;
  for (const MeshFormat format :
       {MeshFormat::mpas, MeshFormat::ugrid, MeshFormat::scrip, MeshFormat::esmf}) {
    mesh::write(path("m.nc"), culled, {.format = format});
    const CellTable table = read_cells({path("m.nc"), {}});
    ASSERT_EQ(table.num_cells(), culled.num_cells());
    const CellSet cell_set = CellSet::of(table);
    for (std::size_t i = 0; i < culled.num_cells(); ++i) {
      EXPECT_NEAR(cell_set.areas()[i], culled.cell_areas[i], 1e-12);
    }
  }
  mesh::write(path("m.exo"), culled, {.format = MeshFormat::exodus});
  std::ifstream in(path("m.exo"), std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  const io::NetcdfReader file(content);
  std::set<std::int64_t> nodes;
  for (const char* name : {"connect1", "connect2"}) {
    for (const std::int64_t node : file.integers(file.require(name))) nodes.insert(node);
  }
  EXPECT_EQ(nodes.size(), culled.num_vertices());
  EXPECT_EQ(*nodes.begin(), 1);
  EXPECT_EQ(*nodes.rbegin(), static_cast<std::int64_t>(culled.num_vertices()));
}

TEST_F(CulledFiles, numbers_of_the_border_are_none) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(icosahedral_sites(2)));
  const VoronoiMesh culled = mesh::cull(arrays, cap_mask(arrays, 0)).arrays;
  const auto content_of = [&](MeshFormat format) {
    mesh::write(path("m.nc"), culled, {.format = format});
    std::ifstream in(path("m.nc"), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string mpas = content_of(MeshFormat::mpas);
  const io::NetcdfReader file(mpas);
  const auto of_edge = file.integers(file.require("cellsOnEdge"));
  const auto of_vertex = file.integers(file.require("cellsOnVertex"));
  const auto is_border = file.integers(file.require("boundaryVertex"));
  std::size_t border = 0;
  for (std::size_t e = 0; e < culled.num_edges(); ++e) {
    EXPECT_GT(of_edge[2 * e], 0);
    border += of_edge[2 * e + 1] == 0 ? 1U : 0U;
  }
  EXPECT_GT(border, 10U);
  for (std::size_t v = 0; v < culled.num_vertices(); ++v) {
    const bool lacks =
        of_vertex[3 * v] == 0 || of_vertex[3 * v + 1] == 0 || of_vertex[3 * v + 2] == 0;
    EXPECT_EQ(is_border[v], lacks ? 1 : 0);
  }
  const std::string ugrid = content_of(MeshFormat::ugrid);
  const io::NetcdfReader other(ugrid);
  const auto& faces_of_edges = other.require("edge_faces");
  EXPECT_EQ(io::find_attribute(faces_of_edges.attributes, "_FillValue")->numbers[0], -1);
  EXPECT_EQ(std::ranges::count(other.integers(faces_of_edges), -1),
            static_cast<std::ptrdiff_t>(border));
  // An outline has as many corners as sides; of a disk Euler's number is 1.
  EXPECT_EQ(std::ranges::count(is_border, 1), static_cast<std::ptrdiff_t>(border));
  EXPECT_EQ(culled.num_vertices() + culled.num_cells(), culled.num_edges() + 1);

  mesh::write_graph(path("graph.info"), culled);
  std::ifstream graph(path("graph.info"));
  std::size_t cells = 0;
  std::size_t edges = 0;
  graph >> cells >> edges;
  std::size_t numbers = 0;
  for (std::size_t number = 0; graph >> number; ++numbers) {
    EXPECT_TRUE(number >= 1 && number <= cells);
  }
  EXPECT_EQ(edges, culled.num_edges() - border);
  EXPECT_EQ(numbers, 2 * edges);
}

TEST(mesh_cull, quality_is_that_of_what_is_left) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(icosahedral_sites(4)), {.radius = 2});
  const VoronoiMesh culled = mesh::cull(arrays, cap_mask(arrays, 0.1)).arrays;
  const mesh::Quality quality = mesh::quality(culled);
  std::size_t triangles = 0;
  for (const Triple& cells : culled.cells_on_vertex) {
    triangles += std::ranges::find(cells, no_index) == cells.end() ? 1U : 0U;
  }
  std::uint64_t angles = 0;
  for (const std::uint64_t n : quality.angles_deg.counts) angles += n;
  EXPECT_EQ(angles, 3 * triangles);
  EXPECT_GT(quality.num_border_edges, 0U);
  EXPECT_LT(quality.kite_sum_error, 1e-13);
  EXPECT_TRUE(std::isnan(quality.cell_sum_error));
  // The cells are alike everywhere.
  EXPECT_NEAR(quality.energy, mesh::quality(arrays).energy, 0.01);
  EXPECT_EQ(mesh::quality_value(quality, "num-border-edges"),
            static_cast<double>(quality.num_border_edges));
  EXPECT_NE(mesh::quality_text(quality).find("edges at the border: "), std::string::npos);
  // Cells have the shapes that they had.
  const mesh::CellQuality before = mesh::cell_quality(arrays);
  const mesh::CellQuality now = mesh::cell_quality(culled);
  const Culled maps = mesh::cull(arrays, cap_mask(arrays, 0.1));
  for (std::size_t i = 0; i < arrays.num_cells(); ++i) {
    if (maps.cells[i] == no_index) continue;
    EXPECT_EQ(now.centroid_offset[maps.cells[i]], before.centroid_offset[i]);
    EXPECT_EQ(now.edge_ratio[maps.cells[i]], before.edge_ratio[i]);
  }
}

TEST(mesh_cull, weights_between_kept_cells_are_the_same) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(400, 36)));
  const Culled culled = mesh::cull(arrays, mask_of(400, 3, 0.2));
  const mesh::TangentialWeights before = mesh::tangential_weights(arrays);
  const mesh::TangentialWeights now = mesh::tangential_weights(culled.arrays);
  for (Index e = 0; e < arrays.num_edges(); ++e) {
    const Index number = culled.edges[e];
    if (number == no_index) continue;
    const auto size = now.edges.offsets[number + 1] - now.edges.offsets[number];
    if (culled.arrays.cells_on_edge[number][1] == no_index) {
      const Index cell = culled.arrays.cells_on_edge[number][0];
      EXPECT_EQ(size, culled.arrays.edges_on_cell.offsets[cell + 1] -
                          culled.arrays.edges_on_cell.offsets[cell] - 1);
      continue;
    }
    ASSERT_EQ(size, before.edges.offsets[e + 1] - before.edges.offsets[e]);
    for (std::uint64_t k = 0; k < size; ++k) {
      const Index old = before.edges.values[before.edges.offsets[e] + k];
      EXPECT_EQ(now.edges.values[now.edges.offsets[number] + k], culled.edges[old]);
      // An edge that was turned around has its velocity the other way.
      const Index first = arrays.cells_on_edge[old][0];
      const double sign = culled.cells[first] == no_index ? -1 : 1;
      EXPECT_EQ(now.weights[now.edges.offsets[number] + k],
                sign * before.weights[before.edges.offsets[e] + k]);
    }
  }
}

// Rings of corners; reversed, what is around them.
CellRings rings_of(const std::vector<std::vector<Point>>& rings) {
  CellRings regions;
  for (const std::vector<Point>& ring : rings) {
    for (const Point& p : ring) {
      regions.corners.push_back(static_cast<Index>(regions.points.size()));
      regions.points.push_back(p);
    }
    regions.rings.push_back(regions.corners.size());
    regions.cells.push_back(regions.rings.size() - 1);
  }
  return regions;
}

struct Star {
  Point center;
  std::vector<Point> ring;
};
Star random_star(Random& random, std::size_t corners, double radius) {
  Star star;
  star.center = random_direction(random);
  const Point u = normalized(cross(star.center, random_direction(random)));
  const Point v = cross(star.center, u);
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
    const double r = radius * (0.3 + 0.7 * random.unit());
    star.ring.push_back(
        normalized(star.center + r * std::cos(angle) * u + r * std::sin(angle) * v));
  }
  return star;
}
// By the triangles of the center and the sides.
bool is_in_star(const Star& star, const Point& q) {
  const auto is_left = [&](const Point& a, const Point& b) {
    return inner(outer(to_long(a), to_long(b)), to_long(q)) > 0;
  };
  for (std::size_t k = 0; k < star.ring.size(); ++k) {
    const Point& a = star.ring[k];
    const Point& b = star.ring[(k + 1) % star.ring.size()];
    if (is_left(star.center, a) && is_left(a, b) && is_left(b, star.center)) return true;
  }
  return false;
}

TEST(region_sites, are_those_in_the_triangles_of_stars) {
  Random random(41);
  for (const double radius : {0.01, 0.7, 5.0}) {
    for (int round = 0; round < 10; ++round) {
      const Star star = random_star(random, 40, radius);
      const Star other = random_star(random, 5, radius);
      std::vector<Point> points;
      std::vector<std::uint8_t> in_star;
      std::vector<std::uint8_t> in_any;
      for (int i = 0; i < 300; ++i) {
        const Point& center = i % 2 == 0 ? star.center : other.center;
        points.push_back(i % 5 == 0 ? random_direction(random)
                                    : normalized(center + radius * random_direction(random)));
        in_star.push_back(is_in_star(star, points.back()) ? 1 : 0);
        in_any.push_back(in_star.back() | (is_in_star(other, points.back()) ? 1 : 0));
      }
      EXPECT_EQ(mesh::inside(points, rings_of({star.ring})), in_star);
      EXPECT_EQ(mesh::inside(points, rings_of({star.ring, other.ring})), in_any);
      std::vector<Point> reversed(star.ring.rbegin(), star.ring.rend());
      std::vector<std::uint8_t> around;
      for (const std::uint8_t in : in_star) around.push_back(1 - in);
      EXPECT_EQ(mesh::inside(points, rings_of({reversed})), around);
      EXPECT_EQ(mesh::inside(points, rings_of({star.ring, reversed})),
                std::vector<std::uint8_t>(points.size(), 1));
    }
  }
}

TEST(region_sites, on_the_border_are_inside_exactly) {
  const CellRings octant = rings_of({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  const std::vector<Point> points = {
      {1, 1, 0},   {1, 1, 1e-300}, {1, 1, -1e-300},  {0, 0, 1},        {0, 0, -1},
      {3, 0, 0},   {-1, 0, 0},     {1, 2, 3},        {-1e-300, 1, 1},  {0, 1, 1},
      {-1, -1, 0}, {0, -1, 1},     {1e200, 1e-3, 0}, {1e200, -1e-3, 0}};
  EXPECT_EQ(mesh::inside(points, octant),
            (std::vector<std::uint8_t>{1, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0}));
  EXPECT_EQ(mesh::inside(points, {}), std::vector<std::uint8_t>(points.size(), 0));
}

TEST(region_sites, of_a_grid_are_in_one_cell_or_on_its_border) {
  // Corners and points in line with each other everywhere.
  std::vector<Point> points;
  for (int x = -3; x <= 3; ++x) {
    for (int y = -3; y <= 3; ++y) {
      for (int z = -3; z <= 3; ++z) {
        if (x != 0 || y != 0 || z != 0) {
          points.push_back(
              {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
      }
    }
  }
  // The face of the cube at x = 1.
  const std::vector<Point> square = {normalized({1, -1, -1}), normalized({1, 1, -1}),
                                     normalized({1, 1, 1}), normalized({1, -1, 1})};
  const std::vector<std::uint8_t> found = mesh::inside(points, rings_of({square}));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    EXPECT_EQ(found[i], p.x > 0 && std::abs(p.y) <= p.x && std::abs(p.z) <= p.x ? 1 : 0)
        << p.x << ' ' << p.y << ' ' << p.z;
  }
}

TEST(region_sites, that_are_no_points_are_refused) {
  const CellRings octant = rings_of({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  EXPECT_EQ(thrown_index([&] {
              mesh::inside(std::vector<Point>{{1, 2, 3}, {0, 0, 0}}, octant);
            }),
            1U);
  EXPECT_THROW(mesh::inside(std::vector<Point>{{1, 2, 3}}, rings_of({{{1, 0, 0}, {0, 1, 0}}})),
               InvalidInput);
}

}  // namespace
}  // namespace rondel::test
