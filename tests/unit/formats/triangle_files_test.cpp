// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files of meshes of triangles: what is written is read back bit by bit, and what other programs
// write is read as they mean it.
#include "rondel/triangle_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>

#include "inputs/random.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_size_files.h"
#include "support/temporary_files.h"
#include "support/thrown.h"
#include "unit/meshing/triangle_meshes.h"

namespace rondel::test {
namespace {

using mesh::BoundaryKind;
using mesh::BoundarySegment;
using mesh::TriangleMesh;
using Remarks = std::vector<std::string>;

std::string text_of(const TriangleMesh& mesh, const std::string& format, unsigned threads = 1) {
  std::string bytes;
  mesh::write_triangle_mesh(FileName::in_memory(bytes, format), mesh, {}, {.threads = threads});
  return bytes;
}

TriangleMesh mesh_in(std::string text, const std::string& format, Remarks* remarks = nullptr) {
  return mesh::read_triangle_mesh(FileName::in_memory(text, format), {}, remarks);
}

// True if numbers have the same bits, where == takes -0 for 0.
bool same_bits(std::span<const double> a, std::span<const double> b) {
  return std::ranges::equal(a, b, [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

std::span<const double> numbers_of(const std::vector<LonLat>& positions) {
  if (positions.empty()) return {};
  return {&positions.front().lon_deg, 2 * positions.size()};
}

// A mesh without what a format cannot hold.
TriangleMesh held_by(const std::string& format, TriangleMesh mesh) {
  if (format != "fesom") mesh.levels.clear();
  if (format.starts_with("gmsh") || format == "msh") mesh.positions.clear();
  const bool has_types = format == "14" || format == "gr3" || format == "ll" || format == "ugrid";
  for (BoundarySegment& segment : mesh.boundary) {
    if (!has_types) segment.type.reset();
  }
  if (format == "fesom") mesh.boundary = mesh::boundary_segments(mesh.points, mesh.triangles);
  return mesh;
}

// Returns a file of Gmsh 2.2 with groups of curves and more elements, each without its number.
std::string with_lines(std::string text, const std::vector<std::string>& lines) {
  const std::string begin = "$Elements\n";
  const std::size_t at = text.find(begin) + begin.size();
  std::size_t number = std::stoul(text.substr(at));
  std::string elements;
  for (const std::string& line : lines) elements += std::to_string(++number) + line;
  text.insert(text.find("$EndElements"), elements);
  text.replace(at, text.find('\n', at) - at, std::to_string(number));
  const std::string names =
      "$PhysicalNames\n3\n1 1 \"open\"\n1 2 \"land\"\n1 3 \"island\"\n$EndPhysicalNames\n";
  return text.insert(text.find("$Nodes"), names);
}

// Returns the edges of the border with their kinds, the lower node first, sorted.
std::vector<std::tuple<BoundaryKind, Index, Index>> edges_of(const TriangleMesh& mesh) {
  std::vector<std::tuple<BoundaryKind, Index, Index>> edges;
  for (const auto& [kind, nodes, type] : mesh.boundary) {
    const bool is_island = kind == BoundaryKind::island;
    for (std::size_t k = 0; k + (is_island ? 0 : 1) < nodes.size(); ++k) {
      const auto [low, high] = std::minmax(nodes[k], nodes[(k + 1) % nodes.size()]);
      edges.emplace_back(kind, low, high);
    }
  }
  std::ranges::sort(edges);
  return edges;
}

TriangleMesh typed_mesh() {
  TriangleMesh mesh = arctic_mesh(11);
  for (BoundarySegment& segment : mesh.boundary) {
    if (segment.kind == BoundaryKind::island) segment.type = 21;
    if (segment.kind == BoundaryKind::land) segment.type = 20;
  }
  mesh.boundary.front().type = 3;
  std::ranges::reverse(mesh.boundary.back().nodes);
  return mesh;
}

const std::vector<std::string> text_formats = {"msh", "gmsh2", "14", "gr3", "ll", "2dm", "ugrid"};

TEST(triangle_files, come_back_bit_by_bit) {
  std::vector<TriangleMesh> meshes = {arctic_mesh(4), global_mesh(5), typed_mesh()};
  for (const TriangleMesh& mesh : meshes) {
    for (const std::string& format : text_formats) {
      SCOPED_TRACE(format);
      const std::string text = text_of(mesh, format);
      EXPECT_EQ(text, text_of(mesh, format, 3));
      Remarks remarks;
      const TriangleMesh read = mesh_in(text, format, &remarks);
      const TriangleMesh expected = held_by(format, mesh);
      EXPECT_TRUE(read == expected);
      EXPECT_TRUE(same_bits(numbers_of(read.positions), numbers_of(expected.positions)));
      EXPECT_TRUE(same_bits(read.depths, expected.depths));
      EXPECT_EQ(text_of(read, format), text) << "written again";
      EXPECT_TRUE(remarks.empty()) << remarks[0];
    }
  }
}

TEST(triangle_files, have_triangles) {
  const TemporaryDirectory folder;
  for (const std::string format : {"msh", "gmsh2", "14", "gr3", "ll", "2dm", "ugrid", "fesom"}) {
    EXPECT_EQ(thrown_message<InvalidInput>([&] {
                mesh::write_triangle_mesh({folder.file("a"), format}, TriangleMesh{});
              }),
              "there are no triangles");
  }
  EXPECT_FALSE(std::filesystem::exists(folder.file("a")));
  for (const auto& file : std::vector<std::pair<std::string, std::string>>{
           {"msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"},
           {"gr3", "title\n0 0\n"},
           {"2dm", "MESH2D\nND 1 0 0 0\n"}}) {
    EXPECT_EQ(thrown_message<FileError>([&] { mesh_in(file.second, file.first); }),
              "<memory>: there are no triangles");
  }
}

TEST(triangle_files, of_fesom_come_back_bit_by_bit) {
  const TemporaryDirectory folder;
  for (TriangleMesh mesh : {arctic_mesh(6), global_mesh(7)}) {
    const std::string path = folder.file("a/b");
    mesh::write_triangle_mesh({path, "fesom"}, mesh);
    EXPECT_TRUE(mesh::is_triangle_mesh_file(path));
    Remarks remarks;
    EXPECT_TRUE(mesh::read_triangle_mesh(path, {}, &remarks) == held_by("fesom", mesh));
    EXPECT_TRUE(mesh::read_triangle_mesh(path + "/nod2d.out") == held_by("fesom", mesh));
    EXPECT_TRUE(remarks.empty());
    mesh.levels.clear();
    mesh::write_triangle_mesh(path + "/", mesh);
    EXPECT_TRUE(mesh::read_triangle_mesh(path) == held_by("fesom", mesh));
  }
  TriangleMesh mesh = arctic_mesh(6);
  mesh.depths[5] = -1;
  EXPECT_EQ(thrown_index([&] {
              mesh::write_triangle_mesh({folder.file("new"), "fesom"}, mesh);
              return 0;
            }),
            5U);
  EXPECT_FALSE(std::filesystem::exists(folder.file("new")));
}

// What a mesh lacks when it is read again is what the writer told.
TEST(triangle_files, tell_what_they_do_not_hold) {
  const TemporaryDirectory folder;
  TriangleMesh eastern = arctic_mesh(4);  // longitudes from 0 to 360
  for (LonLat& place : eastern.positions) place.lon_deg += place.lon_deg < 0 ? 360 : 0;
  eastern.points = unit_vectors(eastern.positions);
  for (const TriangleMesh& mesh : {arctic_mesh(4), global_mesh(5), typed_mesh(), eastern}) {
    for (const char* const format : {"msh", "gmsh2", "14", "gr3", "2dm", "ugrid", "fesom"}) {
      SCOPED_TRACE(format);
      const FileName file = {folder.file(format), format};
      Remarks remarks = {"old"};
      mesh::write_triangle_mesh(file, mesh, {}, {}, &remarks);
      const TriangleMesh read = mesh::read_triangle_mesh(file);
      const auto is_told = [&](const std::string& word) {
        return std::ranges::any_of(remarks, [&](const std::string& remark) {
          return remark.find(word) != std::string::npos;
        });
      };
      const auto num_open = [](const TriangleMesh& any) {
        return std::ranges::count(any.boundary, BoundaryKind::open, &BoundarySegment::kind);
      };
      const auto num_types = [](const TriangleMesh& any) {
        return std::ranges::count_if(any.boundary,
                                     [](const auto& one) { return one.type.has_value(); });
      };
      EXPECT_EQ(is_told("levels"), read.levels != mesh.levels);
      EXPECT_EQ(is_told("IBTYPE"), num_types(read) != num_types(mesh));
      EXPECT_EQ(is_told("open segments"), num_open(read) != num_open(mesh));
      const auto has_longitudes = [&](double east) {
        return std::ranges::any_of(
            mesh.positions, [&](const LonLat& place) { return std::abs(place.lon_deg) > east; });
      };
      EXPECT_EQ(is_told("x, y, z"), read.positions.empty() && has_longitudes(180));
      EXPECT_FALSE(is_told("old"));
      EXPECT_TRUE(read.positions.empty() || read.positions == mesh.positions);
    }
  }
}

// The depths at places between the nodes are those that a table, or features, of the nodes give.
TEST(triangle_files, are_depths_for_other_meshes) {
  const TemporaryDirectory folder;
  const TriangleMesh mesh = arctic_mesh(4);
  std::string table = "lon,lat,z\n";
  std::string features;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    std::ostringstream place;
    place << std::setprecision(17) << mesh.positions[i].lon_deg << ',' << mesh.positions[i].lat_deg;
    std::ostringstream depth;
    depth << std::setprecision(17) << mesh.depths[i];
    table += place.str() + ',' + depth.str() + '\n';
    features += std::string(i == 0 ? "" : ",") + R"({"type":"Feature","properties":{"z":)" +
                depth.str() + R"(},"geometry":{"type":"Point","coordinates":[)" + place.str() +
                "]}}";
  }
  std::vector<Point> places;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point& p = mesh.points[a];
    const Point& q = mesh.points[b];
    const Point& r = mesh.points[c];
    const Point sum = {p.x + q.x + r.x, p.y + q.y + r.y, p.z + q.z + r.z};
    const double length = std::hypot(sum.x, sum.y, sum.z);
    places.push_back({sum.x / length, sum.y / length, sum.z / length});
  }
  const auto depths = [&](const FileName& file, const std::string& name = {}) {
    return mesh::read_heights(file, name, mesh::Positive::down, places);
  };
  const std::vector<double> expected = depths(folder.with("a.csv", table), "z");
  const std::string geojson =
      folder.with("a.geojson", R"({"type":"FeatureCollection","features":[)" + features + "]}");
  EXPECT_EQ(depths(geojson, "z"), expected);
  for (const char* const name : {"a.14", "a.gr3", "a.2dm", "a.nc"}) {
    mesh::write_triangle_mesh(folder.file(name), mesh);
    EXPECT_EQ(depths(folder.file(name), name == std::string("a.2dm") ? "depth" : ""), expected);
  }
  mesh::write_triangle_mesh({folder.file("f"), "fesom"}, mesh);
  EXPECT_EQ(depths(folder.file("f")), expected);

  const auto refused = [&](const std::string& file, const std::string& name,
                           mesh::Positive positive = mesh::Positive::down) {
    const std::string path = folder.file(file);
    const std::string text =
        thrown_message<FileError>([&] { return mesh::read_heights(path, name, positive, places); });
    return text.substr(std::min(path.size(), text.size()));
  };
  EXPECT_EQ(refused("a.14", "z"), ": a mesh of triangles has depths, and no \"z\"");
  EXPECT_EQ(refused("a.14", "", mesh::Positive::up),
            ": a mesh of triangles has depths, where heights are wanted: --depth reads it");
  EXPECT_EQ(refused("a.geojson", "depth"), ": no feature has the property \"depth\"");
  EXPECT_EQ(refused("a.geojson", ""), ": which property is meant is not said");
  static_cast<void>(folder.with("b.geojson",
                                R"({"type":"Feature","properties":{"z":"deep"},"geometry":)"
                                R"({"type":"Point","coordinates":[1,2]}})"));
  EXPECT_EQ(refused("b.geojson", "z"), ":1: z \"deep\" is not a number");
  TriangleMesh flat = mesh;
  flat.depths.clear();
  mesh::write_triangle_mesh(folder.file("flat.14"), flat);
  EXPECT_EQ(refused("flat.14", ""), ": the mesh has no depths");
  EXPECT_THROW((void)mesh::read_spacings(folder.file("a.14"), "", 1), FileError);
}

TEST(triangle_files, of_fesom_name_files_that_are_left_out) {
  const TemporaryDirectory folder;
  const TriangleMesh mesh = arctic_mesh(6);
  mesh::write_triangle_mesh({folder.file("a"), "fesom"}, mesh);
  for (const char* const name : {"a/nlvls.out", "a/elvls.out", "a/edges.out"}) {
    static_cast<void>(folder.with(name, "1\n"));
  }
  Remarks remarks;
  static_cast<void>(mesh::read_triangle_mesh(folder.file("a"), {}, &remarks));
  EXPECT_EQ(remarks, Remarks{"left out, as they are no part of the mesh: elvls.out, nlvls.out"});
}

TEST(triangle_mesh, becomes_as_deep_as_wanted) {
  TriangleMesh mesh = arctic_mesh(6);
  mesh.depths.front() = -3;
  const std::vector<double> before = mesh.depths;
  std::vector<double> sorted = before;
  std::ranges::sort(sorted);
  const double least = sorted[sorted.size() / 3];
  EXPECT_EQ(mesh::deepen(mesh, least),
            static_cast<std::size_t>(std::ranges::lower_bound(sorted, least) - sorted.begin()));
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(mesh.depths[i], before[i] < least ? least : before[i]);
  }
  EXPECT_EQ(mesh::deepen(mesh, least), 0U);
  EXPECT_THROW(mesh::deepen(mesh, std::numeric_limits<double>::quiet_NaN()), InvalidInput);
  mesh.depths.clear();
  EXPECT_THROW(mesh::deepen(mesh, 1), InvalidInput);
}

TEST(triangle_files, of_points_without_degrees_have_those_of_lonlats_or_shorter_ones) {
  TriangleMesh mesh = global_mesh(8);
  mesh.positions.clear();
  EXPECT_TRUE(mesh_in(text_of(mesh, "msh"), "msh") == mesh);
  const std::vector<LonLat> positions = mesh_in(text_of(mesh, "gr3"), "gr3").positions;
  const std::vector<LonLat> usual = lonlats(mesh.points);
  const std::vector<Point> points = unit_vectors(positions);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_TRUE(positions[i] == usual[i] || points[i] == mesh.points[i]);
  }
  for (Point& p : mesh.points) p = {6371229 * p.x, 6371229 * p.y, 6371229 * p.z};
  EXPECT_TRUE(mesh_in(text_of(mesh, "gmsh2"), "gmsh") == mesh);
}

TEST(triangle_files, without_segments_have_a_border_of_land) {
  TriangleMesh mesh = arctic_mesh(9);
  mesh.boundary.clear();
  for (const char* format : {"msh", "2dm", "ugrid"}) {
    EXPECT_EQ(mesh_in(text_of(mesh, format), format).boundary,
              mesh::boundary_segments(mesh.points, mesh.triangles));
  }
  EXPECT_TRUE(mesh_in(text_of(mesh, "gr3"), "gr3").boundary.empty());
}

// ADCIRC's words behind numbers, Fortran's exponents, an island that is closed, a weir, and lines
// that end with CR LF.
TEST(triangle_files, of_adcirc_are_read_as_adcirc_reads_them) {
  const std::string text =
      "\r\n4 5   ! NE NP\r\n1 0.0d0 0 1.0D+01\r\n2 2 0 2\r\n3 2 2 3\r\n4 0 2 4\r\n5 1.0 1.0 5 "
      "more\r\n"
      "1 3 1 2 5\r\n2 3 2 3 5\r\n3 3 5 3 4\r\n4 3 4 1 5\r\n"
      "1 = Number of open boundaries\r\n2 = Total\r\n2 = Number of nodes for open boundary "
      "1\r\n1\r\n"
      "2 a comment\r\n2\r\n4\r\n2 24\r\n2 4 1.5 1 1\r\n3 1 1.5 1 1\r\n2 10\r\n1 \r\n4\r\n";
  Remarks remarks;
  const TriangleMesh mesh = mesh_in(text, "14", &remarks);
  EXPECT_EQ(mesh.positions[0], (LonLat{0, 0}));
  EXPECT_EQ(mesh.depths, (std::vector<double>{10, 2, 3, 4, 5}));
  ASSERT_EQ(mesh.boundary.size(), 4U);
  EXPECT_EQ(mesh.boundary[0], (BoundarySegment{BoundaryKind::open, {0, 1}}));
  EXPECT_EQ(mesh.boundary[1], (BoundarySegment{BoundaryKind::land, {1, 2}}));
  EXPECT_EQ(mesh.boundary[2], (BoundarySegment{BoundaryKind::land, {3, 0}}));
  EXPECT_EQ(mesh.boundary[3], (BoundarySegment{BoundaryKind::land, {0, 3}, 10}));
  EXPECT_EQ(remarks, Remarks{"1 boundaries with numbers at their nodes (weirs, pipes) are read as "
                             "land, without the numbers"});
  const std::string island =
      "x\n6 6\n1 0 0 0\n2 9 0 0\n3 0 9 0\n4 2 2 0\n5 4 2 0\n6 2 4 0\n1 3 1 2 5\n2 3 1 5 4\n3 3 2 3 "
      "6\n"
      "4 3 2 6 5\n5 3 3 1 4\n6 3 3 4 6\n0\n0\n1\n4\n4 21\n4\n6\n5\n4\n";
  const TriangleMesh ring = mesh_in(island, "adcirc");
  EXPECT_EQ(ring.boundary.at(0), (BoundarySegment{BoundaryKind::island, {3, 5, 4}, 21}));
  EXPECT_TRUE(ring.depths.empty());
  // A file of SCHISM that ends before the boundaries.
  EXPECT_EQ(mesh_in(island.substr(0, island.find("0\n0\n1\n4\n")), "gr3").boundary.size(), 3U);
}

TEST(triangle_files, of_adcirc_tell_what_is_behind_their_end) {
  const std::string text = "t\n1 3\n1 0 0 5\n2 1 0 6\n3 1 1 7\n1 3 1 2 3\n0\n0\n1\n2\n2 0\n1\n2\n";
  Remarks remarks;
  EXPECT_EQ(mesh_in(text + "made by hand\n", "14", &remarks).boundary.size(), 1U);
  EXPECT_EQ(remarks, Remarks{});
  EXPECT_EQ(mesh_in(text + "notes\n2 0\n2\n3\n", "14", &remarks).boundary.size(), 1U);
  EXPECT_EQ(remarks, Remarks{"line 15 and what follows it are not read: the number of land "
                             "boundaries says that the last one ended before"});
}

// Gmsh has lines curve by curve; an island has several curves, of any direction, where it was drawn so.
TEST(triangle_files, of_gmsh_join_the_curves_of_islands) {
  const TriangleMesh mesh = arctic_mesh(6);
  ASSERT_TRUE(std::ranges::count(mesh.boundary, BoundaryKind::island, &BoundarySegment::kind) > 0);
  TriangleMesh without_boundary = held_by("gmsh2", mesh);
  without_boundary.boundary.clear();
  const std::string text = text_of(without_boundary, "gmsh2");
  inputs::Random random(3);
  for (int turn = 0; turn < 20; ++turn) {
    std::vector<std::string> lines;
    std::int64_t curve = 0;
    for (const BoundarySegment& segment : mesh.boundary) {
      const bool is_island = segment.kind == BoundaryKind::island;
      ++curve;
      for (std::size_t k = 0; k + (is_island ? 0 : 1) < segment.nodes.size(); ++k) {
        if (is_island && random.next() % 3 == 0) ++curve;
        std::array<Index, 2> ends = {segment.nodes[k],
                                     segment.nodes[(k + 1) % segment.nodes.size()]};
        if (random.next() % 3 == 0) std::swap(ends[0], ends[1]);
        const int group = is_island ? 3 : (segment.kind == BoundaryKind::open ? 1 : 2);
        lines.push_back(" 1 2 " + std::to_string(group) + ' ' + std::to_string(curve) + ' ' +
                        std::to_string(ends[0] + 1) + ' ' + std::to_string(ends[1] + 1) + '\n');
      }
    }
    for (std::size_t i = lines.size(); i > 1; --i) {
      std::swap(lines[i - 1], lines[random.next() % i]);
    }
    const TriangleMesh read = mesh_in(with_lines(text, lines), "gmsh2");
    EXPECT_EQ(edges_of(read), edges_of(mesh)) << turn;
    EXPECT_EQ(read.boundary.size(), mesh.boundary.size());
  }
}

// Curves of 4.1 may be in several groups, and those of a mesh in partitions are listed elsewhere.
TEST(triangle_files, of_gmsh_find_the_group_that_is_a_kind_of_boundary) {
  const std::string begin =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"coastline\"\n1 2 "
      "\"land\"\n2 3 \"water\"\n$EndPhysicalNames\n$Entities\n0 1 1 0\n7 0 0 0 1 1 0 ";
  const std::string surface = "8 0 0 0 1 1 1 1 3 1 7\n$EndEntities\n";
  const std::string end =
      "$Nodes\n1 3 1 3\n2 8 0 3\n1\n2\n3\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n2 2 1 2\n1 7 "
      "1 1\n1 1 2\n2 8 2 1\n2 1 2 3\n$EndElements\n";
  const std::vector<BoundarySegment> land = {{BoundaryKind::land, {0, 1}}};
  EXPECT_EQ(mesh_in(begin + "2 1 2 0\n" + surface + end, "msh").boundary, land);
  EXPECT_EQ(mesh_in(begin + "2 2 1 0\n" + surface + end, "msh").boundary, land);
  const std::string parts =
      "$PartitionedEntities\n2\n1\n9 1\n1 1 0 0\n3 0 1 1 1 0 0 0 0\n7 1 6 2 1 2 0 0 0 1 1 0 2 1 2 "
      "0\n"
      "$EndPartitionedEntities\n";
  EXPECT_EQ(mesh_in(begin + "0 0\n" + surface + parts + end, "msh").boundary, land);
}

// Four nodes near one parallel: the triangle between three of them is on the sphere to the north of it.
TEST(triangle_files, in_degrees_tell_of_triangles_that_are_clockwise_there) {
  const std::vector<LonLat> positions = {{0, 60}, {30, 60.2}, {60, 60}, {30, 70}, {30, 40}};
  const std::vector<Triple> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {1, 4, 2}};
  const TriangleMesh mesh = mesh::triangle_mesh(unit_vectors(positions), positions, triangles);
  for (const auto& [format, number] :
       std::map<std::string, std::size_t>{{"14", 1}, {"2dm", 1}, {"msh", 0}, {"ugrid", 0}}) {
    std::string bytes;
    Remarks remarks;
    mesh::write_triangle_mesh(FileName::in_memory(bytes, format), mesh, {}, {}, &remarks);
    EXPECT_EQ(std::ranges::count(remarks,
                                 "1 of 4 triangles is clockwise in the plane of longitude and "
                                 "latitude, where some models compute"),
              number)
        << format;
  }
}

