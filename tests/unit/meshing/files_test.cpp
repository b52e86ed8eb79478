// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files of meshes: what comes back, whether bytes depend on threads, what is refused. Other programs read them
// in tests/cli/mesh_clients_test.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/atomic_file.h"
#include "io/bad_value.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_writer.h"
#include "rondel/error.h"
#include "rondel/mesh_cull.h"
#include "rondel/mesh_formats.h"
#include "rondel/mesh_quality.h"
#include "support/temporary_files.h"
#include "support/thrown.h"
#include "unit/meshing/support.h"
#include "unit/meshing/writer.h"

namespace rondel::test {
namespace {

using mesh::MeshFormat;
using mesh::NetcdfKind;
using mesh::VoronoiMesh;

class MeshFiles : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }
  [[nodiscard]] std::string bytes(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
  }

 private:
  TemporaryDirectory folder_;
};

template <class Work>
std::string file_error(const Work& work) {
  return thrown_message<FileError>(work);
}

TEST_F(MeshFiles, mpas_comes_back_bit_for_bit) {
  std::vector<double> density(2000);
  for (std::size_t i = 0; i < density.size(); ++i)
    density[i] = 1 / (1 + 0.001 * static_cast<double>(i));
  for (const NetcdfKind kind : {NetcdfKind::cdf2, NetcdfKind::cdf5}) {
    const VoronoiMesh arrays =
        mesh::make_mesh(delaunay(mesh_sites(2000, 12)), {.radius = 6371229, .density = density});
    mesh::write(path("m.nc"), arrays, {.kind = kind});
    EXPECT_EQ(bytes("m.nc")[3], kind == NetcdfKind::cdf2 ? 2 : 5);
    EXPECT_EQ(mesh::read_mpas(path("m.nc")), arrays);
    EXPECT_EQ(mesh::read_mesh(path("m.nc")), arrays);
  }
}

TEST_F(MeshFiles, a_string_gets_the_bytes_of_the_file) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(300, 12)), {});
  for (const MeshFormat format : {MeshFormat::mpas, MeshFormat::ugrid, MeshFormat::exodus}) {
    mesh::write(path("m.nc"), arrays, {.format = format});
    std::string in_memory;
    mesh::write(FileName::in_memory(in_memory, "nc"), arrays, {.format = format});
    EXPECT_EQ(in_memory, bytes("m.nc"));
  }
}

TEST_F(MeshFiles, the_content_of_mpas_is_that_of_the_file) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(300, 12)), {.radius = 3});
  std::string in_memory;
  mesh::write(FileName::in_memory(in_memory, "nc"), arrays);
  const io::NetcdfReader file{std::string_view(in_memory)};
  const mesh::MpasContent content = mesh::mpas_content(arrays);
  EXPECT_EQ(content.variables.size(), 30U);
  for (const mesh::FileVariable& variable : content.variables) {
    const io::VariableInFile& there = file.require(variable.name);
    EXPECT_EQ(there.shape, variable.shape) << variable.name;
    std::visit(
        [&](const auto& values) {
          EXPECT_EQ(file.numbers(there), std::vector<double>(values.begin(), values.end()))
              << variable.name;
        },
        variable.values);
  }
  EXPECT_EQ(content.attributes.size(), 5U);
}

// What a file is says its content, not its name.
TEST_F(MeshFiles, netcdf_of_any_name_is_read) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(20, 12)), {});
  mesh::write(path("m.nc"), arrays, {});
  std::filesystem::rename(path("m.nc"), path("m.mesh"));
  EXPECT_EQ(mesh::read_mesh(path("m.mesh")), arrays);
  std::ofstream(path("t.mesh")) << "a text";
  try {
    (void)mesh::read_mesh(path("t.mesh"));
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("meshes are read from netCDF"), std::string::npos)
        << error.what();
  }
}

TEST_F(MeshFiles, threads_do_not_change_a_byte) {
  const std::size_t n = is_shortened() ? 9000 : 20000;  // a thread takes 256 KiB of rows at a time
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(n, 13)));
  for (const MeshFormat format : {MeshFormat::mpas, MeshFormat::ugrid, MeshFormat::scrip,
                                  MeshFormat::esmf, MeshFormat::exodus}) {
    mesh::write(path("1.nc"), arrays, {.format = format}, {.threads = 1});
    mesh::write(path("2.nc"), arrays, {.format = format}, {.threads = 2});
    EXPECT_EQ(bytes("1.nc"), bytes("2.nc"));
  }
}

