// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the faces into which lines divide the plane, and assigns each face to a region.
//
// in    lines that meet only in common ends, with the regions whose sides they are
// out   the region of each face
// index halfedges: 2 i leads along line i, 2 i + 1 leads back; a face is to the left of its
//       halfedges
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "map/snap_rounding.h"

namespace rondel::map {

inline constexpr std::size_t no_region = std::numeric_limits<std::size_t>::max();

// A face belongs to the region whose sides go around it most often and at least once; to the first
// one of several. A region can get no face in this way, if the lines of its opposite sides have
// passed each other or those of its neighbors. It then gets the faces around which its sides go in
// either direction, except the last face of another region.
class PlanarFaces {
 public:
  // Keeps a reference to the lines. Precondition: they are the result of snap_rounded().
  explicit PlanarFaces(std::span<const NodedLine> lines);

  // Returns the region of the face to the left of a halfedge, or no_region.
  [[nodiscard]] std::size_t region_at(std::size_t halfedge) const {
    return regions_[faces_[halfedge]];
  }

 private:
  // One count for each region, in ascending order; no count is 0.
  using Counts = std::vector<NodedLine::RegionCount>;

  [[nodiscard]] const LonLat& start_of(std::size_t halfedge) const;
  [[nodiscard]] const LonLat& end_of(std::size_t halfedge) const { return start_of(halfedge ^ 1U); }
  void sort_around_positions();
  void find_faces();
  void count_all();
  void count_from(std::size_t face, Counts counts);
  void give_to_lost();
  [[nodiscard]] Counts counts_below(const LonLat& position) const;
  [[nodiscard]] std::size_t outer_halfedge(std::size_t first, std::size_t past) const;
  void list_by_longitude();
  [[nodiscard]] std::size_t list_at(double lon_deg) const;

  std::span<const NodedLine> lines_;
  // Halfedges, sorted by start and then counterclockwise around it.
  std::vector<std::size_t> order_;
  std::vector<std::size_t> next_;    // the next halfedge along the face of each
  std::vector<std::size_t> faces_;   // the face of each halfedge
  std::vector<std::size_t> firsts_;  // one halfedge of each face
  std::vector<Counts> counts_;  // for each face, how often the sides of each region go around it
  std::vector<bool> is_counted_;
  std::vector<std::size_t> regions_;  // the region of each face
  // Lines that are not meridians, sorted into lists by longitude.
  std::vector<std::vector<std::size_t>> lists_;
};

}  // namespace rondel::map
