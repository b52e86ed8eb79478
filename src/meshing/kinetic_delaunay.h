// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The Delaunay triangulation of sites that all move a little, again and again.
//
// in    the sites after each step, as unit vectors
// out   faces, their neighbors and circumcenters
// index sites, which are the vertices; faces, in an order of their own
//
// Few edges change between two steps, so the faces are kept: one pass checks every edge, and edges
// that are no longer locally Delaunay are flipped (Lawson). A filter decides nearly always, the
// exact predicate otherwise, ties included. If a face has turned over, the triangulation is built
// anew.
//
// Invariants after update():
// 1. The faces are those that delaunay() computes for the sites, in an order of their own.
// 2. A face begins with its lowest corner, and centers()[f] depends on its three corners alone. So
//    nothing that goes around a vertex from a fixed neighbor depends on the history of the faces.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "exact/vector.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "topology/mesh.h"

namespace rondel::mesh {

using Vector = exact::Vector3<double>;

inline Index next_of(Index corner) { return corner == 2 ? 0 : corner + 1; }
inline Index previous_of(Index corner) { return corner == 0 ? 2 : corner - 1; }

// A triangulation that follows its sites.
class KineticDelaunay {
 public:
  explicit KineticDelaunay(unsigned threads) : threads_(threads) {}

  // Updates the triangulation to these sites. Returns false if they have no triangulation that
  // surrounds the center and has all of them as vertices; the triangulation is empty then.
  // Precondition: lengths within 3 * 2^-53 of 1.
  [[nodiscard]] bool update(std::span<const Point> sites);

  // Makes the next update() build anew.
  void reset() { faces_.clear(); }

  [[nodiscard]] std::span<const Triple> faces() const { return faces_; }
  [[nodiscard]] std::span<const Triple> neighbors() const { return neighbors_; }
  [[nodiscard]] std::span<const Point> centers() const { return centers_; }
  [[nodiscard]] unsigned threads() const { return threads_; }
  [[nodiscard]] std::size_t num_builds() const { return num_builds_; }
  [[nodiscard]] std::size_t num_flips() const { return num_flips_; }

  // Sets `ring` to the faces around a vertex counterclockwise, beginning with the face whose next
  // corner is the lowest neighbor.
  void faces_around(Index vertex, std::vector<Index>& ring) const;

  // Returns which corner of a face this vertex is.
  [[nodiscard]] Index corner_of(Index face, Index vertex) const {
    return topology::corner_of(faces_[face], vertex);
  }

 private:
  // The result of checking a face: all edges are Delaunay, one is not, or the face has turned over.
  enum class Look : unsigned char { fine, broken, turned };

  // Builds the triangulation from the beginning; returns false as update() does.
  bool build(std::span<const Point> sites);
  // Flips edges until all are Delaunay; returns false if it is better to build anew.
  bool mend(std::span<const Point> sites);
  // Computes the center of a face and checks its edges.
  Look look_at(std::span<const Point> sites, Index face);
  // True if the edge opposite to a corner is not Delaunay.
  [[nodiscard]] bool is_to_flip(std::span<const Point> sites, Index face, Index corner) const;
  // Flips the edge opposite to a corner.
  void flip(Index face, Index corner);
  // Rotates the corners of a face such that the lowest one is first.
  void begin_with_lowest(Index face);
  // Replaces one neighbor of a face by another.
  void replace_neighbor(Index face, Index before, Index after);

  std::vector<Triple> faces_;
  std::vector<Triple> neighbors_;
  std::vector<Point> centers_;
  std::vector<Index> first_face_;  // by vertex: a face that has it
  unsigned threads_;
  std::size_t num_builds_ = 0;
  std::size_t num_flips_ = 0;
};

}  // namespace rondel::mesh
