// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes with a border from files that have only centers and corners: against the mesh that was written, which MPAS gives back
// bit for bit; and files whose cells are those of no mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "io/netcdf_reader.h"
#include "rondel/error.h"
#include "rondel/mesh_cull.h"
#include "rondel/mesh_formats.h"
#include "support/temporary_files.h"
#include "unit/meshing/support.h"
#include "unit/meshing/writer.h"

namespace rondel::test {
namespace {

using mesh::MeshFormat;
using mesh::VoronoiMesh;

constexpr MeshFormat formats_of_cells[] = {MeshFormat::ugrid, MeshFormat::scrip, MeshFormat::esmf};

// The mesh that came back against the one that was written. Cells and rings are in the same order, vertices and edges
// have other numbers.
class SameMesh {
 public:
  SameMesh(const VoronoiMesh& found, const VoronoiMesh& wanted) : found_(found), wanted_(wanted) {}

  void expect() {
    ASSERT_EQ(found_.edges_on_cell.offsets, wanted_.edges_on_cell.offsets);
    EXPECT_EQ(found_.cells_on_cell, wanted_.cells_on_cell);
    ASSERT_EQ(found_.num_edges(), wanted_.num_edges());
    ASSERT_EQ(found_.num_vertices(), wanted_.num_vertices());
    match(found_.vertices_on_cell, wanted_.vertices_on_cell, vertices_);
    match(found_.edges_on_cell.values, wanted_.edges_on_cell.values, edges_);
    for (std::size_t i = 0; i < found_.num_cells(); ++i) expect_cell(i);
    for (std::size_t e = 0; e < found_.num_edges(); ++e) expect_edge(e);
    for (std::size_t v = 0; v < found_.num_vertices(); ++v) expect_vertex(v);
  }

 private:
  static void match(const std::vector<Index>& found, const std::vector<Index>& wanted,
                    std::vector<Index>& numbers) {
    numbers.assign(*std::ranges::max_element(found) + std::size_t{1}, no_index);
    for (std::size_t at = 0; at < found.size(); ++at) {
      Index& number = numbers[found[at]];
      if (number == no_index) number = wanted[at];
      EXPECT_EQ(number, wanted[at]);
    }
  }
  void expect_near(const Point& p, const Point& q, double tolerance) const {
    EXPECT_LE(exact::norm(p - q), tolerance * wanted_.radius);
  }
  // What degrees tell of the direction of an edge.
  [[nodiscard]] double tolerance(std::size_t edge) const {
    return 1e-13 + (wanted_.cells_on_edge[edge][1] == no_index
                        ? 4e-15 * wanted_.cell_distances[edge] / wanted_.vertex_distances[edge]
                        : 0);
  }

  void expect_cell(std::size_t i) const {
    expect_near(found_.cell_points[i], wanted_.cell_points[i], 1e-15);
    EXPECT_NEAR(found_.cell_areas[i] / wanted_.cell_areas[i], 1, 1e-12);
  }

  void expect_edge(std::size_t e) const {
    const Index number = edges_[e];
    EXPECT_EQ(found_.cells_on_edge[e], wanted_.cells_on_edge[number]);
    for (std::size_t side = 0; side < 2; ++side) {
      EXPECT_EQ(vertices_[found_.vertices_on_edge[e][side]],
                wanted_.vertices_on_edge[number][side]);
    }
    const double error = tolerance(number);
    expect_near(found_.edge_points[e], wanted_.edge_points[number], error);
    EXPECT_NEAR(found_.cell_distances[e], wanted_.cell_distances[number], error * wanted_.radius);
    EXPECT_NEAR(found_.vertex_distances[e], wanted_.vertex_distances[number],
                1e-14 * wanted_.radius);
    const double turn = std::remainder(found_.normal_angles[e] - wanted_.normal_angles[number],
                                       2 * std::numbers::pi);
    EXPECT_NEAR(turn, 0, 100 * error / wanted_.cell_distances[number] * wanted_.radius);
  }

  // The lists around a vertex may begin at another cell.
  void expect_vertex(std::size_t v) const {
    const Index number = vertices_[v];
    expect_near(found_.vertex_points[v], wanted_.vertex_points[number], 2e-15);
    const Triple& wanted = wanted_.cells_on_vertex[number];
    std::size_t first = 0;
    while (first < 2 && wanted[first] != found_.cells_on_vertex[v][0]) ++first;
    double error = 1e-15;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = (k + first) % 3;
      EXPECT_EQ(found_.cells_on_vertex[v][k], wanted[at]);
      const Index edge = found_.edges_on_vertex[v][k];
      EXPECT_EQ(edge == no_index ? edge : edges_[edge], wanted_.edges_on_vertex[number][at]);
      if (edge != no_index) error += tolerance(edges_[edge]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(found_.kite_areas[v][k], wanted_.kite_areas[number][(k + first) % 3],
                  error * wanted_.radius * wanted_.radius);
    }
    EXPECT_NEAR(found_.triangle_areas[v], wanted_.triangle_areas[number],
                error * wanted_.radius * wanted_.radius);
  }

