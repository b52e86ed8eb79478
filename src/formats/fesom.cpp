// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// FESOM2's folder: nod2d.out has the number of nodes and for each its number, longitude, latitude and
// 1 on the border, 0 elsewhere; elem2d.out has the number of triangles and their nodes; aux3d.out has
// the number of levels, their heights and the height of the ground at each node, which are negative.
// FESOM takes heights above 0 as depths.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "formats/ocean_lines.h"
#include "io/file_bytes.h"
#include "io/number.h"
#include "meshing/mesh_border.h"
#include "rondel/error.h"

namespace rondel::formats {
namespace {

using io::BadValue;

// Returns the levels of a mesh that has none: FESOM wants three.
std::vector<double> usual_levels(const std::vector<double>& depths) {
  const double deepest = depths.empty() ? 0 : *std::ranges::max_element(depths);
  return {0, deepest / 2, deepest};
}

// Makes a folder, and takes it away again where the files in it do not become complete.
class MadeFolder {
 public:
  // Throws FileError if the system refuses.
  explicit MadeFolder(const std::string& folder) {
    std::error_code error;
    std::filesystem::path path(folder);
    if (!path.has_filename()) path = path.parent_path();  // without the slash
    for (; !path.empty() && !std::filesystem::exists(path, error); path = path.parent_path()) {
      made_.push_back(path);
    }
    if (made_.empty()) return;
    std::filesystem::create_directories(made_.front(), error);
    if (error) throw FileError(folder, error);
  }
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;
  ~MadeFolder() {
    std::error_code ignored;
    for (const std::filesystem::path& path : made_) std::filesystem::remove(path, ignored);
  }
  void keep() noexcept { made_.clear(); }

