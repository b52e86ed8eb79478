// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces that fill the seam, and the surface that they and the final faces of the blocks form.
//
// in    what blocks leave to the seam, and the faces that are found there
// out   these faces, linked to each other and to the final faces of the blocks
// index seam sites; a face is named as blocks name theirs, and faces of the seam follow
#pragma once

#include <span>
#include <vector>

#include "bulk/emit.h"
#include "system/large_arrays.h"
#include "topology/triangulation_arrays.h"

namespace rondel::bulk {

class SeamFaces {
 public:
  // Without faces. `store` is where the blocks wrote theirs.
  SeamFaces(std::span<const BlockResult> results, FaceStore store, unsigned threads);

  // Returns the first seam site of block i.
  [[nodiscard]] Index first_site(std::size_t i) const { return first_site_[i]; }

  // Room for all faces that there can be, so that they are not moved when there are more.
  void reserve() {
    corners_.reserve(2 * sites_.size());
    neighbors_.reserve(2 * sites_.size());
  }
  // Makes room for so many faces behind those there are, and returns the name of the first one.
  Index add(std::size_t count);
  // Where a face of the seam is written: corners as seam sites, the lowest one first, and neighbors.
  Triple& seam_corners(Index face) { return corners_[face - names_begin()]; }
  // Returns the neighbors of a face of either kind.
  Triple& neighbors(Index face) {
    return face < names_begin() ? store_.neighbors[face] : neighbors_[face - names_begin()];
  }

  // Adds the faces of a triangulation that are in the region that `edges` bound, all edges with a
  // final face on the left and none on the right. Its sites, and those of the edges, are positions
  // among these seam sites, or seam sites themselves if there are none. Nothing is added after this.
  // Returns false if not each of the edges was met, once.
  bool fill(TriangulationArrays seam, std::span<const Index> sites, std::vector<SeamEdge> edges,
            unsigned threads);

  // Without a triangulation to fill what is left. Nothing is added after this.
  void leave_open(unsigned threads);

  // Seam faces follow the faces of the blocks: a name below this is one of those.
  [[nodiscard]] Index names_begin() const { return static_cast<Index>(store_.corners.size()); }
  // Behind all names.
  [[nodiscard]] Index names_end() const {
    return names_begin() + static_cast<Index>(corners_.size());
  }
  [[nodiscard]] std::span<const SeamSite> sites() const { return sites_; }
  // The faces that seam site s owns; counterclockwise if are_in_order().
  [[nodiscard]] std::span<const Index> owned_by(Index s) const { return owned_by(s, s + 1); }
  // The faces that seam sites begin ... end-1 own.
  [[nodiscard]] std::span<const Index> owned_by(Index begin, Index end) const {
    return std::span(owned_).subspan(owned_begin_[begin], owned_begin_[end] - owned_begin_[begin]);
  }
  [[nodiscard]] bool are_in_order() const { return first_filled_ == 0; }
  [[nodiscard]] const Triple& seam_corners(Index face) const {
    return corners_[face - names_begin()];
  }
  // Their names.
  [[nodiscard]] const std::vector<Index>& ghost_faces() const { return ghost_faces_; }

  // The corners, which are ranks, and the neighbors of a face of either kind, by its name.
  [[nodiscard]] Triple corners(Index face) const {
    if (face < names_begin()) return store_.corners[face];
    const Triple& v = seam_corners(face);
    return {sites_[v[0]].rank, sites_[v[1]].rank, sites_[v[2]].rank};
  }
  [[nodiscard]] const Triple& neighbors(Index face) const {
    return face < names_begin() ? store_.neighbors[face] : neighbors_[face - names_begin()];
  }

 private:
  bool find_region(TriangulationArrays& seam, std::vector<SeamEdge> edges, unsigned threads);
  void append(TriangulationArrays seam, std::span<const Index> sites);
  void list_owned(unsigned threads);

  FaceStore store_;
  std::vector<Index> first_site_;
  LargeVector<SeamSite> sites_;
  LargeVector<Triple> corners_;  // seam sites
  LargeVector<Triple> neighbors_;
  std::vector<Index> ghost_faces_;
  std::size_t first_filled_ = 0;  // the faces from here on are there to fill a region
  std::vector<bool> is_inside_;   // those of them that do
  std::vector<Index> owned_;
  std::vector<Index> owned_begin_;
};

}  // namespace rondel::bulk