TEST_F(MeshFiles, other_formats_come_back_by_their_centers) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(500, 14)));
  for (const MeshFormat format : {MeshFormat::ugrid, MeshFormat::scrip, MeshFormat::esmf}) {
    // The radius is not in these files.
    mesh::write(path("m.nc"), mesh::make_mesh(delaunay(mesh_sites(500, 14)), {.radius = 6371229}),
                {.format = format});
    if (format != MeshFormat::ugrid) {
      const std::string content = bytes("m.nc");
      const io::NetcdfReader file(content);
      double total = 0;
      for (const double area :
           file.numbers(file.require(format == MeshFormat::scrip ? "grid_area" : "elementArea"))) {
        total += area;
      }
      EXPECT_NEAR(total / (4 * std::numbers::pi), 1, 1e-13);
    }
    const VoronoiMesh found = mesh::read_mesh(path("m.nc"));
    EXPECT_EQ(found.edges_on_cell.offsets, arrays.edges_on_cell.offsets);
    for (std::size_t i = 0; i < arrays.num_cells(); ++i) {
      EXPECT_NEAR(found.cell_areas[i] / arrays.cell_areas[i], 1, 1e-12);
    }
  }
}

TEST_F(MeshFiles, numbers_of_mpas_are_those_of_its_specification) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(icosahedral_sites(2)), {.radius = 2});
  mesh::write(path("m.nc"), arrays);
  const std::string content = bytes("m.nc");
  const io::NetcdfReader file(content);
  const auto integers = [&](const char* name) { return file.integers(file.require(name)); };
  const auto numbers = [&](const char* name) { return file.numbers(file.require(name)); };
  EXPECT_EQ(io::netcdf_text(file.attributes(), "on_a_sphere"), "YES");
  EXPECT_EQ(io::netcdf_text(file.attributes(), "file_id").size(), 10U);
  const std::size_t room = arrays.max_edges();
  ASSERT_EQ(integers("edgesOnEdge").size(), arrays.num_edges() * 2 * room);
  for (const double lon : numbers("lonCell")) {
    EXPECT_GE(lon, 0);
    EXPECT_LT(lon, 2 * std::numbers::pi);
  }
  // Rows end with 0 where a cell has five edges.
  const auto rings = integers("verticesOnCell");
  for (std::size_t i = 0; i < arrays.num_cells(); ++i) {
    const auto sides = static_cast<std::size_t>(arrays.edges_on_cell.offsets[i + 1] -
                                                arrays.edges_on_cell.offsets[i]);
    for (std::size_t j = 0; j < room; ++j) {
      EXPECT_EQ(rings[i * room + j] == 0, j >= sides);
    }
  }
  // Quadratic in the radius, and all of the sphere.
  double total = 0;
  for (const double area : numbers("areaTriangle")) total += area;
  EXPECT_NEAR(total / (16 * std::numbers::pi), 1, 1e-13);
  EXPECT_EQ(numbers("nominalMinDc").front(), *std::ranges::min_element(arrays.cell_distances));
  const auto quality = numbers("triangleQuality");
  for (const double value : quality) EXPECT_TRUE(value > 0.8 && value <= 1 + 1e-15);
}

TEST_F(MeshFiles, qualities_of_mpas_are_those_of_distances_and_angles) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(400, 16)));
  mesh::write(path("m.nc"), arrays);
  const std::string content = bytes("m.nc");
  const io::NetcdfReader file(content);
  const auto numbers = [&](const char* name) { return file.numbers(file.require(name)); };
  const auto of_cells = numbers("cellQuality");
  const auto spacings = numbers("gridSpacing");
  for (std::size_t i = 0; i < arrays.num_cells(); ++i) {
    std::vector<double> distances;
    for (std::uint64_t at = arrays.edges_on_cell.offsets[i];
         at < arrays.edges_on_cell.offsets[i + 1]; ++at) {
      distances.push_back(arrays.cell_distances[arrays.edges_on_cell.values[at]]);
    }
    const auto [least, most] = std::ranges::minmax(distances);
    EXPECT_EQ(of_cells[i], least / most);
    double sum = 0;
    for (const double distance : distances) sum += distance;
    EXPECT_NEAR(spacings[i], sum / static_cast<double>(distances.size()), 1e-15);
  }
  const auto of_angles = numbers("triangleAngleQuality");
  const auto obtuse = file.integers(file.require("obtuseTriangle"));
  for (std::size_t v = 0; v < arrays.num_vertices(); ++v) {
    std::array<long double, 3> angles{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto side = [&](std::size_t other) {
        return sum(to_long(arrays.cell_points[arrays.cells_on_vertex[v][(k + other) % 3]]),
                   times(-1, to_long(arrays.cell_points[arrays.cells_on_vertex[v][k]])));
      };
      angles[k] = arc(side(1), side(2));
    }
    const auto [least, most] = std::ranges::minmax(angles);
    EXPECT_NEAR(of_angles[v], static_cast<double>(least / most), 1e-12);
    EXPECT_EQ(obtuse[v], most > std::numbers::pi_v<long double> / 2 ? 1 : 0);
  }
}

