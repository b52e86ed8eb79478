// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces that fill the seam, and the surface that they and the final faces of the blocks form.
//
// in    what blocks leave to the seam, and the triangulation of the seam sites
// out   which of its faces belong to the result, linked to the final faces of the blocks
// index seam sites; a face is named as blocks name theirs, and faces of the seam follow
#pragma once

#include <span>
#include <vector>

#include "bulk/emit.h"
#include "topology/triangulation_arrays.h"

namespace rondel::bulk {

class SeamFaces {
 public:
  // `seam` is the triangulation of the seam sites. Links the faces of the region that `edges`
  // bound to the final faces of the blocks.
  SeamFaces(std::span<const BlockResult> results, FaceStore store, TriangulationArrays seam,
            unsigned threads);

  // Seam faces follow the faces of the blocks: a name below this is one of those.
  [[nodiscard]] Index names_begin() const { return static_cast<Index>(store_.corners.size()); }
  [[nodiscard]] std::span<const SeamSite> sites() const { return sites_; }
  [[nodiscard]] std::size_t num_all() const { return seam_.faces.size(); }
  // The faces that seam site s owns, counterclockwise.
  [[nodiscard]] std::span<const Index> owned_by(Index s) const { return owned_by(s, s + 1); }
  // The faces that seam sites begin ... end-1 own.
  [[nodiscard]] std::span<const Index> owned_by(Index begin, Index end) const {
    return std::span(owned_).subspan(owned_begin_[begin], owned_begin_[end] - owned_begin_[begin]);
  }
  [[nodiscard]] bool is_inside(Index seam_face) const { return is_inside_[seam_face]; }
  // Corners as seam sites.
  [[nodiscard]] const Triple& seam_corners(Index seam_face) const { return seam_.faces[seam_face]; }
  [[nodiscard]] const std::vector<Index>& ghost_faces() const { return seam_.ghost_faces; }
  // Whether each edge of the region was met, once.
  [[nodiscard]] bool fits() const { return fits_; }

  // The corners, which are ranks, and the neighbors of a face of either kind, by its name.
  [[nodiscard]] Triple corners(Index face) const {
    if (face < names_begin()) return store_.corners[face];
    const Triple& v = seam_.faces[face - names_begin()];
    return {sites_[v[0]].rank, sites_[v[1]].rank, sites_[v[2]].rank};
  }
  [[nodiscard]] const Triple& neighbors(Index face) const {
    return face < names_begin() ? store_.neighbors[face] : seam_.neighbors[face - names_begin()];
  }

 private:
  // Returns the edge of the region with the seam on its left that runs from site b to site a.
  [[nodiscard]] const SeamEdge* find_edge(Index b, Index a) const;
  void collect(std::span<const BlockResult> results);
  void fill(unsigned threads);
  void list_owned();

  FaceStore store_;
  TriangulationArrays seam_;
  std::vector<SeamSite> sites_;
  std::vector<SeamEdge> edges_;     // sorted by b, then a
  std::vector<Index> edges_begin_;  // by b
  std::vector<bool> is_inside_;
  std::vector<Index> owned_;
  std::vector<Index> owned_begin_;
  bool fits_ = true;
};

}  // namespace rondel::bulk
