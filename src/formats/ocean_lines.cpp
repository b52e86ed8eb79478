// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "formats/ocean_lines.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "io/number.h"
#include "io/parallel_write.h"
#include "meshing/mesh_border.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/predicates.h"

namespace rondel::formats {
namespace {

using io::BadValue;

std::uint64_t line_of(const std::vector<std::uint64_t>& lines, std::size_t i) {
  return i < lines.size() ? lines[i] : 0;
}

// Turns triangles that are clockwise, and says so.
void turn_triangles(MeshInFile& file) {
  mesh::TriangleMesh& mesh = file.mesh;
  std::size_t num_turned = 0;
  for (Triple& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle;
    if (orientation(mesh.points[a], mesh.points[b], mesh.points[c]) != Sign::negative) continue;
    std::swap(triangle[1], triangle[2]);
    ++num_turned;
  }
  if (num_turned == 0) return;
  file.remarks.push_back(std::to_string(num_turned) + " of " +
                         std::to_string(mesh.triangles.size()) +
                         " triangles were clockwise seen from outside, and are turned");
}

// Throws BadValue with the line of the part that is not valid.
void require_valid_mesh(const MeshInFile& file) {
  const auto fault = meshing::fault_of(file.mesh, file.base);
  if (!fault) return;
  std::uint64_t line = 0;
  if (fault->part == meshing::MeshPart::node) line = line_of(file.node_lines, fault->index);
  if (fault->part == meshing::MeshPart::triangle) line = line_of(file.triangle_lines, fault->index);
  if (fault->part == meshing::MeshPart::segment) line = line_of(file.segment_lines, fault->index);
  throw BadValue(fault->text, line);
}

// Finds the segments of the border: open edges and coast.
void find_boundary(MeshInFile& file) {
  mesh::TriangleMesh& mesh = file.mesh;
  std::vector<std::array<Index, 2>> coast;
  std::size_t num_open = 0;
  for (const auto& [a, b] : meshing::border_of(mesh.points.size(), mesh.triangles)) {
    const std::array<Index, 2> edge = {std::min(a, b), std::max(a, b)};
    if (std::ranges::binary_search(file.open_edges, edge)) {
      ++num_open;
    } else {
      coast.push_back(edge);
    }
  }
  try {
    mesh.boundary = mesh::boundary_segments(mesh.points, mesh.triangles, coast);
  } catch (const InvalidInput& error) {  // of a mesh that is valid otherwise
    throw BadValue("triangles overlap around node " + std::to_string(error.index() + file.base),
                   line_of(file.node_lines, error.index()));
  }
  const std::size_t num_inner = file.open_edges.size() - num_open;
  if (num_inner == 0) return;
  file.remarks.push_back(std::to_string(num_inner) +
                         " edges of nodestrings are not on the border, and are left out");
}

}  // namespace

void OceanLines::require(const char* item, std::uint64_t index, std::uint64_t count) {
  if (next()) return;
  throw BadValue("the file ends before " + std::string(item) + ' ' + std::to_string(index + 1) +
                 " of " + std::to_string(count));
}

std::string_view OceanLines::word(std::size_t k, std::string_view what) const {
  if (k < words().size()) return words()[k];
  throw BadValue("the line ends before the " + std::string(what));
}

double OceanLines::number(std::size_t k, std::string_view what) const {
  const std::string_view found = word(k, what);
  if (found.find_first_of("dD") == std::string_view::npos) return io::parse_number(found, what);
  std::string text(found);
  for (char& c : text) {
    if (c == 'd' || c == 'D') c = 'e';
  }
  return io::parse_number(text, what);
}

std::int64_t OceanLines::integer(std::size_t k, std::string_view what) const {
  return io::parse_integer(word(k, what), what);
}

std::uint64_t OceanLines::count(std::size_t k, std::string_view what) const {
  const std::int64_t value = integer(k, what);
  if (value >= 0 && value < std::int64_t{no_index}) return static_cast<std::uint64_t>(value);
  throw BadValue(std::string(what) + ' ' + std::to_string(value) + " is negative or too large");
}

Index OceanLines::node(std::size_t k, std::size_t num_nodes) const {
  const std::int64_t value = integer(k, "number of a node");
  if (value >= 1 && static_cast<std::uint64_t>(value) <= num_nodes) {
    return static_cast<Index>(value - 1);
  }
  throw BadValue("node " + std::to_string(value) + " does not exist; there are " +
                 std::to_string(num_nodes) + " nodes, counted from 1");
}

void add_node(MeshInFile& file, double lon_deg, double lat_deg) {
  file.mesh.positions.push_back(io::checked_position(lon_deg, lat_deg, false));
}

void add_segment(MeshInFile& file, mesh::BoundarySegment segment) {
  std::vector<Index>& nodes = segment.nodes;
  const bool is_island = segment.kind == mesh::BoundaryKind::island;
  if (is_island && nodes.size() > 1 && nodes.front() == nodes.back()) nodes.pop_back();
  file.mesh.boundary.push_back(std::move(segment));
}

void drop_free_nodes(MeshInFile& file) {
  mesh::TriangleMesh& mesh = file.mesh;
  std::vector<Index> numbers(mesh.points.size(), no_index);
  for (const Triple& triangle : mesh.triangles) {
    for (const Index corner : triangle) numbers[corner] = 0;
  }
  const auto num_free = std::ranges::count(numbers, no_index);
  if (num_free == 0) return;
  Index num_kept = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == no_index) continue;
    mesh.points[num_kept] = mesh.points[i];
    if (!mesh.depths.empty()) mesh.depths[num_kept] = mesh.depths[i];
    if (!file.node_lines.empty()) file.node_lines[num_kept] = file.node_lines[i];
    numbers[i] = num_kept++;
  }
  mesh.points.resize(num_kept);
  if (!mesh.depths.empty()) mesh.depths.resize(num_kept);
  for (Triple& triangle : mesh.triangles) {
    for (Index& corner : triangle) corner = numbers[corner];
  }
  for (mesh::BoundarySegment& segment : mesh.boundary) {
    for (Index& node : segment.nodes) node = numbers[node];
  }
  file.remarks.push_back(std::to_string(num_free) + " nodes are in no triangle, and are left out");
}