TEST_F(MeshFiles, edges_of_ugrid_run_around_their_faces) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(100, 20)));
  mesh::write(path("m.nc"), arrays, {.format = MeshFormat::ugrid});
  const std::string content = bytes("m.nc");
  const io::NetcdfReader file(content);
  const auto integers = [&](const char* name) { return file.integers(file.require(name)); };
  const auto nodes = integers("face_nodes");
  const auto edges = integers("face_edges");
  const auto faces = integers("face_faces");
  const auto ends = integers("edge_nodes");
  const auto sides = integers("edge_faces");
  const std::size_t room = arrays.max_edges();
  for (std::size_t face = 0; face < arrays.num_cells(); ++face) {
    std::size_t count = 0;
    while (count < room && nodes[face * room + count] != -1) ++count;
    ASSERT_EQ(count, arrays.edges_on_cell.offsets[face + 1] - arrays.edges_on_cell.offsets[face]);
    for (std::size_t j = 0; j < room; ++j) {
      const std::int64_t edge = edges[face * room + j];
      EXPECT_EQ(edge == -1, j >= count);
      if (edge == -1) continue;
      const auto at = 2 * static_cast<std::size_t>(edge);
      const std::set<std::int64_t> corners = {nodes[face * room + (j + count - 1) % count],
                                              nodes[face * room + j]};
      EXPECT_EQ(corners, (std::set{ends[at], ends[at + 1]}));
      EXPECT_EQ((std::set<std::int64_t>{static_cast<std::int64_t>(face), faces[face * room + j]}),
                (std::set{sides[at], sides[at + 1]}));
    }
  }
}

TEST_F(MeshFiles, a_graph_has_each_neighbor_on_both_lines) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(300, 15)));
  mesh::write_graph(path("graph.info"), arrays);
  std::ifstream in(path("graph.info"));
  std::size_t cells = 0;
  std::size_t edges = 0;
  in >> cells >> edges;
  EXPECT_EQ(cells, 300U);
  EXPECT_EQ(edges, arrays.num_edges());
  std::size_t numbers = 0;
  for (std::size_t number = 0; in >> number; ++numbers) EXPECT_TRUE(number >= 1 && number <= cells);
  EXPECT_EQ(numbers, 2 * edges);
}

TEST_F(MeshFiles, corners_of_edges_without_length_are_one) {
  std::vector<Point> cube;
  for (int i = 0; i < 8; ++i) {
    cube.push_back({i % 2 == 0 ? -1.0 : 1.0, i / 2 % 2 == 0 ? -1.0 : 1.0, i < 4 ? -1.0 : 1.0});
  }
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(cube), {.allow_zero_edges = true});
  mesh::write(path("m.nc"), arrays, {.format = MeshFormat::exodus});
  const std::string content = bytes("m.nc");
  const io::NetcdfReader file(content);
  EXPECT_EQ(file.integers(file.require("connect1")).size(), 24U);
  EXPECT_EQ(file.find("connect2"), nullptr);
}

TEST_F(MeshFiles, cdf2_refuses_variables_of_4_gib) {
  const auto refusal = [&](std::uint64_t size, int version) -> std::string {
    io::AtomicFile file(path("large.nc"));
    io::NetcdfWriter out(file);
    const std::size_t dimension = out.add_dimension("nEdges", size);
    out.add_variable({"weightsOnEdge", io::NetcdfType::float64, {dimension}, {}});
    return thrown_message<io::BadValue>([&] { out.begin(version); });
  };
  EXPECT_EQ(refusal((1U << 29U) - 1, 2), "");
  EXPECT_EQ(refusal(1U << 29U, 5), "");
  EXPECT_EQ(refusal(1U << 29U, 2),
            "CDF-2 cannot hold it, as a dimension or a variable is too large; CDF-5 can");
}

