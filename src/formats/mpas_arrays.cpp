// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads an MPAS file as arrays. Only the lists from which the others follow are read: cells and
// vertices of edges, edges around cells, cells around vertices. Programs differ in where a list
// begins and in the order of the two vertices of an edge; the result has the order that VoronoiMesh
// documents.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "exact/vector.h"
#include "formats/mesh_file.h"
#include "formats/mpas_places.h"
#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "io/number.h"
#include "meshing/consistency.h"
#include "meshing/face_measures.h"
#include "rondel/error.h"
#include "rondel/mesh_formats.h"
#include "system/job.h"
#include "system/row_assembly.h"

namespace rondel::mesh {
namespace {

// The number of elements that a thread reads at once.
constexpr std::size_t read_grain = 4096;

using io::BadValue;

// Reads the arrays and derives the lists that are not read.
class MpasReader {
 public:
  // Reads with the threads of `execution`, and announces its progress as "read".
  MpasReader(const io::NetcdfReader& file, const Execution& execution)
      : file_(file), threads_(execution.threads), execution_(execution) {}

  // Returns the mesh. Throws BadValue if a variable is missing or the lists do not fit together.
  VoronoiMesh read() {
    read_sphere();
    read_points({"xCell", "yCell", "zCell"}, arrays_.cell_points);
    read_points({"xEdge", "yEdge", "zEdge"}, arrays_.edge_points);
    read_points({"xVertex", "yVertex", "zVertex"}, arrays_.vertex_points);
    if (arrays_.num_cells() == 0) throw BadValue("there are no cells");
    for (const char* kind : {"Cell", "Edge", "Vertex"})
      formats::require_one_place(file_, kind, formats::PlacesMay::not_be_missing);
    read_numbers("areaCell", arrays_.num_cells(), arrays_.cell_areas);
    read_density();
    read_numbers("dcEdge", arrays_.num_edges(), arrays_.cell_distances);
    read_numbers("dvEdge", arrays_.num_edges(), arrays_.vertex_distances);
    read_numbers("angleEdge", arrays_.num_edges(), arrays_.normal_angles);
    read_numbers("areaTriangle", arrays_.num_vertices(), arrays_.triangle_areas);
    system::announce(execution_, "read", 0.4);
    read_rows("cellsOnEdge", arrays_.num_edges(), arrays_.num_cells(), arrays_.cells_on_edge, true);
    read_rows("verticesOnEdge", arrays_.num_edges(), arrays_.num_vertices(),
              arrays_.vertices_on_edge, false);
    // The border has to be known before the rings, whose lengths are checked by it.
    find_border();
    read_rings();
    turn_edges();
    system::announce(execution_, "read", 0.7);
    follow_rings();
    read_rows("cellsOnVertex", arrays_.num_vertices(), arrays_.num_cells(), arrays_.cells_on_vertex,
              true);
    require_numbers();
    read_kites();
    find_edges_of_vertices();
    system::announce(execution_, "read", 1);
    return std::move(arrays_);
  }

 private:
  // Calls piece(begin, end) for pieces of `read_grain` elements, in parallel.
  template <class Piece>
  void in_pieces(std::size_t count, const Piece& piece) const {
    system::parallel_for(threads_, count, read_grain, piece);
  }

  // Reads the radius; it is 1 where the file does not say.
  void read_sphere() {
    if (io::netcdf_text(file_.attributes(), "on_a_sphere").starts_with("NO")) {
      throw BadValue("the mesh is not on a sphere");
    }
    const auto* const radius = io::find_attribute(file_.attributes(), "sphere_radius");
    if (radius != nullptr && !radius->text.empty()) {
      throw BadValue("the attribute sphere_radius is the text " + io::in_quotes(radius->text) +
                     ", where a number is needed");
    }
    if (radius == nullptr || radius->numbers.empty()) return;
    arrays_.radius = radius->numbers[0];
    if (arrays_.radius > 0 && arrays_.radius < 1e30) return;
    throw BadValue("the attribute sphere_radius is no positive number");
  }

  // Returns a variable with `size` values; with size 0, any number of values.
  [[nodiscard]] const io::VariableInFile& require(const char* name, std::uint64_t size) const {
    const io::VariableInFile& variable = file_.require(name);
    if (variable.num_values == size || size == 0) return variable;
    throw BadValue("variable " + io::in_quotes(name) + " has " +
                   std::to_string(variable.num_values) + " values instead of " +
                   std::to_string(size));
  }