// Nodestrings without kinds are open water; numbers have gaps; a triangle is clockwise.
TEST(triangle_files, of_sms_are_read_with_any_numbers) {
  const std::string text =
      "MESH2D\nMESHNAME \"a\"\nE3T 7 10 5 30 1\nE3T 8 30 20 10 1\nND 10 0 0 -5\nND 20 1 0 -6\n"
      "ND 30 1 1 2.5\nND 5 0 1 0\nNS 10\nNS 20 -30 1\nNS 10 -30 2\nBEGPARAMDEF\n";
  Remarks remarks;
  const TriangleMesh mesh = mesh_in(text, "2dm", &remarks);
  EXPECT_EQ(mesh.triangles, (std::vector<Triple>{{0, 2, 3}, {2, 0, 1}}));
  EXPECT_EQ(mesh.depths, (std::vector<double>{5, 6, -2.5, 0}));
  ASSERT_EQ(mesh.boundary.size(), 2U);
  EXPECT_EQ(mesh.boundary[0], (BoundarySegment{BoundaryKind::open, {0, 1, 2}}));
  EXPECT_EQ(mesh.boundary[1], (BoundarySegment{BoundaryKind::land, {2, 3, 0}}));
  EXPECT_EQ(remarks.size(), 3U);
  const std::string kinds =
      "MESH2D\nE3T 1 1 2 3 1\nND 1 0 0 1\nND 2 1 0 1\nND 3 0 1 1\nNS 1 -2 1 \"land\"\nNS 2 3 -1 2 "
      "open\n";
  EXPECT_EQ(mesh_in(kinds, "2dm").boundary,
            (std::vector<BoundarySegment>{{BoundaryKind::land, {0, 1}},
                                          {BoundaryKind::open, {1, 2, 0}}}));
}