TEST_F(MeshFiles, arrays_that_do_not_fit_are_refused) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(50, 17)));
  VoronoiMesh bad = arrays;
  bad.kite_areas.pop_back();
  EXPECT_THROW(mesh::write(path("m.nc"), bad), InvalidInput);
  bad = arrays;
  bad.edges_on_cell.values[3] = 10000;
  EXPECT_THROW(mesh::write(path("m.nc"), bad), InvalidInput);
  bad = arrays;
  std::swap(bad.edges_on_cell.values[0], bad.edges_on_cell.values.back());
  EXPECT_THROW(mesh::write(path("m.nc"), bad), InvalidInput);
  bad = arrays;
  bad.vertex_points[7] = {std::nan(""), 0, 1};
  EXPECT_THROW(mesh::write(path("m.nc"), bad), InvalidInput);
  bad.vertex_points[7] = {0, 0, 1.1};
  EXPECT_THROW(mesh::quality(bad), InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(path("m.nc")));
  EXPECT_THROW(mesh::write_graph(path("g"), VoronoiMesh{}), InvalidInput);
}

// A value of a variable, put into the bytes of a file.
void set_value(std::string& content, const char* name, std::size_t index, std::int32_t value) {
  const io::NetcdfReader file(content);
  const std::uint64_t at = file.require(name).offset + 4 * index;
  for (int i = 0; i < 4; ++i) {
    content[at + static_cast<std::size_t>(i)] =
        static_cast<char>(static_cast<std::uint32_t>(value) >> (24 - 8 * i));
  }
}

// Swaps two values of so many bytes.
void swap_values(std::string& content, const char* name, std::size_t size, std::size_t i,
                 std::size_t j) {
  const io::NetcdfReader file(content);
  const auto at = static_cast<std::ptrdiff_t>(file.require(name).offset);
  const auto begin = [&](std::size_t k) {
    return content.begin() + at + static_cast<std::ptrdiff_t>(size * k);
  };
  std::swap_ranges(begin(i), begin(i + 1), begin(j));
}

TEST_F(MeshFiles, cells_around_vertices_may_be_clockwise) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(50, 21)));
  mesh::write(path("m.nc"), arrays);
  std::string content = bytes("m.nc");
  for (std::size_t v = 0; v < arrays.num_vertices(); v += 2) {
    swap_values(content, "cellsOnVertex", 4, 3 * v + 1, 3 * v + 2);
    swap_values(content, "kiteAreasOnVertex", 8, 3 * v + 1, 3 * v + 2);
  }
  put("turned.nc", content);
  EXPECT_EQ(mesh::read_mpas(path("turned.nc")), arrays);
}

TEST_F(MeshFiles, damaged_lists_are_refused_with_their_place) {
  mesh::write(path("m.nc"), mesh::make_mesh(delaunay(mesh_sites(50, 18))));
  const std::string whole = bytes("m.nc");
  const auto refusal = [&](const char* name, std::size_t index, std::int32_t value) {
    std::string content = whole;
    set_value(content, name, index, value);
    put("bad.nc", content);
    std::string what = file_error([&] { mesh::read_mpas(path("bad.nc")); });
    EXPECT_TRUE(what.starts_with(path("bad.nc") + ": ")) << what;
    return what.substr(std::min(what.size(), path("bad.nc").size() + 2));
  };
  EXPECT_EQ(refusal("cellsOnEdge", 7, 52), "variable \"cellsOnEdge\", row 3: 52 is not in 1 to 50");
  EXPECT_EQ(refusal("cellsOnEdge", 7, 0), "the cells have 288 edges, and the edges 287 cells");
  EXPECT_EQ(
      refusal("verticesOnEdge", 7, 0),
      "variable \"verticesOnEdge\", row 3: is 0, which stands for no element, where one is needed");
  EXPECT_NE(refusal("cellsOnVertex", 0, 0), "");
  EXPECT_EQ(refusal("nEdgesOnCell", 2, 2),
            "variable \"nEdgesOnCell\", row 2: 2 is not in 3 to " +
                std::to_string(mesh::read_mpas(path("m.nc")).max_edges()));
  EXPECT_NE(refusal("edgesOnCell", 0, 100), "");
  EXPECT_NE(refusal("cellsOnVertex", 0, 50), "");
  EXPECT_NE(refusal("verticesOnEdge", 0, 90), "");
  put("cut.nc", whole.substr(0, whole.size() / 2));
  EXPECT_NE(file_error([&] { mesh::read_mpas(path("cut.nc")); }).find("ends at byte"),
            std::string::npos);
  put("text.nc", "lon,lat\n");
  EXPECT_NE(file_error([&] { mesh::read_mesh(path("text.nc")); }), "");
}