  const VoronoiMesh& found_;
  const VoronoiMesh& wanted_;
  std::vector<Index> vertices_;  // of those wanted, by those found
  std::vector<Index> edges_;
};

class BorderedFiles : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path() const { return folder_.file("m.nc"); }

  void expect_back(const VoronoiMesh& mesh) const {
    for (const MeshFormat format : formats_of_cells) {
      SCOPED_TRACE(static_cast<int>(format));
      mesh::write(path(), mesh, {.format = format});
      SameMesh(mesh::read_mesh(path(), {.radius = mesh.radius}), mesh).expect();
    }
  }

  // Cells of any rings, as ESMF has them.
  void put(const std::vector<Point>& centers, const std::vector<std::vector<Index>>& rings,
           const std::vector<Point>& corners) const {
    const auto degrees = [](const std::vector<Point>& points) {
      std::vector<double> values;
      for (const Point& p : points) {
        values.push_back(std::atan2(p.y, p.x) * 180 / std::numbers::pi);
        values.push_back(std::atan2(p.z, std::hypot(p.x, p.y)) * 180 / std::numbers::pi);
      }
      return values;
    };
    std::size_t room = 0;
    for (const auto& ring : rings) room = std::max(room, ring.size());
    std::vector<double> nodes;
    std::vector<double> counts;
    for (const auto& ring : rings) {
      counts.push_back(static_cast<double>(ring.size()));
      for (std::size_t k = 0; k < room; ++k) nodes.push_back(k < ring.size() ? ring[k] + 1.0 : -1);
    }
    MeshWriter file;
    file.add("nodeCoords", {{"nodeCount", corners.size()}, {"coordDim", 2}}, degrees(corners),
             {{"units", "degrees"}});
    file.add_whole("elementConn", {{"elementCount", rings.size()}, {"maxNodePElement", room}},
                   nodes, {}, {{"_FillValue", -1}});
    file.add_whole("numElementConn", {{"elementCount", rings.size()}}, counts);
    file.add("centerCoords", {{"elementCount", rings.size()}, {"coordDim", 2}}, degrees(centers),
             {{"units", "degrees"}});
    file.write(path());
  }
  // The line without the file's name.
  [[nodiscard]] std::string refusal() const {
    try {
      mesh::read_mesh(path(), {.allow_zero_edges = true});
    } catch (const FileError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(path() + ": ")) << what;
      return what.substr(std::min(what.size(), path().size() + 2));
    }
    return "";
  }

 private:
  TemporaryDirectory folder_;
};

VoronoiMesh without(const VoronoiMesh& arrays, std::uint64_t seed, double share) {
  Random random(seed);
  std::vector<std::uint8_t> mask(arrays.num_cells());
  for (std::uint8_t& one : mask) one = random.unit() < share ? 1 : 0;
  mask[0] = 0;
  return mesh::cull(arrays, mask).arrays;
}
VoronoiMesh cap_of(const VoronoiMesh& arrays, double cosine) {
  std::vector<std::uint8_t> mask;
  for (const Point& p : arrays.cell_points) {
    mask.push_back(
        exact::dot(p, arrays.cell_points[0]) < cosine * arrays.radius * arrays.radius ? 1 : 0);
  }
  return mesh::cull(arrays, mask).arrays;
}
std::vector<std::vector<Index>> rings_of(const VoronoiMesh& arrays) {
  std::vector<std::vector<Index>> rings;
  for (std::size_t i = 0; i < arrays.num_cells(); ++i) {
    rings.emplace_back(arrays.vertices_on_cell.begin() +
                           static_cast<std::ptrdiff_t>(arrays.edges_on_cell.offsets[i]),
                       arrays.vertices_on_cell.begin() +
                           static_cast<std::ptrdiff_t>(arrays.edges_on_cell.offsets[i + 1]));
  }
  return rings;
}

TEST_F(BorderedFiles, come_back_with_all_cells_edges_and_kites) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(600, 35)), {.radius = 6371229});
  // Islands, lakes, and cells alone.
  for (const double share : {0.02, 0.5, 0.9}) expect_back(without(arrays, 9, share));
  for (const double cosine : {-0.9, 0.3, 0.95, 1.0}) expect_back(cap_of(arrays, cosine));
}

TEST_F(BorderedFiles, of_symmetric_meshes_come_back) {
  // What is left has many centers on one circle without a center inside.
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(icosahedral_sites(3)));
  for (const double cosine : {-0.99, 0.0, 0.8}) expect_back(cap_of(arrays, cosine));
  expect_back(without(arrays, 4, 0.3));
}

