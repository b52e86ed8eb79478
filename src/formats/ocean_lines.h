// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The lines, nodes and numbers that the readers and writers of meshes of triangles share.
//
// in    the lines of a text file; or nodes, triangles and segments
// out   a mesh, each of whose parts has its line; or lines of text
// index nodes from 1 in files of text, from 0 in a mesh
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "io/bad_value.h"
#include "io/netcdf_reader.h"
#include "io/text_lines.h"
#include "rondel/triangle_mesh.h"

namespace rondel::formats {

// The words of a file's lines as numbers. Errors have the place of the line.
class OceanLines {
 public:
  // The first line of the text has the number `before` + 1.
  explicit OceanLines(std::string_view text, std::uint64_t before = 0)
      : lines_(text), before_(before) {}

  // Goes to the next line that has words; returns false at the end.
  bool next() { return lines_.next(); }
  // Does the same; throws BadValue at the end: "the file ends before node 7 of 9".
  void require(const char* item, std::uint64_t index, std::uint64_t count);
  [[nodiscard]] const std::vector<std::string_view>& words() const { return lines_.words(); }
  [[nodiscard]] std::uint64_t line() const { return lines_.line() + before_; }
  [[nodiscard]] std::size_t num_bytes_left() const { return lines_.size() - lines_.position(); }

  // Return word k of the line as a number, also as Fortran writes it (1.5D+02), as an integer, or as
  // a number of items. Throw BadValue, which has no line, if it is missing or none of these.
  [[nodiscard]] double number(std::size_t k, std::string_view what) const;
  [[nodiscard]] std::int64_t integer(std::size_t k, std::string_view what) const;
  [[nodiscard]] std::uint64_t count(std::size_t k, std::string_view what) const;
  // Returns word k as the index of one of so many nodes, which count from 1 in the file.
  [[nodiscard]] Index node(std::size_t k, std::size_t num_nodes) const;

 private:
  // Returns word k of the line. Throws BadValue if there is none.
  [[nodiscard]] std::string_view word(std::size_t k, std::string_view what) const;

  io::TextLines lines_;
  std::uint64_t before_;
};

// Calls read_it(); a BadValue that it throws gets the line.
template <class Read>
void at_line(std::uint64_t line, const Read& read_it) {
  try {
    read_it();
  } catch (const io::BadValue& bad) {
    throw io::BadValue(bad.what(), line);
  }
}

// A mesh that is being read.
struct MeshInFile {
  mesh::TriangleMesh mesh;
  // The lines of nodes, triangles and segments; empty if the file has no lines.
  std::vector<std::uint64_t> node_lines;
  std::vector<std::uint64_t> triangle_lines;
  std::vector<std::uint64_t> segment_lines;
  // False if the file has no segments; then the border is land, but for `open_edges`.
  bool has_boundary = false;
  std::vector<std::array<Index, 2>> open_edges;  // sorted, the lower node first
  Index base = 1;                                // the number of the first node in the file
  std::vector<std::string> remarks;
};

// Adds a node in degrees. Throws BadValue if the numbers are no place.
void add_node(MeshInFile& file, double lon_deg, double lat_deg);
// Adds a segment; the last node of a closed island is left out.
void add_segment(MeshInFile& file, mesh::BoundarySegment segment);
// Leaves out the nodes that are in no triangle.
void drop_free_nodes(MeshInFile& file);
// Completes a mesh: points of nodes in degrees, triangles that are counterclockwise, no depths where
// all are 0, the border where the file has none. Throws BadValue with the line for a mesh that is
// not valid.
void complete_mesh(MeshInFile& file);

// Identifiers of nodes in a file, in any order.
class NodeNames {
 public:
  void add(std::uint64_t name) { names_.emplace_back(name, static_cast<Index>(names_.size())); }
  // Ends the list. Throws BadValue if two nodes have one name.
  void sort();
  // Returns the index of a node. Throws BadValue if no node has the name.
  [[nodiscard]] Index operator[](std::int64_t name) const;

 private:
  std::vector<std::pair<std::uint64_t, Index>> names_;
};

// The mesh that is written, and its nodes in degrees.
struct MeshOfFile {
  const mesh::TriangleMesh& mesh;
  std::vector<LonLat> positions;
  const Execution& execution;

  // Returns the depth of a node, 0 if the mesh has no depths.
  [[nodiscard]] double depth(std::size_t node) const {
    return mesh.depths.empty() ? 0 : mesh.depths[node];
  }
};

// Writes a line for each of so many items, which append(text, i) appends without its end.
void write_lines(io::AtomicFile& file, const Execution& execution, std::size_t count,
                 const std::function<void(std::string& text, std::size_t i)>& append);
// Append numbers behind blanks.
void append_word(std::string& text, double value);
void append_word(std::string& text, std::uint64_t value);
// Appends nodes behind blanks, counted from 1.
void append_nodes(std::string& text, std::span<const Index> nodes);
// Returns the nodes of a segment, those of an island with the first one at the end, too.
std::vector<Index> closed_nodes(const mesh::BoundarySegment& segment);
// Returns the value with its other sign; 0 stays 0.
inline double turned(double value) { return 0 - value; }

// The name of the view of depths in Gmsh's files.
inline constexpr std::string_view depth_view = "depth";

// Each format's reader and writer. Readers throw BadValue.
void write_gmsh4(io::AtomicFile& file, const MeshOfFile& mesh);
void write_gmsh2(io::AtomicFile& file, const MeshOfFile& mesh);
void write_gr3(io::AtomicFile& file, const MeshOfFile& mesh);
void write_2dm(io::AtomicFile& file, const MeshOfFile& mesh);
void write_fesom(const std::string& folder, const MeshOfFile& mesh);
void write_ugrid_triangles(io::AtomicFile& output, const MeshOfFile& mesh,
                           const NetcdfOptions& options);
void read_gmsh(std::string_view text, MeshInFile& file);
void read_gr3(std::string_view text, MeshInFile& file);
void read_2dm(std::string_view text, MeshInFile& file);
// Reads the files of a folder, whose names begin with `folder`. Throws FileError.
void read_fesom(const std::string& folder, MeshInFile& file);
// True if a topology has faces of three nodes and no centers of faces.
bool has_triangles_without_centers(const io::NetcdfReader& reader);
void read_ugrid_triangles(const io::NetcdfReader& reader, const std::string& part,
                          MeshInFile& file);

}  // namespace rondel::formats