void set_number(std::string& content, const char* name, std::size_t index, double value) {
  const io::NetcdfReader file(content);
  const std::uint64_t at = file.require(name).offset + sizeof(double) * index;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned i = 0; i < 8; ++i) content[at + i] = static_cast<char>(bits >> (56 - 8 * i));
}

// In a file, and in arrays that somebody filled.
TEST_F(MeshFiles, impossible_numbers_are_refused_with_their_place) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(50, 18)), {.radius = 2});
  mesh::write(path("m.nc"), arrays);
  const std::string whole = bytes("m.nc");
  const auto refusal = [&](const char* name, double value) {
    std::string content = whole;
    set_number(content, name, 5, value);
    put("bad.nc", content);
    std::string what = file_error([&] { mesh::read_mesh(path("bad.nc")); });
    return what.substr(std::min(what.size(), path("bad.nc").size() + 2));
  };
  const auto said = [](const std::string& name, const std::string& why) {
    return "variable \"" + name + "\", value 5: " + why;
  };
  for (const char* name : {"areaCell", "areaTriangle", "dcEdge"}) {
    EXPECT_EQ(refusal(name, -1), said(name, "-1 is not positive"));
    EXPECT_EQ(refusal(name, 0), said(name, "0 is not positive"));
    EXPECT_NE(refusal(name, 60).find("60 is more than "), std::string::npos) << name;
    EXPECT_NE(refusal(name, std::nan("")), "");
  }
  EXPECT_EQ(refusal("dvEdge", -1e-9), said("dvEdge", "-1e-09 is less than 0"));
  EXPECT_NE(refusal("dvEdge", 13), "");
  EXPECT_EQ(refusal("angleEdge", 1e30), said("angleEdge", "1e+30 is more than 6.283185307179586"));
  EXPECT_EQ(refusal("angleEdge", -7), said("angleEdge", "-7 is less than -6.283185307179586"));
  const double angle = arrays.normal_angles[5];
  EXPECT_EQ(refusal("angleEdge", angle + (angle > 0 ? -6.28 : 6.28)), "");
  VoronoiMesh bad = arrays;
  bad.cell_areas[7] = -3;
  EXPECT_THROW(mesh::write(path("bad.nc"), bad, {.format = MeshFormat::scrip}), InvalidInput);
  EXPECT_THROW(mesh::quality(bad), InvalidInput);
  EXPECT_THROW(mesh::cull(bad, std::vector<std::uint8_t>(50, 0)), InvalidInput);
  bad = arrays;
  bad.normal_angles[7] = std::nan("");
  EXPECT_THROW(mesh::write(path("bad.nc"), bad), InvalidInput);
}

