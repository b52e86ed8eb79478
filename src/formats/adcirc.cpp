// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// ADCIRC's fort.14 and SCHISM's hgrid.gr3, one format: a line of text, the numbers of elements and
// nodes, nodes (number, longitude, latitude, depth), elements (number, 3, three nodes), open
// boundaries, other boundaries with the number of their type. Words behind the numbers of a line are
// comments. SCHISM needs boundaries in hgrid.gr3 only: a file may end before them.
#include <algorithm>
#include <string>

#include "formats/ocean_lines.h"
#include "io/number.h"
#include "meshing/mesh_border.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using mesh::BoundaryKind;
using mesh::BoundarySegment;
using meshing::usual_type;

// Reads the file, line by line.
class Gr3Reader {
 public:
  Gr3Reader(OceanLines& lines, MeshInFile& file) : lines_(lines), file_(file) {}

  void read() {
    lines_.require("line of counts", 0, 1);
    const std::uint64_t num_triangles = lines_.count(0, "number of elements");
    num_nodes_ = lines_.count(1, "number of nodes");
    read_nodes();
    read_triangles(num_triangles);
    if (!lines_.next()) return;
    file_.has_boundary = true;
    read_boundaries(lines_.count(0, "number of open boundaries"), true);
    lines_.require("number of land boundaries", 0, 1);
    read_boundaries(lines_.count(0, "number of land boundaries"), false);
    remark_on_rest();
    if (num_barriers_ > 0) {
      file_.remarks.push_back(std::to_string(num_barriers_) +
                              " boundaries with numbers at their nodes (weirs, pipes) are read as "
                              "land, without the numbers");
    }
  }

 private:
  // Throws BadValue unless the line begins with the number of an element or a node.
  void require_number(const char* item, std::uint64_t i) const {
    const std::int64_t number = lines_.integer(0, item);
    if (number == static_cast<std::int64_t>(i + 1)) return;
    throw BadValue(std::string(item) + ' ' + std::to_string(number) + " where " +
                   std::to_string(i + 1) + " is needed");
  }

  void read_nodes() {
    for (std::uint64_t i = 0; i < num_nodes_; ++i) {
      lines_.require("node", i, num_nodes_);
      require_number("node", i);
      add_node(file_, lines_.number(1, "longitude"), lines_.number(2, "latitude"));
      file_.mesh.depths.push_back(lines_.number(3, "depth"));
      file_.node_lines.push_back(lines_.line());
    }
  }

  void read_triangles(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      lines_.require("element", i, count);
      require_number("element", i);
      const std::int64_t size = lines_.integer(1, "number of corners");
      if (size != 3) {
        throw BadValue("element " + std::to_string(i + 1) + " has " + std::to_string(size) +
                       " corners, where a triangle is needed");
      }
      const auto corner = [&](std::size_t k) { return lines_.node(k, num_nodes_); };
      file_.mesh.triangles.push_back({corner(2), corner(3), corner(4)});
      file_.triangle_lines.push_back(lines_.line());
    }
  }

  // Reads boundaries after the line with their number, and compares how many nodes they have with the
  // total; of a barrier with two sides both may count, or one.
  void read_boundaries(std::uint64_t count, bool is_open) {
    const char* const what = "total number of boundary nodes";
    lines_.require(what, 0, 1);
    const std::uint64_t total = lines_.count(0, what);
    const std::uint64_t line = lines_.line();
    std::uint64_t num_front = 0;
    std::uint64_t num_back = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      lines_.require("boundary", i, count);
      const std::size_t first = file_.mesh.boundary.size();
      const std::uint64_t num_nodes = lines_.count(0, "number of nodes of a boundary");
      read_boundary(num_nodes, is_open);
      num_front += num_nodes;
      if (file_.mesh.boundary.size() > first + 1) num_back += num_nodes;
    }
    if (total == num_front || total == num_front + num_back) return;
    throw BadValue(std::string(what) + ' ' + std::to_string(total) + " where the boundaries have " +
                       std::to_string(num_front + num_back),
                   line);
  }

  // Adds a remark if a line with a number follows. Behind the end some programs have notes.
  void remark_on_rest() {
    while (lines_.next()) {
      if (lines_.words()[0].find_first_not_of("0123456789") != std::string_view::npos) continue;
      file_.remarks.push_back("line " + std::to_string(lines_.line()) +
                              " and what follows it are not read: the number of land boundaries "
                              "says that the last one ended before");
      return;
    }
  }

  // Returns the number of the type of a boundary in the current line; the usual one if it is open
  // and the next word is a comment.
  [[nodiscard]] std::int64_t type_in_line(bool is_open) const {
    if (is_open && (lines_.words().size() < 2 ||
                    lines_.words()[1].find_first_not_of("0123456789") != std::string_view::npos)) {
      return 0;
    }
    const std::int64_t type = lines_.integer(1, "type of a boundary");
    if (type >= 0 && type <= meshing::largest_type) return type;
    throw BadValue("type of a boundary " + std::to_string(type) + " is not from 0 to 999");
  }

  void read_boundary(std::uint64_t count, bool is_open) {
    const std::int64_t type = type_in_line(is_open);
    BoundarySegment front;
    front.kind = is_open
                     ? BoundaryKind::open
                     : (meshing::is_island_type(type) ? BoundaryKind::island : BoundaryKind::land);
    const bool is_barrier = !is_open && meshing::is_barrier_type(type);
    if (type != usual_type(front.kind) && !is_barrier) front.type = static_cast<std::int32_t>(type);
    BoundarySegment back{BoundaryKind::land, {}};
    file_.segment_lines.push_back(lines_.line());
    for (std::uint64_t k = 0; k < count; ++k) {
      lines_.require("node of a boundary", k, count);
      front.nodes.push_back(lines_.node(0, num_nodes_));
      if (is_barrier && meshing::is_pair_type(type))
        back.nodes.push_back(lines_.node(1, num_nodes_));
    }
    if (is_barrier) ++num_barriers_;
    add_segment(file_, std::move(front));
    if (back.nodes.empty()) return;
    file_.segment_lines.push_back(file_.segment_lines.back());
    add_segment(file_, std::move(back));
  }

  OceanLines& lines_;
  MeshInFile& file_;
  std::uint64_t num_nodes_ = 0;
  std::size_t num_barriers_ = 0;
};