 private:
  std::vector<std::filesystem::path> made_;  // the innermost one first
};

// Reads a file of the folder. Throws FileError with its name.
template <class Read>
void in_file_of(const std::string& folder, const char* name, const Read& read_lines) {
  io::FileBytes bytes(folder + name);
  io::in_file(bytes.name(), [&] {
    OceanLines lines(bytes.text());
    io::at_line_of(lines, [&] { read_lines(lines); });
  });
}

// Reads the nodes, and which of them FESOM takes for the border.
std::vector<bool> read_fesom_nodes(OceanLines& lines, MeshInFile& file) {
  lines.require("number of nodes", 0, 1);
  const std::uint64_t count = lines.count(0, "number of nodes");
  std::vector<bool> is_coast;
  for (std::uint64_t i = 0; i < count; ++i) {
    lines.require("node", i, count);
    const std::int64_t number = lines.integer(0, "number of a node");
    if (number != static_cast<std::int64_t>(i + 1)) {
      throw BadValue("node " + std::to_string(number) + " where " + std::to_string(i + 1) +
                     " is needed");
    }
    add_node(file, lines.number(1, "longitude"), lines.number(2, "latitude"));
    is_coast.push_back(lines.integer(3, "mark of the coast") != 0);
    file.node_lines.push_back(lines.line());
  }
  return is_coast;
}

void read_fesom_triangles(OceanLines& lines, MeshInFile& file) {
  const std::size_t num_nodes = file.mesh.positions.size();
  lines.require("number of triangles", 0, 1);
  const std::uint64_t count = lines.count(0, "number of triangles");
  for (std::uint64_t i = 0; i < count; ++i) {
    lines.require("triangle", i, count);
    const auto corner = [&](std::size_t k) { return lines.node(k, num_nodes); };
    file.mesh.triangles.push_back({corner(0), corner(1), corner(2)});
    file.triangle_lines.push_back(lines.line());
  }
}

// Reads levels and depths, with any number of them in a line.
void read_fesom_depths(OceanLines& lines, MeshInFile& file) {
  lines.require("number of levels", 0, 1);
  const std::uint64_t num_levels = lines.count(0, "number of levels");
  std::size_t next = 1;
  const auto read_numbers = [&](std::uint64_t count, const char* what, std::vector<double>& out) {
    for (std::uint64_t i = 0; i < count; ++i, ++next) {
      if (next >= lines.words().size()) {
        lines.require(what, i, count);
        next = 0;
      }
      out.push_back(std::abs(lines.number(next, what)));
    }
  };
  read_numbers(num_levels, "level", file.mesh.levels);
  read_numbers(file.mesh.positions.size(), "depth", file.mesh.depths);
  if (file.mesh.levels == usual_levels(file.mesh.depths)) file.mesh.levels.clear();
}

// Adds a remark if the file marks other nodes than those of the border.
void remark_on_coast(const std::vector<bool>& is_coast, MeshInFile& file) {
  std::vector<bool> is_border(is_coast.size());
  for (const mesh::BoundarySegment& segment : file.mesh.boundary) {
    for (const Index node : segment.nodes) is_border[node] = true;
  }
  std::size_t num_other = 0;
  for (std::size_t i = 0; i < is_coast.size(); ++i) num_other += is_coast[i] != is_border[i];
  if (num_other == 0) return;
  file.remarks.push_back(std::to_string(num_other) + " of " + std::to_string(is_coast.size()) +
                         " nodes are marked otherwise than the border of the triangles; the border "
                         "is that of the triangles");
}

// Adds a remark that names files which say more of levels and depths than those that are read.
void remark_on_other_files(const std::string& folder, MeshInFile& file) {
  constexpr std::array<const char*, 9> others = {"cavity_depth@elem.out",
                                                 "cavity_depth@node.out",
                                                 "cavity_elvls.out",
                                                 "cavity_nlvls.out",
                                                 "depth@elem.out",
                                                 "depth@node.out",
                                                 "depth_zlev.out",
                                                 "elvls.out",
                                                 "nlvls.out"};
  std::string found;
  for (const char* const name : others) {
    std::error_code error;
    if (!std::filesystem::exists(folder + name, error)) continue;
    found += (found.empty() ? "" : ", ") + std::string(name);
  }
  if (!found.empty()) file.remarks.push_back("left out, as they are no part of the mesh: " + found);
}

}  // namespace

void read_fesom(const std::string& folder, MeshInFile& file) {
  std::vector<bool> is_coast;
  in_file_of(folder, "nod2d.out",
             [&](OceanLines& lines) { is_coast = read_fesom_nodes(lines, file); });
  in_file_of(folder, "elem2d.out", [&](OceanLines& lines) { read_fesom_triangles(lines, file); });
  std::error_code error;
  if (std::filesystem::exists(folder + "aux3d.out", error)) {
    in_file_of(folder, "aux3d.out", [&](OceanLines& lines) { read_fesom_depths(lines, file); });
  } else {
    file.remarks.emplace_back("there is no aux3d.out, which has the depths");
  }
  // Nodes and triangles have lines in different files.
  file.node_lines.clear();
  io::in_file(folder + "elem2d.out", [&] {
    try {
      complete_mesh(file);
    } catch (const BadValue& bad) {
      if (bad.line() != 0) throw;
      throw FileError(folder + "nod2d.out: " + bad.what());
    }
  });
  remark_on_coast(is_coast, file);
  remark_on_other_files(folder, file);
}

void write_fesom(const std::string& folder, const MeshOfFile& mesh) {
  const mesh::TriangleMesh& arrays = mesh.mesh;
  for (std::size_t i = 0; i < arrays.depths.size(); ++i) {
    if (arrays.depths[i] >= 0) continue;
    throw InvalidInput("node " + std::to_string(i + 1) +
                           " (from 1) has a negative depth, which FESOM would take for a depth "
                           "below the sea; --least-depth makes such nodes deeper",
                       i);
  }
  std::vector<bool> is_coast(arrays.points.size());
  for (const auto& edge : meshing::border_of(arrays.points.size(), arrays.triangles)) {
    is_coast[edge[0]] = true;
  }
  MadeFolder made(folder);
  FilesTogether together;
  io::AtomicFile nodes(folder + "nod2d.out");
  nodes.write(std::to_string(arrays.points.size()) + '\n');
  write_lines(nodes, mesh.execution, arrays.points.size(), [&](std::string& text, std::size_t i) {
    io::append_integer(text, i + 1);
    append_word(text, mesh.positions[i].lon_deg);
    append_word(text, mesh.positions[i].lat_deg);
    text += is_coast[i] ? " 1" : " 0";
  });
  nodes.commit();
  io::AtomicFile triangles(folder + "elem2d.out");
  triangles.write(std::to_string(arrays.triangles.size()) + '\n');
  write_lines(triangles, mesh.execution, arrays.triangles.size(),
              [&](std::string& text, std::size_t i) { append_nodes(text, arrays.triangles[i]); });
  triangles.commit();
  io::AtomicFile depths(folder + "aux3d.out");
  const std::vector<double> levels =
      arrays.levels.empty() ? usual_levels(arrays.depths) : arrays.levels;
  depths.write(std::to_string(levels.size()) + '\n');
  write_lines(depths, mesh.execution, levels.size(), [&](std::string& text, std::size_t k) {
    io::append_number(text, turned(levels[k]));
  });
  write_lines(depths, mesh.execution, arrays.points.size(), [&](std::string& text, std::size_t i) {
    io::append_number(text, turned(mesh.depth(i)));
  });
  depths.commit();
  together.commit();
  made.keep();
}

}  // namespace rondel::formats
