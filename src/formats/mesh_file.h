// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes a netCDF file of a mesh: first all variables are defined, each with a function that
// computes its rows, then all values are written.
//
// in    the arrays of a mesh
// out   a netCDF file in one of the mesh conventions
// index rows of a variable: cells, edges or vertices, counted from 0 here
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "io/netcdf_writer.h"
#include "rondel/mesh.h"
#include "rondel/mesh_formats.h"
#include "system/parallel.h"

namespace rondel::formats {

// A netCDF file that is being written, and the mesh from which its values are computed. `arrays`
// and what the fill functions refer to must live until write().
class MeshFile {
 public:
  using Texts = std::initializer_list<std::pair<const char*, const char*>>;

  // Begins a file with the values of `arrays`; nothing is written before write().
  MeshFile(io::AtomicFile& file, const mesh::VoronoiMesh& arrays, const Execution& execution)
      : arrays_(arrays), execution_(execution), out_(file) {}
  // Begins a file of another mesh, for which arrays() is empty.
  MeshFile(io::AtomicFile& file, const Execution& execution);

  // Returns the mesh.
  [[nodiscard]] const mesh::VoronoiMesh& arrays() const { return arrays_; }
  // Returns the writer, for global attributes.
  io::NetcdfWriter& netcdf() { return out_; }
  // Defines a dimension and returns its number; with size 0 it is the record dimension.
  std::size_t dimension(const char* name, std::uint64_t size) {
    return out_.add_dimension(name, size);
  }

  // Defines a variable of `rows` rows of `row_size` values; fill(row, values) sets the values of a
  // row, which are 0 before. It is called when the file is written.
  template <typename T, typename Fill>
  void add(io::NetcdfVariable variable, std::size_t rows, std::size_t row_size, Fill fill) {
    out_.add_variable(std::move(variable));
    writes_.push_back([this, rows, row_size, fill](Values* kept) {
      const auto fill_rows = [&](std::size_t begin, std::size_t end, T* values) {
        for (std::size_t i = begin; i < end; ++i, values += row_size) fill(i, values);
      };
      if (kept == nullptr) {
        out_.write_rows<T>(execution_.threads, rows, row_size, fill_rows);
      } else if constexpr (sizeof(T) > 1) {  // the numbers of MPAS, which no text is
        auto& all = kept->emplace<std::vector<T>>(rows * row_size);
        system::parallel_for(execution_.threads, rows, rows_per_piece,
                             [&](std::size_t begin, std::size_t end) {
                               fill_rows(begin, end, all.data() + begin * row_size);
                             });
      }
    });
  }
  // Defines a variable of doubles with fill(row, values).
  template <typename Fill>
  void numbers(const char* name, std::vector<std::size_t> dimensions, Texts texts, std::size_t rows,
               std::size_t row_size, Fill fill) {
    add<double>(variable(name, io::NetcdfType::float64, std::move(dimensions), texts), rows,
                row_size, fill);
  }
  // Defines a variable of doubles with one value a row, value(row).
  template <typename Value>
  void numbers(const char* name, std::size_t dimension, Texts texts, std::size_t rows,
               Value value) {
    numbers(name, std::vector{dimension}, texts, rows, 1,
            [value](std::size_t i, double* out) { *out = value(i); });
  }
  // Defines a variable of 32-bit integers with fill(row, values).
  template <typename Fill>
  void indices(const char* name, std::vector<std::size_t> dimensions, Texts texts, std::size_t rows,
               std::size_t row_size, Fill fill) {
    add<std::int32_t>(variable(name, io::NetcdfType::int32, std::move(dimensions), texts), rows,
                      row_size, fill);
  }
  // Defines a variable of 32-bit integers with one value a row, value(row).
  template <typename Value>
  void indices(const char* name, std::size_t dimension, Texts texts, std::size_t rows,
               Value value) {
    indices(
        name, std::vector{dimension}, texts, rows, 1,
        [value](std::size_t i, std::int32_t* out) { *out = static_cast<std::int32_t>(value(i)); });
  }

  // Returns a variable with attributes that are texts.
  static io::NetcdfVariable variable(const char* name, io::NetcdfType type,
                                     std::vector<std::size_t> dimensions, Texts texts);
  // Adds an attribute that is a number.
  static void set(io::NetcdfVariable& variable, const char* name, double number);

  // Writes header and values. Throws BadValue if the mesh is too large for the netCDF format.
  void write(const NetcdfOptions& options);

