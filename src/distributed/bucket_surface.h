// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// All faces at the sites of a bucket, its own and those between buckets, as one surface with a
// border.
//
// in    a bucket and the faces between buckets
// out   corners and neighbors
// index codes: a face of the bucket, or behind those and the open edges a face between buckets
#pragma once

#include <span>
#include <vector>

#include "distributed/bucket_faces.h"
#include "topology/mesh.h"

namespace rondel::distributed {

class BucketSurface {
 public:
  // The bucket's open sites and open edges are counted from these on.
  BucketSurface(std::span<const Triple> faces, std::span<const Triple> neighbors,
                const bulk::BucketBorder& border, const bulk::JoinedFaces& joined,
                Index first_open_site, Index first_open_edge)
      : faces_(faces),
        neighbors_(neighbors),
        border_(border),
        joined_(joined),
        first_site_(first_open_site),
        first_edge_(first_open_edge),
        first_joined_(static_cast<Index>(faces.size() + border.open_edges.size())) {}

  [[nodiscard]] bool is_own(Index code) const { return code < faces_.size(); }
  [[nodiscard]] Index code_of_joined(Index face) const { return first_joined_ + face; }
  [[nodiscard]] Index joined_of(Index code) const { return code - first_joined_; }

  [[nodiscard]] BucketCorner corner(Index code, unsigned i) const {
    if (is_own(code)) return {true, faces_[code][i]};
    const Index s = joined_.faces[joined_of(code)][i];
    if (s - first_site_ >= border_.open_sites.size()) return {false, s};
    return {true, border_.open_sites[s - first_site_].rank};
  }

  // Or no_index where a face of another bucket is across, which is at no site of this one.
  [[nodiscard]] Index across(Index code, unsigned i) const {
    if (is_own(code)) {
      const Index n = neighbors_[code][i];
      if (is_own(n)) return n;
      return code_of_joined(joined_.across[first_edge_ + (n - static_cast<Index>(faces_.size()))]);
    }
    const Index n = joined_.neighbors[joined_of(code)][i];
    if (n >= joined_.num_edges) return code_of_joined(n - joined_.num_edges);
    if (n - first_edge_ >= border_.open_edges.size()) return no_index;
    return border_.open_edges[n - first_edge_].face;
  }

  // By rank, a face at the site; or no_index, if it is hidden.
  [[nodiscard]] std::vector<Index> faces_at_sites(std::size_t num_sites) const {
    std::vector<Index> result(num_sites, no_index);
    for (Index f = 0; f < faces_.size(); ++f) {
      for (const Index v : faces_[f]) result[v] = f;
    }
    for (Index f = 0; f < joined_.faces.size(); ++f) {
      for (const Index s : joined_.faces[f]) {
        if (s - first_site_ >= border_.open_sites.size()) continue;
        result[border_.open_sites[s - first_site_].rank] = code_of_joined(f);
      }
    }
    return result;
  }

  // visit(code, i) for the faces around a site of the bucket, which is their corner i,
  // counterclockwise from one of them.
  template <class Visit>
  void turn(Index rank, Index start, Visit visit) const {
    Index f = start;
    do {
      unsigned i = 0;
      while (!is_corner(f, i, rank)) ++i;
      visit(f, i);
      f = across(f, topology::next_corner[i]);
    } while (f != start);
  }

 private:
  [[nodiscard]] bool is_corner(Index code, unsigned i, Index rank) const {
    const BucketCorner v = corner(code, i);
    return v.is_own && v.index == rank;
  }

  std::span<const Triple> faces_;
  std::span<const Triple> neighbors_;
  const bulk::BucketBorder& border_;
  const bulk::JoinedFaces& joined_;
  Index first_site_;
  Index first_edge_;
  Index first_joined_;
};

}  // namespace rondel::distributed