TEST_F(BorderedFiles, take_radius_and_density_of_the_options) {
  const VoronoiMesh culled = cap_of(mesh::make_mesh(delaunay(mesh_sites(200, 36))), 0.2);
  mesh::write(path(), culled, {.format = MeshFormat::ugrid});
  const std::vector<double> density(culled.num_cells(), 0.5);
  const VoronoiMesh found = mesh::read_mesh(path(), {.radius = 3, .density = density});
  EXPECT_EQ(found.radius, 3);
  EXPECT_EQ(found.density, density);
  for (std::size_t i = 0; i < culled.num_cells(); ++i) {
    EXPECT_NEAR(found.cell_areas[i] / culled.cell_areas[i], 9, 1e-11);
  }
  EXPECT_THROW(mesh::read_mesh(path(), {.radius = -1}), FileError);
}

TEST_F(BorderedFiles, threads_do_not_change_them) {
  mesh::write(path(), without(mesh::make_mesh(delaunay(mesh_sites(20000, 37))), 3, 0.2),
              {.format = MeshFormat::scrip});
  EXPECT_EQ(mesh::read_mesh(path(), {}, {.threads = 1}),
            mesh::read_mesh(path(), {}, {.threads = 2}));
}

TEST_F(BorderedFiles, parts_that_touch_in_a_corner_have_a_vertex_each) {
  // The cells of two corners of a cube that are opposite in a side meet in the middle of it alone.
  const std::vector<Point> centers = {normalized({1, 1, 1}), normalized({-1, -1, 1})};
  const std::vector<Point> corners = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}};
  put(centers, {{0, 1, 2}, {3, 4, 2}}, corners);
  const VoronoiMesh found = mesh::read_mesh(path());
  EXPECT_EQ(found.num_vertices(), 6U);
  EXPECT_EQ(found.num_edges(), 6U);
  EXPECT_EQ(std::ranges::count(found.cells_on_cell, no_index), 6);
  for (const double area : found.cell_areas) EXPECT_NEAR(area, std::numbers::pi / 2, 1e-14);
}

TEST_F(BorderedFiles, whose_corners_no_vertex_can_be_are_refused) {
  std::vector<Point> cube;
  for (int i = 0; i < 8; ++i) {
    cube.push_back({i % 2 == 0 ? -1.0 : 1.0, i / 2 % 2 == 0 ? -1.0 : 1.0, i < 4 ? -1.0 : 1.0});
  }
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(cube), {.allow_zero_edges = true});
  const auto refusal_without = [&](std::vector<std::uint8_t> mask) {
    mesh::write(path(), mesh::cull(arrays, mask).arrays, {.format = MeshFormat::ugrid});
    return refusal();
  };
  EXPECT_EQ(refusal_without({0, 0, 0, 0, 0, 0, 0, 1}),
            "cell 0 has a corner of more than three cells, which no vertex of a mesh has");
  EXPECT_EQ(refusal_without({0, 0, 0, 1, 1, 1, 1, 1}),
            "cell 0 has a corner of three cells and the border, which no vertex of a mesh has");
  EXPECT_EQ(refusal_without({0, 0, 1, 1, 1, 1, 1, 1}), "");
}

TEST_F(BorderedFiles, whose_cells_are_those_of_no_mesh_are_refused) {
  const VoronoiMesh culled = cap_of(mesh::make_mesh(delaunay(icosahedral_sites(3))), 0.5);
  const auto rings = rings_of(culled);
  const auto refusal_of = [&](const auto& change) {
    auto points = culled.cell_points;
    auto changed = rings;
    change(points, changed);
    put(points, changed, culled.vertex_points);
    return refusal();
  };
  EXPECT_EQ(refusal_of([](auto&, auto&) {}), "");
  // The cell in the middle of the cap.
  const std::size_t inner = 0;
  const std::string name = "cell " + std::to_string(inner);
  EXPECT_NE(refusal_of([&](auto& points, auto&) {
              points[inner] = normalized(points[inner] + Point{0.004, 0.004, 0.004});
            }).find(" is not the Voronoi cell of its center"),
            std::string::npos);
  const std::string differing =
      refusal_of([&](auto&, auto& changed) { changed[inner].pop_back(); });
  EXPECT_TRUE(differing.starts_with("cells ")) << differing;
  EXPECT_TRUE(differing.ends_with(" meet, but not in the same corners")) << differing;
  EXPECT_EQ(refusal_of([&](auto& points, auto& changed) {
              points.push_back(points[inner]);
              changed.push_back(changed[inner]);
            }),
            "cells " + std::to_string(inner) + " and " + std::to_string(rings.size()) +
                " have the same center");
  EXPECT_EQ(refusal_of([&](auto&, auto& changed) { changed[inner].resize(2); }),
            name + " has several rings or none, where one is needed");
}

