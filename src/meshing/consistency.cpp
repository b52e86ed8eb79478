// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks that the arrays of a mesh, which callers may have filled, have the right sizes and indices
// in range.

#include "meshing/consistency.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "exact/vector.h"
#include "rondel/error.h"
#include "system/message_text.h"
#include "system/parallel.h"

namespace rondel::meshing {
namespace {

// Throws InvalidInput for the first point that is not on the sphere.
void require_points(const char* name, unsigned threads, const std::vector<Point>& points,
                    double radius) {
  constexpr std::size_t grain = 65536;
  system::parallel_for(threads, points.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (is_on_sphere(points[i], radius)) continue;
      throw InvalidInput(std::string("the mesh's ") + name + " have a point " + std::to_string(i) +
                             " that is not on its sphere",
                         i);
    }
  });
}

// Says whether an array may contain no_index, as at the border of a mesh.
enum class None : std::uint8_t { refused, allowed };

// Throws InvalidInput if an array has not the wanted size.
void require_size(const char* name, std::size_t size, std::size_t wanted) {
  if (size == wanted) return;
  throw InvalidInput(
      "the mesh has " + std::to_string(size) + ' ' + name + " instead of " + std::to_string(wanted),
      0);
}

// Throws InvalidInput for the first piece of an array that has an index of `end` or more. Rows are
// arrays of a fixed number of indices, and are read as one list of them.
template <class Row>
void require_indices(const char* name, unsigned threads, const std::vector<Row>& rows,
                     std::size_t end, None none = None::refused) {
  constexpr std::size_t grain = 65536;
  static_assert(sizeof(Index) == 4);
  constexpr std::size_t row_size = sizeof(Row) / 4;
  const auto numbers =
      std::span<const Index>(reinterpret_cast<const Index*>(rows.data()), rows.size() * row_size);
  system::parallel_for(threads, numbers.size(), grain, [&](std::size_t first, std::size_t last) {
    Index most = 0;
    for (std::size_t i = first; i < last; ++i) {
      if (numbers[i] != no_index || none == None::refused) most = std::max(most, numbers[i]);
    }
    if (most < end) return;
    throw InvalidInput(std::string("the mesh's ") + name + " have the number " +
                           std::to_string(most) + " of " + std::to_string(end),
                       first);
  });
}

// The numbers that an array may have: up to `most`, from `least` on or, unless `has_least`, above
// it.
struct PossibleNumbers {
  double least;
  double most;
  bool has_least;
};

// is_exception(i, number) allows a number that is not possible elsewhere.
template <class IsException>
void require_numbers(const char* name, unsigned threads, std::span<const double> numbers,
                     const PossibleNumbers& possible, const IsException& is_exception) {
  constexpr std::size_t grain = 65536;
  constexpr double slack =
      1e-3;  // as single precision, and spheres that are not quite round, ask for
  const double most = possible.most * (1 + slack);
  const double least = possible.least * (1 + slack);
  system::parallel_for(threads, numbers.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double number = numbers[i];
      const bool is_above = possible.has_least ? number >= least : number > least;
      if (is_above && number <= most) continue;
      if (is_exception(i, number)) continue;
      std::string why = " is not positive";
      if (possible.has_least) why = " is less than " + system::shortest_text(possible.least);
      if (number > most) why = " is more than " + system::shortest_text(possible.most);
      if (!std::isfinite(number)) why = " is not finite";
      throw InvalidInput("variable \"" + std::string(name) + "\", value " + std::to_string(i) +
                             ": " + system::shortest_text(number) + why,
                         i);
    }
  });
}

}  // namespace

// The names are those of MPAS, which users of MPAS files know.
bool is_on_sphere(const Point& p, double radius) {
  return std::abs(norm(exact::to_vector(p)) - radius) <= 1e-3 * radius;
}

