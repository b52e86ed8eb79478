// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes of triangles: any bytes as a file of each format, and a file with some bytes changed, give a
// mesh that every format gives back, or one message; some faces of a triangulation have a border
// whose segments cover it once.
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/triangle_files.h"

namespace rondel::fuzz {
namespace {

using mesh::BoundaryKind;
using mesh::BoundarySegment;
using mesh::TriangleMesh;

constexpr std::array<const char*, 5> mesh_formats = {"gmsh", "gmsh2", "gr3", "2dm", "ugrid"};

std::string written(const TriangleMesh& mesh, const char* format) {
  std::string bytes;
  mesh::write_triangle_mesh(FileName::in_memory(bytes, format), mesh, {}, {.threads = 1});
  return bytes;
}

TriangleMesh read_from(std::string& bytes, const char* format) {
  return mesh::read_triangle_mesh(FileName::in_memory(bytes, format), {.threads = 1});
}

// A file that is written of what was read is read as the same, and the same bytes are written.
void expect_the_same_again(const TriangleMesh& mesh, const char* format) {
  if (mesh.points.empty()) return;
  try {
    std::string bytes = written(mesh, format);
    require(mesh::is_ugrid_of_triangles(FileName::in_memory(bytes, format)) ==
                (format == std::string("ugrid") && !mesh.triangles.empty()),
            "a file says that it is of triangles");
    const TriangleMesh again = read_from(bytes, format);
    require(again.triangles == mesh.triangles, "triangles come back");
    require(again.depths == mesh.depths, "depths come back");
    if (!mesh.boundary.empty()) {
      require(written(again, format) == bytes, "what is read is written as it was");
    }
  } catch (const FileError& error) {
    // Degrees that were computed for points, or points that are computed from degrees, are rounded:
    // thin triangles may become flat. Gmsh's points were not on a sphere.
    const bool has_degrees = !mesh.positions.empty();
    require(has_degrees == (format[0] == 'g' && format[1] == 'm') || !has_degrees, error.what());
  } catch (const InvalidInput& error) {
    const std::string what = error.what();
    require(what.find("area in degrees") != std::string::npos, what);
  }
}

void use_mesh(const TriangleMesh& mesh) {
  mesh::require_valid(mesh);
  for (const Index node : mesh::pinched_nodes(mesh)) require(node < mesh.points.size(), "a node");
  const mesh::TriangleQuality quality = mesh::triangle_quality(mesh);
  require(quality.shortest_edge <= quality.longest_edge && quality.smallest_angle_deg < 60.01,
          "no triangle has larger angles alone");
  if (!mesh.triangles.empty()) {
    const std::string picture = mesh::quality_picture(mesh, 3);
    require(picture.size() < 1'000'000 && picture.find("nan") == std::string::npos, "a picture");
  }
  if (!mesh.depths.empty()) {
    mesh::TriangleMesh deep = mesh;
    mesh::deepen(deep, 5);
    require(mesh::deepen(deep, 5) == 0 && std::ranges::min(deep.depths) >= 5, "depths");
  }
  for (const char* format : mesh_formats) expect_the_same_again(mesh, format);
  const FileName folder(std::string(".rondel-fuzz-fesom-not-there/") + "x", "ply");
  require(!mesh::can_write_triangle_mesh(folder) && !mesh::is_triangle_mesh_file(folder),
          "no format");
  require(mesh::has_nodes_in_degrees({"a", "gr3"}) && !mesh::has_nodes_in_degrees({"a", "gmsh"}),
          "Gmsh's nodes are in space");
}

void expect_mesh_or_message(std::string bytes, const char* format) {
  try {
    use_mesh(read_from(bytes, format));
  } catch (const FileError& error) {
    const std::string what = error.what();
    require(what.starts_with("<memory>"), "a message starts with the file: " + what);
    require(what.find('\n') == std::string::npos, "a message is one line: " + what);
  }
}

// The segments have each edge of the border once, with its triangle to the left.
void test_border(const TriangleMesh& mesh) {
  std::set<std::array<Index, 2>> border;
  for (const auto& [a, b, c] : mesh.triangles) {
    border.insert({std::array{a, b}, std::array{b, c}, std::array{c, a}});
  }
  std::erase_if(border, [all = border](const auto& edge) {
    return all.count({edge[1], edge[0]}) > 0;
  });
  for (const BoundarySegment& segment : mesh.boundary) {
    require(!name_of(segment.kind).empty(), "a segment has a kind");
    const std::size_t n = segment.nodes.size();
    for (std::size_t k = 0; k + (segment.kind == BoundaryKind::island ? 0 : 1) < n; ++k) {
      require(border.erase({segment.nodes[k], segment.nodes[(k + 1) % n]}) == 1,
              "an edge of the border is in one segment");
    }
  }
  require(border.empty(), "each edge of the border is in a segment");
}

// Some faces of the triangulation of sites, some of whose edges are coast.
void test_faces(const std::uint8_t* data, std::size_t size) {
  ByteSource source(data, size);
  std::array<std::uint8_t, 8> bits = {};
  for (std::uint8_t& byte : bits) byte = source.byte();
  const std::vector<Point> sites = all_sites(source, 40, Scales::near, {});
  const Triangulation triangulation = delaunay(sites);
  std::vector<Triple> faces;
  std::vector<std::array<Index, 2>> coast;
  for (std::size_t f = 0; f < triangulation.num_faces(); ++f) {
    const bool is_out = (bits[f / 8 % 4] >> (f % 8) & 1U) != 0;
    if (is_out || triangulation.is_ghost(static_cast<Index>(f))) continue;
    faces.push_back(triangulation.faces()[f]);
    if ((bits[4 + f / 8 % 4] >> (f % 8) & 1U) == 0)
      coast.push_back({faces.back()[1], faces.back()[0]});
  }
  const TriangleMesh mesh = mesh::triangle_mesh(sites, {}, faces, coast);
  test_border(mesh);
  test_border({mesh.points,
               {},
               mesh.triangles,
               {},
               {},
               mesh::boundary_segments(mesh.points, mesh.triangles)});
}

// Sites of whole degrees, whose triangles are flat or not by integers: on the border none is left that
// could be left out, inside all stay, and a file has triangles with an area or is refused.
void test_flat_triangles(const std::uint8_t* data, std::size_t size) {
  ByteSource source(data, size);
  std::vector<LonLat> positions;
  while (!source.is_empty() && positions.size() < 40) {
    const auto degree = [&] { return static_cast<double>(source.below(9)) - 4; };
    const double lon = degree();
    positions.push_back({10 * lon, 10 * degree()});
  }
  const Triangulation triangulation = delaunay(unit_vectors(positions));
  std::vector<Triple> faces;
  for (Index f = 0; f < triangulation.num_faces(); ++f) {
    if (!triangulation.is_ghost(f)) faces.push_back(triangulation.faces()[f]);
  }
  const std::vector<Triple> all = faces;
  const std::size_t number = mesh::leave_out_flat(positions, faces);
  require(faces.size() + number == all.size(), "each triangle stays or is left out");
  const auto area = [&](const Triple& t) {
    const LonLat& a = positions[t[0]];
    const LonLat& b = positions[t[1]];
    const LonLat& c = positions[t[2]];
    return (b.lon_deg - a.lon_deg) * (c.lat_deg - a.lat_deg) -
           (b.lat_deg - a.lat_deg) * (c.lon_deg - a.lon_deg);
  };
  for (const Triple& t : all) {
    const bool stays = std::ranges::find(faces, t) != faces.end();
    require(stays || area(t) <= 0, "a triangle with an area stays");
  }
  if (faces.empty()) return;
  const bool has_flat = std::ranges::any_of(faces, [&](const Triple& t) { return area(t) == 0; });
  const TriangleMesh mesh = mesh::triangle_mesh(unit_vectors(positions), positions, faces);
  bool is_refused = false;
  try {
    (void)written(mesh, "gr3");
  } catch (const InvalidInput&) {
    is_refused = true;
  }
  require(is_refused == has_flat, "a file without flat triangles is written");
}

// A file of a square with an island, some bytes of which are changed.
void test_changed_file(const std::uint8_t* data, std::size_t size) {
  const std::vector<LonLat> positions = {{0, 0}, {9, 0}, {0, 9}, {2, 2}, {4, 2}, {2, 4}};
  const std::vector<Triple> triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5},
                                         {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  TriangleMesh mesh =
      mesh::triangle_mesh(unit_vectors(positions), positions, triangles,
                          std::vector<std::array<Index, 2>>{{1, 2}, {3, 4}, {4, 5}, {5, 3}});
  mesh.depths = {1, 2, 3, 4, 5, 6.25};
  const char* const format = mesh_formats[size == 0 ? 0 : data[0] % mesh_formats.size()];
  std::string bytes = written(mesh, format);
  for (std::size_t at = 1; at + 3 <= size; at += 3) {
    const std::size_t place = (data[at] + 256U * data[at + 1]) % bytes.size();
    bytes[place] = static_cast<char>(data[at + 2]);
  }
  expect_mesh_or_message(bytes, format);
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel::fuzz;
  for (const char* format : mesh_formats) {
    expect_mesh_or_message({reinterpret_cast<const char*>(data), size}, format);
  }
  test_changed_file(data, size);
  test_faces(data, size);
  test_flat_triangles(data, size);
  return 0;
}
