// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds how cells that have one ring of corners each meet: the index lists of a mesh, without
// coordinates.
//
// in    rings of corners, counterclockwise
// out   opposite sides; the lists of a mesh
// index sides: positions in CellRings::corners; cells; corners
#pragma once

#include <cstddef>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/mesh.h"

namespace rondel::meshing {

// The sides of all rings: side k ends at corners[k] and begins at the corner before it in its ring.
// Two sides between the same corners in opposite directions are opposite: they form an edge of two
// cells.
//
//                 \  side k  \.
//        cell_of(k) \    opposite(k)     A side without an opposite is an edge of the border.
//                    \          \.
class RingSides {
 public:
  // Precondition: each cell has one ring of three or more corners. Keeps a reference to the cells.
  // Throws BadValue if there are too many sides to number.
  explicit RingSides(const CellRings& cells);

  [[nodiscard]] bool has_border() const { return has_border_; }
  [[nodiscard]] std::size_t num_sides() const { return opposite_.size(); }
  // Returns the opposite side, or no_index at the border.
  [[nodiscard]] Index opposite(Index side) const { return opposite_[side]; }
  [[nodiscard]] Index cell_of(Index side) const { return cell_of_[side]; }
  // Returns the corner at which the side ends.
  [[nodiscard]] Index corner(Index side) const { return cells_.corners[side]; }
  // Returns the side that follows in the ring, counterclockwise.
  [[nodiscard]] Index next(Index side) const {
    const Index cell = cell_of_[side];
    return side + 1 < cells_.rings[cell + 1] ? side + 1 : static_cast<Index>(cells_.rings[cell]);
  }
  // Returns the side that comes before in the ring.
  [[nodiscard]] Index previous(Index side) const {
    const Index cell = cell_of_[side];
    return side > cells_.rings[cell] ? side - 1 : static_cast<Index>(cells_.rings[cell + 1] - 1);
  }

  // Sets the lists of a mesh with a border; vertices are numbered in the order of the corners. A
  // corner at which parts of the mesh touch without a common edge becomes one vertex for each part.
  // Throws BadValue for a corner of more than three cells.
  void set_lists(mesh::VoronoiMesh& arrays) const;

 private:
  // Sets opposite_ for all sides.
  void find_opposites();
  // Returns a side that runs the other way between the same corners, or no_index.
  [[nodiscard]] Index find_opposite(Index side) const;
  // The sides that end at a corner are ending_[begins_[corner]] ... ending_[begins_[corner + 1] -
  // 1].
  [[nodiscard]] Index degree(Index corner) const { return begins_[corner + 1] - begins_[corner]; }
  // Adds the vertices of a corner: one for each connected part of the cells around it.
  void add_vertices(Index corner, mesh::VoronoiMesh& arrays) const;
  // Adds a vertex whose `count` cells follow counterclockwise from the cell of side `first`.
  void add_vertex(Index first, std::size_t count, mesh::VoronoiMesh& arrays) const;
  // Numbers the edges and sets the lists of cells and vertices of edges.
  void number_edges(mesh::VoronoiMesh& arrays) const;

  const CellRings& cells_;
  std::vector<Index> cell_of_;
  std::vector<Index> begins_;
  std::vector<Index> ending_;
  std::vector<Index> opposite_;
  bool has_border_ = false;
};

}  // namespace rondel::meshing