// Numbers that are possible, but not those of the points; the oracle computes in long double.
TEST_F(MeshFiles, numbers_that_contradict_the_points_are_refused_with_their_place) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(icosahedral_sites(2)), {.radius = 3});
  mesh::write(path("m.nc"), arrays);
  const std::string whole = bytes("m.nc");
  const auto refusal = [&](const char* name, std::size_t index, double value) {
    std::string content = whole;
    set_number(content, name, index, value);
    put("bad.nc", content);
    std::string what = file_error([&] { mesh::read_mesh(path("bad.nc")); });
    return what.substr(std::min(what.size(), path("bad.nc").size() + 2));
  };
  std::size_t num_near_poles = 0;
  for (std::size_t e = 0; e < arrays.num_edges(); e += 23) {
    const std::string at = ", value " + std::to_string(e) + ": ";
    const LongPoint a = unit(to_long(arrays.cell_points[arrays.cells_on_edge[e][0]]));
    const LongPoint b = unit(to_long(arrays.cell_points[arrays.cells_on_edge[e][1]]));
    const auto distance = static_cast<double>(3 * arc(a, b));
    for (const double factor : {0.5, 1.5}) {
      EXPECT_TRUE(refusal("dcEdge", e, factor * distance).starts_with("variable \"dcEdge\"" + at));
    }
    EXPECT_EQ(refusal("dvEdge", e, 1.3 * arrays.vertex_distances[e]), "");
    EXPECT_TRUE(refusal("dvEdge", e, 0).starts_with("variable \"dvEdge\"" + at));
    EXPECT_EQ(refusal("dcEdge", e, 1.05 * distance), "");
    EXPECT_TRUE(refusal("dvEdge", e, 2 * distance).starts_with("variable \"dvEdge\"" + at));
    const LongPoint middle = unit(sum(a, b));
    if (std::hypot(middle.x, middle.y) < 2.1 * std::sqrt(2 - 2 * inner(a, b))) {
      ++num_near_poles;
      continue;
    }
    const double angle = arrays.normal_angles[e];
    EXPECT_EQ(refusal("angleEdge", e, angle + 0.3), "") << e;
    EXPECT_TRUE(refusal("angleEdge", e, angle + 0.7).starts_with("variable \"angleEdge\"" + at));
    EXPECT_TRUE(refusal("angleEdge", e, angle > 0 ? angle - 3 : angle + 3)
                    .starts_with("variable \"angleEdge\"" + at));
  }
  EXPECT_LT(num_near_poles, 5U);
  for (const std::size_t i : {0U, 11U, 100U}) {
    EXPECT_TRUE(refusal("areaCell", i, 2.5 * arrays.cell_areas[i])
                    .starts_with("variable \"areaCell\", value " + std::to_string(i) + ": "));
    EXPECT_NE(refusal("areaCell", i, 0.4 * arrays.cell_areas[i]), "");
    EXPECT_EQ(refusal("areaCell", i, 1.5 * arrays.cell_areas[i]), "");
  }
  for (const char* name : {"lonCell", "latCell", "lonVertex", "latVertex", "lonEdge", "latEdge"}) {
    EXPECT_NE(refusal(name, 4, std::nan("")).find("value 4 of \"lon"), std::string::npos) << name;
    EXPECT_NE(refusal(name, 4, 9.969209968386869e36).find("value 4 of \"lon"), std::string::npos);
  }
  EXPECT_NE(refusal("latCell", 4, 2).find("degrees, is no place"), std::string::npos);
}

TEST_F(MeshFiles, cells_of_edges_in_the_other_order_contradict_the_angles) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(80, 22)));
  mesh::write(path("m.nc"), arrays);
  std::string content = bytes("m.nc");
  for (std::size_t e = 0; e < arrays.num_edges(); ++e) {
    swap_values(content, "cellsOnEdge", 4, 2 * e, 2 * e + 1);
  }
  put("swapped.nc", content);
  const std::string refused = file_error([&] { mesh::read_mpas(path("swapped.nc")); });
  EXPECT_NE(refused.find("\"angleEdge\", value 0: "), std::string::npos) << refused;
  EXPECT_NE(refused.find(" of \"cellsOnEdge\" has the angle "), std::string::npos);
  // With the angles turned as well the mesh is sound again.
  for (std::size_t e = 0; e < arrays.num_edges(); ++e) {
    const double angle = arrays.normal_angles[e];
    set_number(content, "angleEdge", e, angle + (angle > 0 ? -1 : 1) * std::numbers::pi);
  }
  put("turned.nc", content);
  EXPECT_EQ(file_error([&] { mesh::read_mpas(path("turned.nc")); }), "");
}