  // Reads a variable with one finite number for each element.
  void read_numbers(const char* name, std::size_t size, std::vector<double>& values) const {
    const io::VariableInFile& variable = require(name, size);
    values.resize(size);
    in_pieces(size, [&](std::size_t begin, std::size_t end) {
      file_.read_numbers(variable, begin, std::span(values).subspan(begin, end - begin));
      for (std::size_t i = begin; i < end; ++i) require_finite(name, i, values[i]);
    });
  }

  // Throws BadValue, with the name and the number of the value, unless it is finite.
  static void require_finite(const char* name, std::size_t i, double value) {
    if (std::isfinite(value)) return;
    throw BadValue("variable " + io::in_quotes(name) + ", value " + std::to_string(i) +
                   ": not finite");
  }

  // Checks the numbers as for arrays of callers; errors are those of the file.
  void require_numbers() const {
    try {
      meshing::require_possible_numbers(arrays_, threads_);
      meshing::require_measures_of_points(arrays_, threads_);
    } catch (const InvalidInput& error) {
      throw BadValue(error.what());
    }
  }

  // Reads the three coordinates of points, which lie on the sphere.
  void read_points(const std::array<const char*, 3>& names, std::vector<Point>& points) const {
    const auto size = static_cast<std::size_t>(require(names[0], 0).num_values);
    const std::array<const io::VariableInFile*, 3> variables = {
        &require(names[0], size), &require(names[1], size), &require(names[2], size)};
    if (size > no_index) throw BadValue("more than 2^32 - 1 points");
    points.resize(size);
    in_pieces(size, [&](std::size_t begin, std::size_t end) {
      std::array<double, read_grain> values;
      constexpr std::array coordinates = {&Point::x, &Point::y, &Point::z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        file_.read_numbers(*variables[axis], begin, std::span(values).first(end - begin));
        for (std::size_t i = begin; i < end; ++i) {
          require_finite(names[axis], i, values[i - begin]);
          points[i].*coordinates[axis] = values[i - begin];
        }
      }
      for (std::size_t i = begin; i < end; ++i) {
        if (meshing::is_on_sphere(points[i], arrays_.radius)) continue;
        throw BadValue("variable " + io::in_quotes(names[0]) + ", value " + std::to_string(i) +
                       ": the point is not on the sphere of sphere_radius");
      }
    });
  }

  // Reads the density; a constant one is left out, as VoronoiMesh documents.
  void read_density() {
    const io::VariableInFile* const variable = file_.find("meshDensity");
    if (variable == nullptr) return;
    read_numbers("meshDensity", arrays_.num_cells(), arrays_.density);
    const bool is_constant =
        std::ranges::all_of(arrays_.density, [](double density) { return density == 1; });
    if (is_constant) arrays_.density = {};
    for (std::size_t i = 0; i < arrays_.density.size(); ++i) {
      if (!(arrays_.density[i] > 0)) {
        throw BadValue("variable \"meshDensity\" is not positive for cell " + std::to_string(i));
      }
    }
  }

  // Converts numbers that count from 1 up to `end` to indices from 0.
  static Index index_of(const char* name, std::size_t row, std::int64_t number, std::size_t end) {
    if (number >= 1 && static_cast<std::uint64_t>(number) <= end) {
      return static_cast<Index>(number - 1);
    }
    const std::string where =
        "variable " + io::in_quotes(name) + ", row " + std::to_string(row) + ": ";
    if (number == 0)
      throw BadValue(where + "is 0, which stands for no element, where one is needed");
    throw BadValue(where + std::to_string(number) + " is not in 1 to " + std::to_string(end));
  }

  // True for the two numbers that stand for none: 0, and one more than there are elements.
  static bool is_none(std::int64_t number, std::size_t end) {
    return number == 0 || (number > 0 && static_cast<std::uint64_t>(number) == end + 1);
  }

