// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Canonical order: faces are listed by the site that is first among their corners. Sites that are
// not open own faces of the bucket alone, which are in this order already and form long runs;
// around each open site faces of both kinds are merged into one turn.

#include "distributed/bucket_faces.h"

#include <algorithm>
#include <numeric>

#include "topology/canonical_order.h"
#include "topology/mesh.h"

namespace rondel::distributed {

using topology::next_corner;

BucketFaces::BucketFaces(const bulk::BucketBorder& border, const bulk::JoinedFaces& joined,
                         Index first_open_site, Index first_open_edge)
    : border_(border),
      joined_(joined),
      first_site_(first_open_site),
      first_edge_(first_open_edge),
      num_edges_(static_cast<Index>(border.open_edges.size())) {
  const std::size_t end = first_site_ + border.open_sites.size();
  size_ = border.num_faces + joined.owned_begin[end] - joined.owned_begin[first_site_];
}

void BucketFaces::number(GlobalIndex first, JoinedNumbers& numbers) {
  first_ = next_ = first;
  runs_.clear();
  rim_places_.resize(border_.rim.size());
  Index face = 0;
  for (Index s = 0; s < border_.open_sites.size(); ++s) {
    append(face, border_.open_sites[s].faces_begin);
    append_open(s);
    face = border_.open_sites[s].faces_end;
  }
  append(face, num_own());
  for (Index i = 0; i < num_edges_; ++i) {
    const std::size_t place = rim_place(border_.open_edges[i].face);
    numbers.at_edge[first_edge_ + i] = first_ + rim_places_[place];
  }
  GlobalIndex number = first_;
  for (const CodeRun& run : runs_) {
    if (!is_own(run.begin)) numbers.faces[joined_of(run.begin)] = number;
    number += run.end - run.begin;
  }
}

// Appends faces of the bucket to the runs, and notes the places of those in the rim.
void BucketFaces::append(Index begin, Index end) {
  if (begin == end) return;
  const auto place = static_cast<Index>(next_ - first_);
  for (std::size_t i = rim_place(begin); i < border_.rim.size() && border_.rim[i] < end; ++i)
    rim_places_[i] = place + (border_.rim[i] - begin);
  next_ += end - begin;
  if (!runs_.empty() && runs_.back().end == begin && is_own(runs_.back().begin)) {
    runs_.back().end = end;
  } else {
    runs_.push_back({begin, end});
  }
}

LargeVector<Index> BucketFaces::places_of_own() const {
  LargeVector<Index> places(num_own());
  Index place = 0;
  for (const CodeRun& run : runs_) {
    if (is_own(run.begin)) {
      std::iota(places.begin() + run.begin, places.begin() + run.end, place);
    }
    place += run.end - run.begin;
  }
  return places;
}

// Appends the faces that an open site owns, those of the bucket and those between buckets,
// counterclockwise around it, from the one that the canonical order puts first.
void BucketFaces::append_open(Index open_site) {
  const bulk::SeamSite& site = border_.open_sites[open_site];
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

std::size_t BucketFaces::rim_place(Index own_face) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(border_.rim, own_face) -
                                  border_.rim.begin());
}

BucketFaces::Neighbors BucketFaces::neighbors_of_own(const Triple& n,
                                                     std::span<const Index> place_of) const {
  using Across = BucketNeighbor::Across;
  Neighbors neighbors{};
  for (unsigned i = 0; i < 3; ++i) {
    if (is_own(n[i])) {
      neighbors[i] = {Across::number, first_ + place_of[n[i]]};
    } else {
      neighbors[i] = {Across::joined, joined_.across[first_edge_ + (n[i] - num_own())]};
    }
  }
  return neighbors;
}

BucketFaces::Neighbors BucketFaces::neighbors_of_joined(Index face) const {
  using Across = BucketNeighbor::Across;
  Neighbors neighbors{};
  for (unsigned i = 0; i < 3; ++i) {
    const Index n = joined_.neighbors[face][i];
    if (n < joined_.num_edges) {
      neighbors[i] = {Across::edge, n};
    } else {
      neighbors[i] = {Across::joined, n - joined_.num_edges};
    }
  }
  return neighbors;
}

BucketCorner BucketFaces::corner(Index code, unsigned i) const {
  if (is_own(code)) return {true, border_.rim_corners[rim_place(code)][i]};
  return corner_of_joined(joined_.faces[joined_of(code)][i]);
}

Index BucketFaces::across(Index code, unsigned i) const {
  if (is_own(code)) {
    const Index n = border_.rim_neighbors[rim_place(code)][i];
    return is_own(n) ? n : code_of_joined(joined_.across[first_edge_ + (n - num_own())]);
  }
  const Index n = joined_.neighbors[joined_of(code)][i];
  if (n < joined_.num_edges) return border_.open_edges[n - first_edge_].face;
  return code_of_joined(n - joined_.num_edges);
}

GlobalIndex BucketFaces::place(const BucketCorner& corner) const {
  constexpr GlobalIndex own = GlobalIndex{1} << 32;  // behind all open sites of earlier buckets
  if (corner.is_own) return own + corner.index;
  return corner.index < first_site_ ? corner.index : 2 * own + corner.index;
}

}  // namespace rondel::distributed