TEST_F(BorderedFiles, whose_rings_do_not_run_once_around_their_centers_are_refused) {
  const double fifth = 2 * std::numbers::pi / 5;
  std::vector<Point> pentagon;
  for (int k = 0; k < 5; ++k) {
    pentagon.push_back(normalized({0.3 * std::cos(k * fifth), 0.3 * std::sin(k * fifth), 1}));
  }
  const std::string off = "cell 0 is not the Voronoi cell of its center";
  put({{0, 0, 1}}, {{0, 1, 2, 3, 4}}, pentagon);
  EXPECT_EQ(mesh::read_mesh(path()).num_edges(), 5U);
  put({{0, 0, 1}}, {{0, 2, 4, 1, 3}}, pentagon);
  EXPECT_EQ(refusal(), off);
  // Outside of a side, but no farther away than the corners.
  put({normalized({-0.27, 0, 1})}, {{0, 1, 2, 3, 4}}, pentagon);
  EXPECT_EQ(refusal(), off);
  put({{1, 0, 0}}, {{0, 1, 2, 3, 4}}, pentagon);
  EXPECT_TRUE(refusal().starts_with("centers belong to other cells than the corners"));
  // A second cell that lies in the first one.
  std::vector<Point> corners = pentagon;
  for (const Point& p : pentagon) corners.push_back(normalized({p.x / 9, p.y / 9, p.z}));
  put({{0, 0, 1}, normalized({0.005, 0, 1})}, {{0, 1, 2, 3, 4}, {5, 6, 7, 8, 9}}, corners);
  EXPECT_EQ(refusal(), off);
}

// Masked cells are left out like those that cull() removes.
TEST_F(BorderedFiles, masked_cells_are_left_out) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(300, 31)));
  std::vector<std::uint8_t> mask(arrays.num_cells());
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = arrays.cell_points[i].z > 0.2 ? 1 : 0;
  const auto left = std::ranges::count(mask, 0);
  for (const auto& [format, name] :
       {std::pair{MeshFormat::scrip, "grid_imask"}, {MeshFormat::esmf, "elementMask"}}) {
    const auto mask_cells = [&, format = format, name = name](bool are_all) {
      mesh::write(path(), arrays, {.format = format});
      std::ifstream in(path(), std::ios::binary);
      std::string content{std::istreambuf_iterator<char>(in), {}};
      const std::uint64_t at = io::NetcdfReader(content).require(name).offset;
      for (std::size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] != 0 || are_all) content[at + 4 * i + 3] = 0;
      }
      std::ofstream(path(), std::ios::binary) << content;
    };
    mask_cells(false);
    std::vector<std::string> remarks;
    const VoronoiMesh found = mesh::read_mesh(path(), {}, {}, &remarks);
    SameMesh(found, mesh::cull(arrays, mask).arrays).expect();
    ASSERT_EQ(remarks.size(), 2U);
    EXPECT_EQ(remarks[0],
              std::to_string(300 - left) + " of 300 cells are masked by \"" + name + '"');
    EXPECT_EQ(remarks[1],
              "the mesh has the other " + std::to_string(left) + " cells, in their order");
    mask_cells(true);
    EXPECT_EQ(refusal(), "all cells are masked");
  }
}

TEST_F(BorderedFiles, cells_of_the_sphere_that_lack_a_corner_are_refused) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(100, 32)));
  auto rings = rings_of(arrays);
  rings[7].erase(rings[7].begin() + 1);
  put(arrays.cell_points, rings, arrays.vertex_points);
  const std::string differing = refusal();
  EXPECT_TRUE(differing.ends_with(" meet, but not in the same corners")) << differing;
  // All cells at a corner lack it.
  rings = rings_of(arrays);
  for (auto& ring : rings) std::erase(ring, Index{5});
  put(arrays.cell_points, rings, arrays.vertex_points);
  EXPECT_NE(refusal(), "");
}

TEST_F(BorderedFiles, without_a_border_may_differ_in_corners) {
  // Each cell has corners of its own, which others have a little elsewhere.
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(icosahedral_sites(2)));
  std::vector<Point> corners;
  std::vector<std::vector<Index>> rings;
  Random random(5);
  for (const auto& ring : rings_of(arrays)) {
    auto& own = rings.emplace_back();
    for (const Index v : ring) {
      own.push_back(static_cast<Index>(corners.size()));
      corners.push_back(normalized(arrays.vertex_points[v] + 1e-6 * random_direction(random)));
    }
  }
  put(arrays.cell_points, rings, corners);
  EXPECT_EQ(mesh::read_mesh(path()).cells_on_cell, arrays.cells_on_cell);
}

}  // namespace
}  // namespace rondel::test