// Writes the boundaries that are open, or the others.
void write_boundaries(io::AtomicFile& file, const mesh::TriangleMesh& mesh, bool is_open) {
  std::size_t count = 0;
  std::size_t num_nodes = 0;
  for (const BoundarySegment& segment : mesh.boundary) {
    if ((segment.kind == BoundaryKind::open) != is_open) continue;
    ++count;
    num_nodes += segment.nodes.size();
  }
  const std::string name = is_open ? "open" : "land";
  file.write(std::to_string(count) + " = Number of " + name + " boundaries\n" +
             std::to_string(num_nodes) + " = Total number of " + name + " boundary nodes\n");
  for (const BoundarySegment& segment : mesh.boundary) {
    if ((segment.kind == BoundaryKind::open) != is_open) continue;
    std::string text = std::to_string(segment.nodes.size());
    if (!is_open || segment.type) {
      text += ' ' + std::to_string(segment.type.value_or(usual_type(segment.kind)));
    }
    text += " = Number of nodes for " + std::string(name_of(segment.kind)) + " boundary\n";
    for (const Index node : segment.nodes) text += std::to_string(node + 1) + '\n';
    file.write(text);
  }
}

}  // namespace

void read_gr3(std::string_view text, MeshInFile& file) {
  // The first line may have no words, or any.
  const std::size_t end = std::min(text.find('\n'), text.size());
  OceanLines lines(text.substr(std::min(end + 1, text.size())), 1);
  io::at_line_of(lines, [&] { Gr3Reader(lines, file).read(); });
}

void write_gr3(io::AtomicFile& file, const MeshOfFile& mesh) {
  const std::size_t num_triangles = mesh.mesh.triangles.size();
  file.write("triangles\n" + std::to_string(num_triangles) + ' ' +
             std::to_string(mesh.positions.size()) + '\n');
  write_lines(file, mesh.execution, mesh.positions.size(), [&](std::string& text, std::size_t i) {
    io::append_integer(text, i + 1);
    append_word(text, mesh.positions[i].lon_deg);
    append_word(text, mesh.positions[i].lat_deg);
    append_word(text, mesh.depth(i));
  });
  write_lines(file, mesh.execution, num_triangles, [&](std::string& text, std::size_t i) {
    io::append_integer(text, i + 1);
    text += " 3";
    append_nodes(text, mesh.mesh.triangles[i]);
  });
  write_boundaries(file, mesh.mesh, true);
  write_boundaries(file, mesh.mesh, false);
}

}  // namespace rondel::formats