void require_possible_numbers(const mesh::VoronoiMesh& arrays, unsigned threads) {
  constexpr double turn = 2 * std::numbers::pi;
  const PossibleNumbers areas{0, 2 * turn * arrays.radius * arrays.radius, false};
  const PossibleNumbers distances{0, turn * arrays.radius, false};
  const PossibleNumbers lengths{0, turn * arrays.radius, true};
  const PossibleNumbers angles{-turn, turn, true};
  const auto never = [](std::size_t, double) { return false; };
  require_numbers("areaCell", threads, arrays.cell_areas, areas, never);
  require_numbers("dcEdge", threads, arrays.cell_distances, distances,
                  [&](std::size_t e, double distance) {
                    return distance == 0 && is_at_border(arrays.cells_on_edge[e]);
                  });
  require_numbers("dvEdge", threads, arrays.vertex_distances, lengths, never);
  require_numbers("angleEdge", threads, arrays.normal_angles, angles, never);
  require_numbers("areaTriangle", threads, arrays.triangle_areas, areas,
                  [&](std::size_t v, double area) {
                    return std::abs(area) <= areas.most && is_at_border(arrays.cells_on_vertex[v]);
                  });
}

void require_consistent(const mesh::VoronoiMesh& arrays, unsigned threads) {
  const std::size_t cells = arrays.num_cells();
  const std::size_t edges = arrays.num_edges();
  const std::size_t vertices = arrays.num_vertices();
  if (cells == 0) throw InvalidInput("the mesh has no cells");
  require_points("cell_points", threads, arrays.cell_points, arrays.radius);
  require_points("edge_points", threads, arrays.edge_points, arrays.radius);
  require_points("vertex_points", threads, arrays.vertex_points, arrays.radius);
  require_size("cell_areas", arrays.cell_areas.size(), cells);
  if (!arrays.density.empty()) require_size("density", arrays.density.size(), cells);
  require_size("offsets", arrays.edges_on_cell.offsets.size(), cells + 1);
  for (std::size_t i = 0; i < cells; ++i) {
    // A cell has three edges at least.
    if (arrays.edges_on_cell.offsets[i] + 3 > arrays.edges_on_cell.offsets[i + 1] ||
        arrays.edges_on_cell.offsets[0] != 0) {
      throw InvalidInput(
          "the offsets of the mesh do not grow by three or more at cell " + std::to_string(i), i);
    }
  }
  const auto entries = static_cast<std::size_t>(arrays.edges_on_cell.offsets.back());
  require_size("edges_on_cell", arrays.edges_on_cell.values.size(), entries);
  require_size("cells_on_cell", arrays.cells_on_cell.size(), entries);
  require_size("vertices_on_cell", arrays.vertices_on_cell.size(), entries);
  require_size("cells_on_edge", arrays.cells_on_edge.size(), edges);
  require_size("vertices_on_edge", arrays.vertices_on_edge.size(), edges);
  require_size("cell_distances", arrays.cell_distances.size(), edges);
  require_size("vertex_distances", arrays.vertex_distances.size(), edges);
  require_size("normal_angles", arrays.normal_angles.size(), edges);
  require_size("cells_on_vertex", arrays.cells_on_vertex.size(), vertices);
  require_size("edges_on_vertex", arrays.edges_on_vertex.size(), vertices);
  require_size("kite_areas", arrays.kite_areas.size(), vertices);
  require_size("triangle_areas", arrays.triangle_areas.size(), vertices);
  require_indices("edges_on_cell", threads, arrays.edges_on_cell.values, edges);
  require_indices("cells_on_cell", threads, arrays.cells_on_cell, cells, None::allowed);
  require_indices("vertices_on_cell", threads, arrays.vertices_on_cell, vertices);
  require_indices("cells_on_edge", threads, arrays.cells_on_edge, cells, None::allowed);
  require_indices("vertices_on_edge", threads, arrays.vertices_on_edge, vertices);
  require_indices("cells_on_vertex", threads, arrays.cells_on_vertex, cells, None::allowed);
  require_indices("edges_on_vertex", threads, arrays.edges_on_vertex, edges, None::allowed);
  require_possible_numbers(arrays, threads);
  for (std::size_t e = 0; e < edges; ++e) {
    if (arrays.cells_on_edge[e][0] != no_index) continue;
    throw InvalidInput("edge " + std::to_string(e) + " of the mesh has no first cell", e);
  }
}

}  // namespace rondel::meshing