void complete_mesh(MeshInFile& file) {
  mesh::TriangleMesh& mesh = file.mesh;
  if (mesh.triangles.empty()) throw BadValue("there are no triangles");
  if (!mesh.positions.empty()) mesh.points = unit_vectors(mesh.positions);
  if (std::ranges::all_of(mesh.depths, [](double depth) { return depth == 0; })) {
    mesh.depths.clear();
  }
  turn_triangles(file);
  require_valid_mesh(file);
  if (!file.has_boundary) find_boundary(file);
}

void NodeNames::sort() {
  std::ranges::sort(names_);
  const auto twice = std::ranges::adjacent_find(
      names_, [](const auto& one, const auto& other) { return one.first == other.first; });
  if (twice == names_.end()) return;
  throw BadValue("two nodes have the number " + std::to_string(twice->first));
}

Index NodeNames::operator[](std::int64_t name) const {
  const auto wanted = static_cast<std::uint64_t>(name);
  // Numbers are usually 1, 2, 3 ...
  if (wanted >= 1 && wanted <= names_.size() && names_[wanted - 1].first == wanted) {
    return names_[wanted - 1].second;
  }
  const auto found = std::ranges::lower_bound(names_, std::pair{wanted, Index{0}});
  if (name >= 0 && found != names_.end() && found->first == wanted) return found->second;
  throw BadValue("node " + std::to_string(name) + " does not exist");
}

void write_lines(io::AtomicFile& file, const Execution& execution, std::size_t count,
                 const std::function<void(std::string& text, std::size_t i)>& append) {
  io::write_in_parallel(file, execution.threads, count, io::items_per_piece,
                        [&](std::string& text, std::size_t begin, std::size_t end) {
                          for (std::size_t i = begin; i < end; ++i) {
                            append(text, i);
                            text += '\n';
                          }
                        });
}

void append_word(std::string& text, double value) {
  text += ' ';
  io::append_number(text, value);
}

void append_word(std::string& text, std::uint64_t value) {
  text += ' ';
  io::append_integer(text, value);
}

void append_nodes(std::string& text, std::span<const Index> nodes) {
  for (const Index node : nodes) append_word(text, std::uint64_t{node} + 1);
}

std::vector<Index> closed_nodes(const mesh::BoundarySegment& segment) {
  std::vector<Index> nodes = segment.nodes;
  if (segment.kind == mesh::BoundaryKind::island) nodes.push_back(nodes.front());
  return nodes;
}

}  // namespace rondel::formats