  // Reads rows of indices. If `may_lack`, 0 stands for none, and so does end + 1, which older
  // programs write.
  template <class Row>
  void read_rows(const char* name, std::size_t size, std::size_t end, std::vector<Row>& rows,
                 bool may_lack) const {
    constexpr std::size_t row_size = std::tuple_size_v<Row>;
    const io::VariableInFile& variable = require(name, static_cast<std::uint64_t>(size) * row_size);
    rows.resize(size);
    in_pieces(size, [&](std::size_t first, std::size_t last) {
      std::vector<std::int64_t> numbers((last - first) * row_size);
      file_.read_integers(variable, first * row_size, numbers);
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        const std::size_t row = first + k / row_size;
        rows[row][k % row_size] =
            may_lack && is_none(numbers[k], end) ? no_index : index_of(name, row, numbers[k], end);
      }
    });
  }

  // Makes edges with one cell have it first.
  void find_border() {
    for (std::size_t e = 0; e < arrays_.num_edges(); ++e) {
      auto& [a, b] = arrays_.cells_on_edge[e];
      if (a == no_index && b == no_index) {
        throw BadValue("edge " + std::to_string(e) + " has no cell");
      }
      if (a == no_index) std::swap(a, b);
      if (b == no_index) turn_normal_outward(e);
      num_border_edges_ += b == no_index ? 1U : 0U;
    }
    if (num_border_edges_ == 0 && arrays_.num_cells() < 4) {
      throw BadValue("fewer than four cells do not cover a sphere");
    }
  }

  // Makes the normal of an edge of the border point away from its cell. Programs that remove cells
  // keep the angle even where the first one is removed.
  void turn_normal_outward(std::size_t e) {
    const Point edge = normalized(arrays_.edge_points[e]);
    constexpr double at_pole = 1e-6;  // east has no meaning there
    if (edge.x * edge.x + edge.y * edge.y < at_pole * at_pole) return;
    const Point cell = normalized(arrays_.cell_points[arrays_.cells_on_edge[e][0]]);
    const Point across = 2 * dot(edge, cell) * edge - cell;  // their middle is the edge's point
    const double outward =
        meshing::edge_place(exact::to_vector(cell), exact::to_vector(across)).normal_angle;
    double& angle = arrays_.normal_angles[e];
    constexpr double turn = 2 * std::numbers::pi;
    if (std::abs(std::remainder(angle - outward, turn)) <= turn / 4) return;
    angle += angle > 0 ? -turn / 2 : turn / 2;
  }

