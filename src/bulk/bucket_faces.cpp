// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/bucket_faces.h"

#include <numeric>

#include "topology/canonical_order.h"
#include "topology/mesh.h"

namespace rondel::bulk {

using topology::next_corner;

BucketFaces::BucketFaces(Bucket& bucket, const JoinedFaces& joined, Index first_open_site,
                         Index first_open_edge)
    : bucket_(bucket),
      joined_(joined),
      first_site_(first_open_site),
      first_edge_(first_open_edge),
      num_edges_(static_cast<Index>(bucket.open_edges.size())) {
  const std::size_t end = first_site_ + bucket.open_sites.size();
  size_ = bucket.faces.size() + joined.owned_begin[end] - joined.owned_begin[first_site_];
  for (Index i = 0; i < num_edges_; ++i) {
    const SeamEdge& edge = bucket.open_edges[i];
    bucket.neighbors[edge.face][edge.corner] = num_own() + i;
  }
}

void BucketFaces::number(GlobalIndex first, JoinedNumbers& numbers) {
  first_ = next_ = first;
  runs_.clear();
  number_of_.resize(bucket_.faces.size());
  Index face = 0;
  for (Index s = 0; s < bucket_.open_sites.size(); ++s) {
    append(face, bucket_.open_sites[s].faces_begin);
    append_open(s);
    face = bucket_.open_sites[s].faces_end;
  }
  append(face, num_own());
  for (Index i = 0; i < num_edges_; ++i)
    numbers.at_edge[first_edge_ + i] = first_ + number_of_[bucket_.open_edges[i].face];
  GlobalIndex number = first_;
  for (const CodeRun& run : runs_) {
    if (!is_own(run.begin)) numbers.faces[joined_of(run.begin)] = number;
    number += run.end - run.begin;
  }
}

// Faces of the bucket.
void BucketFaces::append(Index begin, Index end) {
  if (begin == end) return;
  std::iota(number_of_.begin() + begin, number_of_.begin() + end,
            static_cast<Index>(next_ - first_));
  next_ += end - begin;
  if (!runs_.empty() && runs_.back().end == begin && is_own(runs_.back().begin)) {
    runs_.back().end = end;
  } else {
    runs_.push_back({begin, end});
  }
}

// The faces that an open site owns, of both kinds, counterclockwise around it.
void BucketFaces::append_open(Index open_site) {
  const SeamSite& site = bucket_.open_sites[open_site];
  const Index s = first_site_ + open_site;
  const bool has_joined = joined_.owned_begin[s] != joined_.owned_begin[s + 1];
  if (!has_joined && site.faces_begin == site.faces_end) return;
  const Index start = has_joined ? code_of_joined(joined_.owned_begin[s]) : site.faces_begin;
  ring_.clear();
  Index f = start;
  do {
    unsigned at = 0;
    while (place(corner(f, at)) != place({true, site.rank})) ++at;
    if (at == 0) ring_.push_back(f);
    f = across(f, next_corner[at]);
  } while (f != start);
  topology::start_with_first(ring_, [this](Index code) { return place(corner(code, 1)); });
  for (const Index code : ring_) {
    if (is_own(code)) {
      append(code, code + 1);
    } else {
      runs_.push_back({code, code + 1});
      ++next_;
    }
  }
}

BucketCorner BucketFaces::corner(Index code, unsigned i) const {
  if (is_own(code)) return {true, bucket_.faces[code][i]};
  const Index s = joined_.faces[joined_of(code)][i];
  if (is_own_site(s)) return {true, bucket_.open_sites[s - first_site_].rank};
  return {false, s};
}

BucketNeighbor BucketFaces::neighbor(Index code, unsigned i) const {
  using Across = BucketNeighbor::Across;
  if (is_own(code)) {
    const Index n = bucket_.neighbors[code][i];
    if (is_own(n)) return {Across::number, first_ + number_of_[n]};
    return {Across::joined, joined_.across[first_edge_ + (n - num_own())]};
  }
  const Index n = joined_.neighbors[joined_of(code)][i];
  if (n < joined_.num_edges) return {Across::edge, n};
  return {Across::joined, n - joined_.num_edges};
}

Index BucketFaces::across(Index code, unsigned i) const {
  if (is_own(code)) {
    const Index n = bucket_.neighbors[code][i];
    return is_own(n) ? n : code_of_joined(joined_.across[first_edge_ + (n - num_own())]);
  }
  const Index n = joined_.neighbors[joined_of(code)][i];
  if (n < joined_.num_edges) return bucket_.open_edges[n - first_edge_].face;
  return code_of_joined(n - joined_.num_edges);
}

GlobalIndex BucketFaces::place(const BucketCorner& corner) const {
  constexpr GlobalIndex own = GlobalIndex{1} << 32;  // behind all open sites of earlier buckets
  if (corner.is_own) return own + corner.index;
  return corner.index < first_site_ ? corner.index : 2 * own + corner.index;
}

}  // namespace rondel::bulk