  // Returns the variables that is_wanted(name) takes, with their values, which are not written.
  template <class Wanted>
  [[nodiscard]] std::vector<mesh::FileVariable> content(const Wanted& is_wanted) const {
    std::vector<mesh::FileVariable> found;
    for (std::size_t k = 0; k < writes_.size(); ++k) {
      const io::NetcdfVariable& defined = out_.variables()[k];
      if (!is_wanted(defined.name)) continue;
      mesh::FileVariable& taken = found.emplace_back();
      taken.name = defined.name;
      for (const std::size_t d : defined.dimensions) {
        taken.dimensions.push_back(out_.dimensions()[d].name);
        taken.shape.push_back(out_.dimensions()[d].size);
      }
      writes_[k](&taken.values);
    }
    return found;
  }

 private:
  using Values = decltype(mesh::FileVariable::values);
  // The number of rows that a thread fills at once.
  static constexpr std::size_t rows_per_piece = 4096;

  const mesh::VoronoiMesh& arrays_;
  const Execution& execution_;
  io::NetcdfWriter out_;
  // Each writes the values of a variable, or keeps them if there is a place for them.
  std::vector<std::function<void(Values*)>> writes_;
};

// Return the longitude, from 0 to less than a full circle, and the latitude of a point, in radians
// or degrees.
double longitude_of(const Point& p);
double latitude_of(const Point& p);
double longitude_deg_of(const Point& p);
double latitude_deg_of(const Point& p);
// The corners of cells: the vertices, where vertices that are joined by an edge of length 0 count
// as one.
class CellCorners {
 public:
  // Joins vertices across edges of length 0. `arrays` must live as long as this object.
  explicit CellCorners(const mesh::VoronoiMesh& arrays);

  // Calls visit(vertex) for the corners of a cell, counterclockwise.
  template <typename Visit>
  void visit(std::size_t cell, const Visit& visit) const {
    const std::uint64_t begin = arrays_.edges_on_cell.offsets[cell];
    const std::uint64_t end = arrays_.edges_on_cell.offsets[cell + 1];
    Index last = corner(arrays_.vertices_on_cell[end - 1]);
    for (std::uint64_t at = begin; at < end; ++at) {
      const Index next = corner(arrays_.vertices_on_cell[at]);
      if (next == last) continue;
      visit(next);
      last = next;
    }
  }
  // Returns the number of corners of a cell.
  [[nodiscard]] std::size_t count(std::size_t cell) const {
    std::size_t found = 0;
    visit(cell, [&](Index /*corner*/) { ++found; });
    return found;
  }

 private:
  // Returns the vertex that stands for a corner, the lowest of those that are joined.
  [[nodiscard]] Index corner(Index vertex) const {
    return joined_.empty() ? vertex : joined_[vertex];
  }

  const mesh::VoronoiMesh& arrays_;
  std::vector<Index> joined_;  // by vertex: the corner; empty if every vertex is a corner
};

// The attributes of coordinates in degrees and of areas on the unit sphere.
constexpr MeshFile::Texts texts_of_degrees = {{"units", "degrees"}};
constexpr MeshFile::Texts texts_of_areas = {{"units", "radians^2"}};
constexpr MeshFile::Texts texts_of_longitudes = {{"units", "degrees_east"},
                                                 {"standard_name", "longitude"}};
constexpr MeshFile::Texts texts_of_latitudes = {{"units", "degrees_north"},
                                                {"standard_name", "latitude"}};

// Returns a variable of UGRID with indices from 0. If `is_filled`, -1 stands for none.
io::NetcdfVariable ugrid_indices(const char* name, const char* role,
                                 std::vector<std::size_t> dimensions, bool is_filled);

// Returns the area of a cell on the unit sphere.
inline double area_at_one(const mesh::VoronoiMesh& arrays, std::size_t cell) {
  return arrays.cell_areas[cell] / (arrays.radius * arrays.radius);
}

// Each of these defines the dimensions, attributes and variables of one convention, before any
// value is written. `corners` must live until the file is written.
void define_mpas(MeshFile& file);
void define_ugrid(MeshFile& file, const CellCorners& corners);
void define_scrip(MeshFile& file, const CellCorners& corners);
void define_esmf(MeshFile& file, const CellCorners& corners);
// The cells of an Exodus file, grouped into blocks by their number of corners. They must live until
// the file is written.
struct CellBlocks {
  std::vector<Index> cells;         // sorted by number of corners, then by index
  std::vector<std::size_t> begins;  // begin of each block in `cells`, and the end
  // By block, the number of corners of its cells.
  std::vector<std::size_t> corners;
};
// Returns the cells in blocks.
CellBlocks blocks_of(const mesh::VoronoiMesh& arrays, const CellCorners& corners);
// Defines the variables of an Exodus file, block by block.
void define_exodus(MeshFile& file, const CellCorners& corners, const CellBlocks& blocks);

}  // namespace rondel::formats