// Edges of the border with the missing cell first or second, whose normals point inward or outward.
TEST_F(MeshFiles, normals_at_a_border_point_outward) {
  const VoronoiMesh whole = mesh::make_mesh(delaunay(mesh_sites(200, 23)));
  std::vector<std::uint8_t> mask;
  for (const Point& p : whole.cell_points) mask.push_back(p.x > 0.3 ? 0 : 1);
  const VoronoiMesh arrays = mesh::cull(whole, mask).arrays;
  mesh::write(path("m.nc"), arrays);
  for (const auto& [are_inward, are_swapped] :
       {std::pair{false, true}, {true, false}, {true, true}}) {
    std::string content = bytes("m.nc");
    for (std::size_t e = 0; e < arrays.num_edges(); ++e) {
      if (arrays.cells_on_edge[e][1] != no_index) continue;
      if (are_swapped) swap_values(content, "cellsOnEdge", 4, 2 * e, 2 * e + 1);
      const double angle = arrays.normal_angles[e];
      const double turned = angle + (angle > 0 ? -1 : 1) * std::numbers::pi;
      if (are_inward) set_number(content, "angleEdge", e, turned);
    }
    put("first.nc", content);
    const VoronoiMesh found = mesh::read_mpas(path("first.nc"));
    ASSERT_EQ(found.cells_on_edge, arrays.cells_on_edge);
    for (std::size_t e = 0; e < arrays.num_edges(); ++e) {
      EXPECT_NEAR(found.normal_angles[e], arrays.normal_angles[e], 1e-15);
    }
  }
}

// Three lunes from pole to pole; two of the meridians between them have a corner on the equator.
TEST_F(MeshFiles, three_cells_without_a_border_are_refused) {
  MeshWriter file;
  const auto add_points = [&](const std::string& of, const std::vector<LonLat>& places) {
    const std::vector<Point> points = unit_vectors(places);
    for (const auto& [axis, coordinate] :
         {std::pair("x", &Point::x), std::pair("y", &Point::y), std::pair("z", &Point::z)}) {
      std::vector<double> values;
      for (const Point& p : points) values.push_back(p.*coordinate);
      file.add(axis + of, {{"n" + of, points.size()}}, values);
    }
  };
  const double pi = std::numbers::pi;
  add_points("Cell", {{60, 0}, {180, 0}, {300, 0}});
  add_points("Edge", {{0, 0}, {120, 45}, {120, -45}, {240, 45}, {240, -45}});
  add_points("Vertex", {{0, 90}, {0, -90}, {120, 0}, {240, 0}});
  file.add("areaCell", {{"nCell", 3}}, {4 * pi / 3, 4 * pi / 3, 4 * pi / 3});
  file.add("dcEdge", {{"nEdge", 5}}, std::vector<double>(5, 2 * pi / 3));
  file.add("dvEdge", {{"nEdge", 5}}, {pi, pi / 2, pi / 2, pi / 2, pi / 2});
  file.add("angleEdge", {{"nEdge", 5}}, std::vector<double>(5, 0));
  file.add("areaTriangle", {{"nVertex", 4}}, std::vector<double>(4, pi));
  file.add_whole("cellsOnEdge", {{"nEdge", 5}, {"two", 2}}, {3, 1, 1, 2, 1, 2, 2, 3, 2, 3});
  file.add_whole("verticesOnEdge", {{"nEdge", 5}, {"two", 2}}, {2, 1, 3, 1, 2, 3, 4, 1, 2, 4});
  file.write(path("three.nc"));
  EXPECT_EQ(file_error([&] { mesh::read_mpas(path("three.nc")); }),
            path("three.nc") + ": fewer than four cells do not cover a sphere");
}

// Huge coordinates overflowed in the report on quality.
TEST_F(MeshFiles, points_off_the_sphere_are_refused) {
  VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(50, 18)), {.radius = 6371229});
  mesh::write(path("m.nc"), arrays);
  std::string content = bytes("m.nc");
  const io::NetcdfReader file(content);
  content[file.require("yEdge").offset + sizeof(double) * 13] ^= 0x20;  // the exponent
  put("bad.nc", content);
  EXPECT_EQ(file_error([&] { mesh::read_mpas(path("bad.nc")); }),
            path("bad.nc") +
                ": variable \"xEdge\", value 13: the point is not on the sphere of sphere_radius");
}

TEST_F(MeshFiles, cells_that_are_not_those_of_their_centers_are_refused) {
  const VoronoiMesh arrays = mesh::make_mesh(delaunay(mesh_sites(60, 19)));
  VoronoiMesh moved = arrays;
  moved.cell_points[17] = normalized(moved.cell_points[17] + Point{0.01, 0.02, 0});
  mesh::write(path("m.nc"), moved, {.format = MeshFormat::ugrid});
  EXPECT_NE(file_error([&] { mesh::read_mesh(path("m.nc")); }).find("is not the Voronoi cell"),
            std::string::npos);
}

}  // namespace
}  // namespace rondel::test
