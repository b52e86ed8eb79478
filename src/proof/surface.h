// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The combinatorial half of the validator: whether triangles form one closed, oriented
// surface of the type of the sphere. It knows no coordinates.
//
// Notation. Halfedge h = 3*face + i is the edge opposite to corner i of the face, from
// corner i+1 to corner i+2 (mod 3); corner i is its apex. opposite(h) is the halfedge of
// the face across, which runs the other way:
//
//             apex(h)
//              / \            face of h, counterclockwise
//     origin(h) -> target(h)
//              \ /            face of opposite(h)
//         apex(opposite(h))
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::proof {

// A number in the description of a flaw.
inline std::string text(std::size_t value) { return std::to_string(value); }

inline bool contains(const Triple& face, Index site) {
  return std::ranges::find(face, site) != face.end();
}

class Surface {
 public:
  // Reads the triangles, which must outlive the surface. If flaw() is empty:
  // 1. Corners are sites and those of one face are distinct.
  // 2. Every edge belongs to two faces, which run along it in opposite directions.
  // 3. The faces at a vertex form one cycle.
  // 4. The surface is connected and V - E + F = 2.
  Surface(std::size_t num_sites, std::span<const Triple> triangles);

  // The first property that fails, in one line; only with an empty flaw may the rest be called.
  [[nodiscard]] const std::string& flaw() const { return flaw_; }

  [[nodiscard]] std::size_t num_faces() const { return triangles_.size(); }
  [[nodiscard]] std::size_t num_edges() const { return opposite_.size() / 2; }
  [[nodiscard]] std::size_t num_vertices() const { return num_vertices_; }
  [[nodiscard]] bool is_vertex(Index site) const { return corner_of_[site] != no_index; }
  [[nodiscard]] const Triple& face(Index f) const { return triangles_[f]; }

  [[nodiscard]] Index opposite(Index h) const { return opposite_[h]; }
  [[nodiscard]] Index apex(Index h) const { return triangles_[h / 3][h % 3]; }
  [[nodiscard]] Index origin(Index h) const { return triangles_[h / 3][(h % 3 + 1) % 3]; }
  [[nodiscard]] Index target(Index h) const { return triangles_[h / 3][(h % 3 + 2) % 3]; }

  // The vertices around `vertex`, counterclockwise seen from outside.
  [[nodiscard]] std::vector<Index> link(Index vertex) const;

 private:
  // Each returns the flaw that it finds.
  [[nodiscard]] std::string read_corners(std::size_t num_sites);
  [[nodiscard]] std::string match_edges();
  [[nodiscard]] std::string match_bucket(std::span<Index> bucket);
  [[nodiscard]] std::string describe_edge(std::span<const Index> halfedges) const;
  [[nodiscard]] std::string follow_stars() const;
  [[nodiscard]] std::string reach_all_faces() const;
  [[nodiscard]] std::string count_euler() const;

  // The corner (as a halfedge) at the same vertex in the next face counterclockwise.
  [[nodiscard]] Index next_corner(Index h) const;

  std::span<const Triple> triangles_;
  std::vector<Index> corner_of_;  // by site: one corner at it, no_index if it is no vertex
  std::vector<Index> opposite_;
  std::size_t num_vertices_ = 0;
  std::string flaw_;
};

}  // namespace rondel::proof
