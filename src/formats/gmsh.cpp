// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes Gmsh's text formats 4.1 and 2.2 (Gmsh reference manual, "MSH file format"). Segments are
// lines, each segment a curve of its own, in physical groups that are called open, land and island;
// triangles are a surface in the group domain. Depths are a view of the nodes, "depth".
#include <algorithm>
#include <array>
#include <string>

#include "formats/ocean_lines.h"
#include "io/number.h"

namespace rondel::formats {
namespace {

using mesh::BoundaryKind;
using mesh::BoundarySegment;

constexpr std::uint64_t domain_group = 4;
constexpr std::uint64_t line_type = 1;
constexpr std::uint64_t triangle_type = 2;

std::uint64_t group_of(BoundaryKind kind) { return static_cast<std::uint64_t>(kind) + 1; }

// Returns the number of lines of a segment.
std::size_t num_lines_of(const BoundarySegment& segment) {
  return segment.nodes.size() - (segment.kind == BoundaryKind::island ? 0 : 1);
}

std::string text_of_groups(const mesh::TriangleMesh& mesh) {
  std::array<bool, 3> is_used = {};
  for (const BoundarySegment& segment : mesh.boundary) {
    is_used[static_cast<std::size_t>(segment.kind)] = true;
  }
  const auto count = 1 + std::ranges::count(is_used, true);
  std::string text = "$PhysicalNames\n" + std::to_string(count) + '\n';
  for (std::size_t k = 0; k < is_used.size(); ++k) {
    const auto kind = static_cast<BoundaryKind>(k);
    if (!is_used[k]) continue;
    text += "1 " + std::to_string(group_of(kind)) + " \"" + std::string(name_of(kind)) + "\"\n";
  }
  return text + "2 " + std::to_string(domain_group) + " \"domain\"\n$EndPhysicalNames\n";
}

// Appends the box around nodes behind blanks.
void append_box(std::string& text, const std::vector<Point>& points, std::span<const Index> nodes) {
  Point low = points[nodes[0]];
  Point high = low;
  for (const Index node : nodes) {
    const Point& p = points[node];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  for (const double value : {low.x, low.y, low.z, high.x, high.y, high.z}) append_word(text, value);
}

// Writes a curve for each segment and a surface, with their groups.
void write_entities(io::AtomicFile& file, const MeshOfFile& mesh) {
  const std::vector<BoundarySegment>& boundary = mesh.mesh.boundary;
  file.write("$Entities\n0 " + std::to_string(boundary.size()) + " 1 0\n");
  write_lines(file, mesh.execution, boundary.size(), [&](std::string& text, std::size_t s) {
    io::append_integer(text, s + 1);
    append_box(text, mesh.mesh.points, boundary[s].nodes);
    text += " 1 " + std::to_string(group_of(boundary[s].kind)) + " 0";
  });
  std::vector<Index> all(mesh.mesh.points.size());
  for (Index i = 0; i < all.size(); ++i) all[i] = i;
  std::string text = "1";
  append_box(text, mesh.mesh.points, all);
  file.write(text + " 1 " + std::to_string(domain_group) + " 0\n$EndEntities\n");
}

void write_nodes4(io::AtomicFile& file, const MeshOfFile& mesh) {
  const std::vector<Point>& points = mesh.mesh.points;
  const std::string count = std::to_string(points.size());
  file.write("$Nodes\n1 " + count + " 1 " + count + "\n2 1 0 " + count + '\n');
  write_lines(file, mesh.execution, points.size(),
              [](std::string& text, std::size_t i) { io::append_integer(text, i + 1); });
  write_lines(file, mesh.execution, points.size(), [&](std::string& text, std::size_t i) {
    io::append_number(text, points[i].x);
    append_word(text, points[i].y);
    append_word(text, points[i].z);
  });
  file.write("$EndNodes\n");
}

void write_elements4(io::AtomicFile& file, const MeshOfFile& mesh) {
  const mesh::TriangleMesh& arrays = mesh.mesh;
  std::size_t count = arrays.triangles.size();
  for (const BoundarySegment& segment : arrays.boundary) count += num_lines_of(segment);
  file.write("$Elements\n" + std::to_string(arrays.boundary.size() + 1) + ' ' +
             std::to_string(count) + " 1 " + std::to_string(count) + '\n');
  std::size_t number = 1;
  for (std::size_t s = 0; s < arrays.boundary.size(); ++s) {
    const std::vector<Index> nodes = closed_nodes(arrays.boundary[s]);
    std::string text = "1 " + std::to_string(s + 1) + ' ' + std::to_string(line_type) + ' ' +
                       std::to_string(nodes.size() - 1) + '\n';
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      io::append_integer(text, number++);
      append_nodes(text, std::span(nodes).subspan(k - 1, 2));
      text += '\n';
    }
    file.write(text);
  }
  file.write("2 1 " + std::to_string(triangle_type) + ' ' +
             std::to_string(arrays.triangles.size()) + '\n');
  write_lines(file, mesh.execution, arrays.triangles.size(), [&](std::string& text, std::size_t t) {
    io::append_integer(text, number + t);
    append_nodes(text, arrays.triangles[t]);
  });
  file.write("$EndElements\n");
}

// Writes the depths as a view. Both formats have the same text.
void write_depths(io::AtomicFile& file, const MeshOfFile& mesh) {
  const std::vector<double>& depths = mesh.mesh.depths;
  if (depths.empty()) return;
  file.write("$NodeData\n1\n\"" + std::string(depth_view) + "\"\n1\n0\n3\n0\n1\n" +
             std::to_string(depths.size()) + '\n');
  write_lines(file, mesh.execution, depths.size(), [&](std::string& text, std::size_t i) {
    io::append_integer(text, i + 1);
    append_word(text, depths[i]);
  });
  file.write("$EndNodeData\n");
}

// Appends the number of an element of format 2.2, its type, its group, and its curve or surface.
void append_element2(std::string& text, std::uint64_t number, std::uint64_t type,
                     std::uint64_t group, std::uint64_t entity) {
  io::append_integer(text, number);
  append_word(text, type);
  text += " 2";
  append_word(text, group);
  append_word(text, entity);
}

void write_elements2(io::AtomicFile& file, const MeshOfFile& mesh) {
  const mesh::TriangleMesh& arrays = mesh.mesh;
  std::size_t count = arrays.triangles.size();
  for (const BoundarySegment& segment : arrays.boundary) count += num_lines_of(segment);
  file.write("$Elements\n" + std::to_string(count) + '\n');
  std::uint64_t number = 1;
  for (std::size_t s = 0; s < arrays.boundary.size(); ++s) {
    const std::vector<Index> nodes = closed_nodes(arrays.boundary[s]);
    std::string text;
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      append_element2(text, number++, line_type, group_of(arrays.boundary[s].kind), s + 1);
      append_nodes(text, std::span(nodes).subspan(k - 1, 2));
      text += '\n';
    }
    file.write(text);
  }
  write_lines(file, mesh.execution, arrays.triangles.size(), [&](std::string& text, std::size_t t) {
    append_element2(text, number + t, triangle_type, domain_group, 1);
    append_nodes(text, arrays.triangles[t]);
  });
  file.write("$EndElements\n");
}

}  // namespace

void write_gmsh4(io::AtomicFile& file, const MeshOfFile& mesh) {
  file.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + text_of_groups(mesh.mesh));
  if (!mesh.mesh.points.empty()) {
    write_entities(file, mesh);
    write_nodes4(file, mesh);
    write_elements4(file, mesh);
  }
  write_depths(file, mesh);
}

void write_gmsh2(io::AtomicFile& file, const MeshOfFile& mesh) {
  const std::vector<Point>& points = mesh.mesh.points;
  file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + text_of_groups(mesh.mesh) + "$Nodes\n" +
             std::to_string(points.size()) + '\n');
  write_lines(file, mesh.execution, points.size(), [&](std::string& text, std::size_t i) {
    io::append_integer(text, i + 1);
    append_word(text, points[i].x);
    append_word(text, points[i].y);
    append_word(text, points[i].z);
  });
  file.write("$EndNodes\n");
  write_elements2(file, mesh);
  write_depths(file, mesh);
}

}  // namespace rondel::formats