  // Orders the two vertices of each edge such that the second one is to the left of its first
  // cell's direction, where the edge ends counterclockwise around that cell. The ring of the cell
  // decides, which works for edges that are too short for the positions of their vertices to
  // decide.
  void turn_edges() {
    std::vector<std::uint8_t> is_turned(arrays_.num_edges(), 0);
    in_pieces(arrays_.num_cells(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint64_t first = arrays_.edges_on_cell.offsets[i];
        const std::uint64_t last = arrays_.edges_on_cell.offsets[i + 1];
        for (std::uint64_t at = first; at < last; ++at) {
          const Index e = arrays_.edges_on_cell.values[at];
          if (arrays_.cells_on_edge[e][0] != i) continue;
          const Index next = arrays_.edges_on_cell.values[at + 1 < last ? at + 1 : first];
          const auto& ends = arrays_.vertices_on_edge[next];
          is_turned[e] = std::ranges::count(ends, arrays_.vertices_on_edge[e][1]) == 0 ? 1 : 0;
        }
      }
    });
    in_pieces(arrays_.num_edges(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) {
        auto& [v, w] = arrays_.vertices_on_edge[e];
        if (arrays_.cells_on_edge[e][0] == arrays_.cells_on_edge[e][1] || v == w) {
          throw BadValue("edge " + std::to_string(e) + " has the same cell or vertex twice");
        }
        if (is_turned[e] != 0) std::swap(v, w);
      }
    });
  }

  // Reads the edges around each cell, which are rows of a fixed length in the file.
  void read_rings() {
    const std::size_t size = arrays_.num_cells();
    const io::VariableInFile& counts = require("nEdgesOnCell", size);
    std::vector<std::int64_t> sides(size);
    file_.read_integers(counts, 0, sides);
    const io::VariableInFile& rings = require("edgesOnCell", 0);
    const std::uint64_t room = rings.num_values / size;
    if (room * size != rings.num_values)
      throw BadValue("the size of variable \"edgesOnCell\" is no multiple of the number of cells");
    for (std::size_t i = 0; i < size; ++i) {
      if (sides[i] < 3 || static_cast<std::uint64_t>(sides[i]) > room) {
        throw BadValue("variable \"nEdgesOnCell\", row " + std::to_string(i) + ": " +
                       std::to_string(sides[i]) + " is not in 3 to " + std::to_string(room));
      }
    }
    arrays_.edges_on_cell.offsets = system::offsets_of(
        size, [&](std::size_t i) { return static_cast<std::uint64_t>(sides[i]); });
    const std::uint64_t sides_of_edges = 2 * arrays_.num_edges() - num_border_edges_;
    if (arrays_.edges_on_cell.offsets.back() != sides_of_edges) {
      throw BadValue("the cells have " + std::to_string(arrays_.edges_on_cell.offsets.back()) +
                     " edges, and the edges " + std::to_string(sides_of_edges) + " cells");
    }
    arrays_.edges_on_cell.values.resize(arrays_.edges_on_cell.offsets.back());
    in_pieces(size, [&](std::size_t begin, std::size_t end) {
      std::vector<std::int64_t> numbers((end - begin) * room);
      file_.read_integers(rings, begin * room, numbers);
      for (std::size_t i = begin; i < end; ++i) {
        std::uint64_t at = arrays_.edges_on_cell.offsets[i];
        for (std::uint64_t j = 0; at < arrays_.edges_on_cell.offsets[i + 1]; ++at, ++j) {
          arrays_.edges_on_cell.values[at] =
              index_of("edgesOnCell", i, numbers[(i - begin) * room + j], arrays_.num_edges());
        }
      }
    });
  }

  // Finds the cells and vertices around each cell.
  void follow_rings() {
    arrays_.cells_on_cell.resize(arrays_.edges_on_cell.values.size());
    arrays_.vertices_on_cell.resize(arrays_.edges_on_cell.values.size());
    in_pieces(arrays_.num_cells(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) follow_ring(static_cast<Index>(i));
    });
  }

  // Finds the cells and vertices of one ring, and throws BadValue unless its edges follow each
  // other counterclockwise. Around its first cell, an edge begins at its first vertex.
  void follow_ring(Index cell) {
    const std::uint64_t end = arrays_.edges_on_cell.offsets[cell + 1];
    // A ring begins where its last edge ends.
    Index last_end = end_of(arrays_.edges_on_cell.values[end - 1], cell, 1);
    Point last_corner = arrays_.vertex_points[last_end] - arrays_.cell_points[cell];
    Point around{0, 0, 0};
    for (std::uint64_t at = arrays_.edges_on_cell.offsets[cell]; at < end; ++at) {
      const Index e = arrays_.edges_on_cell.values[at];
      const auto [a, b] = arrays_.cells_on_edge[e];
      if (a != cell && b != cell) {
        throw BadValue("cell " + std::to_string(cell) + " has edge " + std::to_string(e) +
                       ", which is not one of its own");
      }
      if (end_of(e, cell, 0) != last_end) refuse_ring(cell);
      arrays_.cells_on_cell[at] = a == cell ? b : a;
      arrays_.vertices_on_cell[at] = last_end = end_of(e, cell, 1);
      const Point corner = arrays_.vertex_points[last_end] - arrays_.cell_points[cell];
      around = around + cross(last_corner, corner);
      last_corner = corner;
    }
    // The vector area of the ring points outward if the ring is counterclockwise.
    if (!(dot(around, arrays_.cell_points[cell]) > 0)) refuse_ring(cell);
  }
  // Throws BadValue for a ring that is broken or clockwise.
  [[noreturn]] static void refuse_ring(Index cell) {
    throw BadValue("the edges around cell " + std::to_string(cell) +
                   " do not follow each other counterclockwise");
  }
  // Returns the vertex at the begin (which = 0) or the end (1) of an edge, counterclockwise around
  // a cell.
  [[nodiscard]] Index end_of(Index edge, Index cell, std::size_t which) const {
    const bool is_first = arrays_.cells_on_edge[edge][0] == cell;
    return arrays_.vertices_on_edge[edge][is_first ? which : 1 - which];
  }

  // Reads the areas of kites; those of missing cells are any finite numbers.
  void read_kites() {
    const std::size_t size = arrays_.num_vertices();
    const io::VariableInFile& variable =
        require("kiteAreasOnVertex", 3 * static_cast<std::uint64_t>(size));
    arrays_.kite_areas.resize(size);
    in_pieces(size, [&](std::size_t begin, std::size_t end) {
      std::array<double, 3 * read_grain> values;
      file_.read_numbers(variable, 3 * begin, std::span(values).first(3 * (end - begin)));
      for (std::size_t v = begin; v < end; ++v) {
        for (std::size_t j = 0; j < 3; ++j) {
          arrays_.kite_areas[v][j] = values[3 * (v - begin) + j];
          require_finite("kiteAreasOnVertex", 3 * v + j, arrays_.kite_areas[v][j]);
        }
      }
    });
  }

  // Orders the cells of each vertex counterclockwise, with the edge before each cell: where the
  // ring of a cell reaches the vertex, it has just left the next cell, and continues along the edge
  // before that.
  void find_edges_of_vertices() {
    arrays_.edges_on_vertex.resize(arrays_.num_vertices());
    in_pieces(arrays_.num_vertices(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto v = static_cast<Index>(i);
        Triple& cells = arrays_.cells_on_vertex[v];
        if (!is_counterclockwise(v)) {
          std::swap(cells[1], cells[2]);
          std::swap(arrays_.kite_areas[v][1], arrays_.kite_areas[v][2]);
        }
        Triple& edges = arrays_.edges_on_vertex[v];
        edges = {no_index, no_index, no_index};
        for (std::size_t j = 0; j < 3; ++j) {
          if (cells[j] == no_index) continue;
          const std::uint64_t at = place_of(v, cells[j]);
          const std::size_t next = (j + 1) % 3;
          if (arrays_.cells_on_cell[at] != cells[next]) {
            throw BadValue(
                "vertex " + std::to_string(v) + " has no edge between its cell " +
                std::to_string(cells[j]) + " and " +
                (cells[next] == no_index ? "the border" : "cell " + std::to_string(cells[next])));
          }
          // The edge between cell j and the next one stands before the next one.
          edges[next] = arrays_.edges_on_cell.values[at];
          edges[j] = arrays_.edges_on_cell.values[after(at, cells[j])];
        }
      }
    });
  }
  // True if the cells of a vertex with two or three cells are counterclockwise. With one cell both
  // orders hold.
  [[nodiscard]] bool is_counterclockwise(Index v) const {
    const Triple& cells = arrays_.cells_on_vertex[v];
    const auto has_cell = [](Index cell) { return cell != no_index; };
    const auto count = std::ranges::count_if(cells, has_cell);
    if (count == 0) throw BadValue("vertex " + std::to_string(v) + " has no cell");
    if (count == 1) return true;
    std::size_t j = 0;
    while (cells[j] == no_index || cells[(j + 1) % 3] == no_index) ++j;
    return arrays_.cells_on_cell[place_of(v, cells[j])] == cells[(j + 1) % 3];
  }
  // Returns the position that follows in the ring of a cell.
  [[nodiscard]] std::uint64_t after(std::uint64_t at, Index cell) const {
    return at + 1 < arrays_.edges_on_cell.offsets[cell + 1] ? at + 1
                                                            : arrays_.edges_on_cell.offsets[cell];
  }
  // Returns the position of a vertex in the ring of a cell.
  [[nodiscard]] std::uint64_t place_of(Index v, Index cell) const {
    for (std::uint64_t at = arrays_.edges_on_cell.offsets[cell];
         at < arrays_.edges_on_cell.offsets[cell + 1]; ++at) {
      if (arrays_.vertices_on_cell[at] == v) return at;
    }
    throw BadValue("vertex " + std::to_string(v) + " is none of those of cell " +
                   std::to_string(cell));
  }

  const io::NetcdfReader& file_;
  unsigned threads_;
  const Execution& execution_;
  // The number of edges with one cell.
  std::uint64_t num_border_edges_ = 0;
  VoronoiMesh arrays_;
};

}  // namespace

VoronoiMesh read_mpas(const FileName& file, const Execution& execution) {
  const system::Call call(execution);
  io::FileBytes bytes(file, true);
  return io::in_file(bytes.name(),
                     [&] { return formats::read_mpas_arrays(io::NetcdfReader(bytes), execution); });
}

}  // namespace rondel::mesh

namespace rondel::formats {

bool has_mpas_arrays(const io::NetcdfReader& file) {
  return file.find("cellsOnEdge") != nullptr && file.find("verticesOnEdge") != nullptr;
}

mesh::VoronoiMesh read_mpas_arrays(const io::NetcdfReader& file, const Execution& execution) {
  return mesh::MpasReader(file, execution).read();
}

}  // namespace rondel::formats