// What Gmsh writes: points as elements, nodes without triangles, other groups.
TEST(triangle_files, of_gmsh_are_read_with_any_numbers) {
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 5 \"Open\"\n1 6 \"my coast\"\n2 "
      "9 "
      "\"sea\"\n$EndPhysicalNames\n$Entities\n1 2 1 0\n1 0 0 0 0\n1 0 0 0 1 1 1 1 5 2 1 -1\n2 0 0 "
      "0 1 1 "
      "1 1 6 0\n1 0 0 0 1 1 1 1 9 0\n$EndEntities\n$Nodes\n2 4 2 77\n0 1 0 1\n2\n0 0 0\n2 1 0 "
      "3\n10\n"
      "77\n11\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n4 4 1 4\n0 1 15 1\n1 2\n1 1 1 1\n2 10 "
      "77\n"
      "1 2 1 1\n3 77 11\n2 1 2 1\n4 10 77 11\n$EndElements\n$Periodic\n0\n$EndPeriodic\n";
  Remarks remarks;
  const TriangleMesh mesh = mesh_in(text, "msh", &remarks);
  EXPECT_EQ(mesh.points, (std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh.boundary, (std::vector<BoundarySegment>{{BoundaryKind::open, {0, 1}}}));
  EXPECT_EQ(remarks.size(), 2U);
}

TEST(triangle_files, of_gmsh_tell_of_nodes_without_a_depth) {
  const auto read = [](const std::string& values) {
    const std::string text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 -1 0 0\n"
        "$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 "
        "3\n$EndElements\n$NodeData\n1\n\"depth\"\n1\n0\n3\n0\n1\n" +
        values + "$EndNodeData\n";
    Remarks remarks;
    const TriangleMesh mesh = mesh_in(text, "msh", &remarks);
    std::erase_if(remarks, [](const std::string& remark) {
      return remark.find("depth") == std::string::npos;
    });
    return std::pair(mesh.depths, remarks);
  };
  const auto all = read("3\n1 5\n3 7\n2 6\n");
  EXPECT_EQ(all.first, (std::vector<double>{5, 6, 7}));
  EXPECT_EQ(all.second, Remarks{});
  const auto some = read("3\n1 5\n4 8\n1 5.5\n");
  EXPECT_EQ(some.first, (std::vector<double>{5.5, 0, 0}));
  EXPECT_EQ(some.second,
            Remarks{"2 nodes have no depth in the view of depths, and get the depth 0"});
  EXPECT_EQ(read("2\n1 5\n3 8\n").second,
            Remarks{"1 node has no depth in the view of depths, and gets the depth 0"});
}

TEST(triangle_files, appear_complete_or_not_at_all) {
  const TemporaryDirectory folder;
  TriangleMesh mesh = arctic_mesh(10);
  const std::string before = folder.with("mesh.gr3", "before");
  mesh.triangles[0] = {0, 0, 0};
  EXPECT_NE(thrown_message<InvalidInput>([&] {
              mesh::write_triangle_mesh(before, mesh);
              return 0;
            }),
            "");
  std::ifstream in(before);
  EXPECT_TRUE(std::string(std::istreambuf_iterator<char>(in), {}) == "before");
  EXPECT_EQ(folder.num_files(), 1U);
}

TEST(triangle_files, are_known_by_name_and_format) {
  for (const char* name : {"a.msh", "fort.14", "hgrid.gr3", "hgrid.LL", "a.2dm", "x/nod2d.out"}) {
    EXPECT_TRUE(mesh::is_triangle_mesh_file(name)) << name;
  }
  EXPECT_FALSE(mesh::is_triangle_mesh_file("a.nc"));
  EXPECT_TRUE(mesh::can_write_triangle_mesh("a.nc"));
  EXPECT_TRUE(mesh::can_write_triangle_mesh({"a", "fesom"}));
  EXPECT_FALSE(mesh::can_write_triangle_mesh("a.ply"));
  EXPECT_FALSE(mesh::can_write_triangle_mesh("a.exo"));
  EXPECT_EQ(thrown_message<FileError>([] { return mesh_in("", "ply"); }),
            "<memory>: unknown format \"ply\"; meshes of triangles are read from .msh .14 .gr3 .ll "
            ".2dm .nc");
}

}  // namespace
}  // namespace rondel::test
