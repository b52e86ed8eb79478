// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/ring_surface.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "io/bad_value.h"
#include "system/row_assembly.h"

namespace rondel::meshing {
namespace {

// Throws BadValue with the cell and what is wrong with its corner.
[[noreturn]] void refuse_corner(Index cell, const char* what) {
  throw io::BadValue("cell " + std::to_string(cell) + " has a corner " + what +
                     ", which no vertex of a mesh has");
}

}  // namespace

RingSides::RingSides(const CellRings& cells) : cells_(cells) {
  if (cells.corners.size() >= no_index) throw io::BadValue("more than 2^32 - 2 corners of cells");
  cell_of_.resize(cells.corners.size());
  system::RowPlaces<Index> places(cells.points.size());
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    for (std::uint64_t k = cells.rings[i]; k < cells.rings[i + 1]; ++k) {
      cell_of_[k] = static_cast<Index>(i);
      places.count(cells.corners[k]);
    }
  }
  ending_.resize(places.sum());
  for (std::size_t side = 0; side < cells.corners.size(); ++side) {
    ending_[places.place(cells.corners[side])] = static_cast<Index>(side);
  }
  begins_ = std::move(places).offsets();
  find_opposites();
}

// Makes opposites mutual: of several equal sides only one has an opposite, so that overlapping
// cells have a border.
void RingSides::find_opposites() {
  opposite_.resize(cells_.corners.size());
  for (Index side = 0; side < opposite_.size(); ++side) opposite_[side] = find_opposite(side);
  for (Index side = 0; side < opposite_.size(); ++side) {
    const Index other = opposite_[side];
    if (other != no_index && opposite_[other] == side) continue;
    opposite_[side] = no_index;
    has_border_ = true;
  }
}

// Searches among the sides of that corner that has fewer, since all cells may have one corner.
Index RingSides::find_opposite(Index side) const {
  const Index to = corner(side);
  const Index from = corner(previous(side));
  const bool is_from = degree(from) <= degree(to);
  const Index at = is_from ? from : to;
  for (Index k = begins_[at]; k < begins_[at + 1]; ++k) {
    const Index other = is_from ? ending_[k] : next(ending_[k]);
    if (corner(other) == from && corner(previous(other)) == to && cell_of(other) != cell_of(side)) {
      return other;
    }
  }
  return no_index;
}

void RingSides::set_lists(mesh::VoronoiMesh& arrays) const {
  arrays.edges_on_cell.offsets = cells_.rings;
  arrays.vertices_on_cell.assign(num_sides(), no_index);
  for (Index corner = 0; corner + 1 < begins_.size(); ++corner) add_vertices(corner, arrays);
  number_edges(arrays);
  arrays.cells_on_cell.resize(num_sides());
  for (Index side = 0; side < num_sides(); ++side) {
    arrays.cells_on_cell[side] = opposite(side) == no_index ? no_index : cell_of(opposite(side));
  }
}

// Counterclockwise around a corner, the cell across the side that ends there comes after a cell,
// and the cell across the side that begins there comes before it.
void RingSides::add_vertices(Index corner, mesh::VoronoiMesh& arrays) const {
  const auto sides = std::span(ending_).subspan(begins_[corner], degree(corner));
  if (sides.size() > 3) refuse_corner(cell_of(sides.front()), "of more than three cells");
  std::size_t left = sides.size();
  const auto add = [&](Index first) {
    std::size_t count = 1;
    Index last = first;
    while (count < sides.size()) {
      const Index across = opposite(last);
      if (across == no_index || previous(across) == first) break;
      last = previous(across);
      ++count;
    }
    const bool is_open = opposite(last) == no_index;
    if (count == 3 && is_open)
      refuse_corner(cell_of(sides.front()), "of three cells and the border");
    if (count < 3 && !is_open) refuse_corner(cell_of(sides.front()), "of two cells alone");
    add_vertex(first, count, arrays);
    left -= count;
  };
  for (const Index side : sides) {
    if (opposite(next(side)) == no_index) add(side);
  }
  if (left > 0) add(sides.front());
}

void RingSides::add_vertex(Index first, std::size_t count, mesh::VoronoiMesh& arrays) const {
  const auto vertex = static_cast<Index>(arrays.vertex_points.size());
  arrays.vertex_points.push_back(cells_.points[corner(first)]);
  Triple cells = {no_index, no_index, no_index};
  Index side = first;
  for (std::size_t k = 0; k < count; ++k) {
    cells[k] = cell_of(side);
    arrays.vertices_on_cell[side] = vertex;
    if (k + 1 < count) side = previous(opposite(side));
  }
  arrays.cells_on_vertex.push_back(cells);
}

// Numbers edges in the order of the first of their two vertices.
void RingSides::number_edges(mesh::VoronoiMesh& arrays) const {
  arrays.edges_on_cell.values.assign(num_sides(), no_index);
  arrays.edges_on_vertex.assign(arrays.num_vertices(), {no_index, no_index, no_index});
  std::vector<Index> first_sides(arrays.num_vertices(), no_index);
  for (Index side = 0; side < num_sides(); ++side) {
    const Index v = arrays.vertices_on_cell[side];
    if (arrays.cells_on_vertex[v][0] == cell_of(side)) first_sides[v] = side;
  }
  const auto number = [&](Index side) {
    Index& edge = arrays.edges_on_cell.values[side];
    if (edge != no_index) return edge;
    edge = static_cast<Index>(arrays.cells_on_edge.size());
    const Index other = opposite(side);
    const bool is_first = other == no_index || cell_of(side) < cell_of(other);
    if (other != no_index) arrays.edges_on_cell.values[other] = edge;
    const Index ring_side = is_first ? side : other;
    arrays.cells_on_edge.push_back(
        {cell_of(ring_side), other == no_index ? no_index : cell_of(is_first ? other : side)});
    arrays.vertices_on_edge.push_back(
        {arrays.vertices_on_cell[previous(ring_side)], arrays.vertices_on_cell[ring_side]});
    return edge;
  };
  for (std::size_t v = 0; v < first_sides.size(); ++v) {
    Index side = first_sides[v];
    for (std::size_t k = 0; k < 3 && arrays.cells_on_vertex[v][k] != no_index; ++k) {
      arrays.edges_on_vertex[v][k] = number(next(side));
      arrays.edges_on_vertex[v][(k + 1) % 3] = number(side);
      if (opposite(side) != no_index) side = previous(opposite(side));
    }
  }
}

}  // namespace rondel::meshing
