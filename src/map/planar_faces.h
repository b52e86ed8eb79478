// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces into which lines divide the plane, and which region each is given to.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "map/snap_rounding.h"

namespace rondel::map {

inline constexpr std::size_t no_region = std::numeric_limits<std::size_t>::max();

// A face belongs to the region whose sides go around it most often, once at least; of several to the first one. A region
// that has none then, as the lines of its opposite sides have passed each other or those of its neighbors, gets those around
// which its sides go in either direction; but of no other region the last one.
//
// The halfedge 2 i leads along line i, 2 i + 1 back. A face is to the left of its halfedges.
class PlanarFaces {
 public:
  // Keeps a reference. Precondition: the lines are snap_rounded().
  explicit PlanarFaces(std::span<const NodedLine> lines);

  // The region of the face to the left of a halfedge, or no_region.
  [[nodiscard]] std::size_t region_at(std::size_t halfedge) const {
    return regions_[faces_[halfedge]];
  }

 private:
  using Counts = std::vector<NodedLine::RegionCount>;  // by region, none of them 0

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
  std::vector<std::size_t> order_;   // halfedges by start, and counterclockwise around it
  std::vector<std::size_t> next_;    // of a halfedge along its face
  std::vector<std::size_t> faces_;   // of halfedges
  std::vector<std::size_t> firsts_;  // a halfedge of each face
  std::vector<Counts> counts_;       // of faces: how often the sides of regions go around them
  std::vector<bool> is_counted_;
  std::vector<std::size_t> regions_;             // of faces
  std::vector<std::vector<std::size_t>> lists_;  // lines that are not upright, by longitude
};

}  // namespace rondel::map
