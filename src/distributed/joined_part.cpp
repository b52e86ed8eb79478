// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/joined_part.h"

#include <algorithm>
#include <map>
#include <utility>

namespace rondel::distributed {
namespace {

// Returns the rank in whose interval i lies; begin[r] is the first index of rank r.
std::size_t rank_of(Index i, std::span<const Index> begin) {
  return static_cast<std::size_t>(std::ranges::upper_bound(begin, i) - begin.begin()) - 1;
}

// Sorts the values and removes repetitions.
void sort_once(std::vector<Index>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

// An interval of indices, which are a rank's own, and some others, renumbered in increasing order.
class Renumbered {
 public:
  Renumbered() = default;
  Renumbered(Index begin, Index end, std::vector<Index> others)
      : begin_(begin), end_(end), others_(std::move(others)) {
    sort_once(others_);
    num_before_ = static_cast<Index>(std::ranges::lower_bound(others_, begin) - others_.begin());
  }

  [[nodiscard]] Index size() const { return static_cast<Index>(others_.size()) + (end_ - begin_); }
  [[nodiscard]] Index first() const { return num_before_; }  // the first one of the interval
  // Return the other indices below and above the interval.
  [[nodiscard]] std::span<const Index> before() const {
    return std::span(others_).first(num_before_);
  }
  [[nodiscard]] std::span<const Index> behind() const {
    return std::span(others_).subspan(num_before_);
  }

  // Precondition: i is in the interval or one of the others.
  [[nodiscard]] Index operator()(Index i) const {
    if (i >= begin_ && i < end_) return num_before_ + (i - begin_);
    const auto place = static_cast<Index>(std::ranges::lower_bound(others_, i) - others_.begin());
    return i < begin_ ? place : place + (end_ - begin_);
  }

 private:
  Index begin_ = 0;
  Index end_ = 0;
  std::vector<Index> others_;
  Index num_before_ = 0;
};

// The part of one rank, without the numbers that ranks tell each other.
class PartOfRank {
 public:
  PartOfRank(const bulk::JoinedFaces& joined, const OpenRanges& ranges, std::size_t rank,
             std::span<const Index> listed, std::span<const Point> points)
      : joined_(joined),
        listed_(listed),
        points_(points),
        sites_begin_(ranges.sites[rank]),
        sites_end_(ranges.sites[rank + 1]),
        edges_begin_(ranges.edges[rank]),
        edges_end_(ranges.edges[rank + 1]) {
    std::vector<Index> other_sites;
    std::vector<Index> other_edges;
    std::vector<Index> other_faces;
    for (const Index f : listed) {
      for (const Index v : joined_.faces[f]) {
        if (!is_own_site(v)) other_sites.push_back(v);
      }
      for (const Index n : joined_.neighbors[f]) {
        if (is_edge(n)) {
          if (!is_own_edge(n)) other_edges.push_back(n);
        } else if (!std::ranges::binary_search(listed, face_of(n))) {
          other_faces.push_back(face_of(n));
        }
      }
    }
    sites_ = Renumbered(sites_begin_, sites_end_, std::move(other_sites));
    edges_ = Renumbered(edges_begin_, edges_end_, std::move(other_edges));
    other_faces_ = Renumbered(0, 0, std::move(other_faces));
    find_asked();
  }

  // Appends the part to a message, in the order in which read_joined_part() reads it.
  void write(std::span<const std::uint64_t> indices, MessageWriter& writer) const {
    writer.add_value(sites_.first());
    writer.add_value(edges_.first());
    writer.add_value(edges_.size());
    writer.add_value(static_cast<Index>(listed_.size()) + other_faces_.size());
    write_faces(writer);
    std::vector<Index> across;
    for (Index e = edges_begin_; e < edges_end_; ++e) across.push_back(face(joined_.across[e]));
    writer.add(across);
    for (const auto& others : {sites_.before(), sites_.behind()}) {
      std::vector<std::uint64_t> of_others;
      for (const Index s : others) of_others.push_back(indices[s]);
      writer.add(of_others);
    }
    for (const auto& others : {sites_.before(), sites_.behind()}) {
      std::vector<Point> of_others;
      for (const Index s : others) {
        if (has_points()) of_others.push_back(points_[s]);
      }
      writer.add(of_others);
    }
  }

  // Return the faces and edges whose numbers the rank needs and does not know.
  [[nodiscard]] std::span<const Index> asked_faces() const { return asked_faces_; }
  [[nodiscard]] std::span<const Index> asked_edges() const { return asked_edges_; }

  // Returns the number of a face in the part.
  [[nodiscard]] Index face(Index f) const {
    const auto found = std::ranges::lower_bound(listed_, f);
    if (found != listed_.end() && *found == f) return static_cast<Index>(found - listed_.begin());
    return static_cast<Index>(listed_.size()) + other_faces_(f);
  }
  [[nodiscard]] Index edge(Index e) const { return edges_(e); }

 private:
  [[nodiscard]] bool has_points() const { return !points_.empty(); }
  [[nodiscard]] bool is_edge(Index neighbor) const { return neighbor < joined_.num_edges; }
  [[nodiscard]] Index face_of(Index neighbor) const { return neighbor - joined_.num_edges; }
  [[nodiscard]] bool is_own_site(Index s) const { return s >= sites_begin_ && s < sites_end_; }
  [[nodiscard]] bool is_own_edge(Index e) const { return e >= edges_begin_ && e < edges_end_; }
  [[nodiscard]] bool is_own_face(Index f) const { return is_own_site(joined_.faces[f][0]); }

  // Finds the faces and edges whose numbers the rank has to ask for.
  void find_asked() {
    for (const Index f : listed_) {
      if (!is_own_face(f)) {
        if (has_points()) asked_faces_.push_back(f);
        continue;
      }
      for (const Index n : joined_.neighbors[f]) {
        if (is_edge(n)) {
          if (!is_own_edge(n)) asked_edges_.push_back(n);
        } else if (!is_own_face(face_of(n))) {
          asked_faces_.push_back(face_of(n));
        }
      }
    }
    for (Index e = edges_begin_; e < edges_end_; ++e) {
      if (!is_own_face(joined_.across[e])) asked_faces_.push_back(joined_.across[e]);
    }
    sort_once(asked_faces_);
    sort_once(asked_edges_);
  }

  // Writes the faces of the part, renumbered.
  void write_faces(MessageWriter& writer) const {
    std::vector<Triple> corners;
    std::vector<Triple> neighbors;
    std::vector<Index> ghost_faces;
    std::vector<Index> owned_begin(sites_.size() + 1, 0);
    corners.reserve(listed_.size());
    neighbors.reserve(listed_.size());
    const auto across = [&](Index n) {
      return is_edge(n) ? edges_(n) : edges_.size() + face(face_of(n));
    };
    for (const Index f : listed_) {
      const Triple& v = joined_.faces[f];
      const Triple& n = joined_.neighbors[f];
      corners.push_back({sites_(v[0]), sites_(v[1]), sites_(v[2])});
      neighbors.push_back({across(n[0]), across(n[1]), across(n[2])});
      ++owned_begin[corners.back()[0] + 1];
      if (is_own_face(f) && std::ranges::binary_search(joined_.ghost_faces, f))
        ghost_faces.push_back(face(f));
    }
    for (std::size_t s = 1; s < owned_begin.size(); ++s) owned_begin[s] += owned_begin[s - 1];
    writer.add(corners);
    writer.add(neighbors);
    writer.add(owned_begin);
    writer.add(ghost_faces);
  }

  const bulk::JoinedFaces& joined_;
  std::span<const Index> listed_;  // faces at the rank's sites, increasing
  std::span<const Point> points_;  // by open site, or empty
  Index sites_begin_;
  Index sites_end_;
  Index edges_begin_;
  Index edges_end_;
  Renumbered sites_;
  Renumbered edges_;
  Renumbered other_faces_;
  std::vector<Index> asked_faces_;
  std::vector<Index> asked_edges_;
};

// Returns for each rank the faces that have a corner there, in increasing order.
std::vector<std::vector<Index>> list_faces(const bulk::JoinedFaces& joined,
                                           const OpenRanges& ranges) {
  std::vector<std::vector<Index>> listed(ranges.num_ranks());
  for (Index f = 0; f < joined.faces.size(); ++f) {
    for (const Index corner : joined.faces[f]) {
      std::vector<Index>& list = listed[rank_of(corner, ranges.sites)];
      if (list.empty() || list.back() != f) list.push_back(f);
    }
  }
  return listed;
}

// Reads the values of a part's sites before the rank's own ones, takes those of its own, and reads
// the rest.
template <class T>
std::vector<T> read_around(MessageReader& reader, std::span<const T> own) {
  std::vector<T> all = reader.values<T>();
  all.insert(all.end(), own.begin(), own.end());
  const auto behind = reader.values<T>();
  all.insert(all.end(), behind.begin(), behind.end());
  return all;
}

using NumberLists = std::map<std::size_t, NumberList>;  // by the other rank

// Writes the lists of numbers that ranks tell each other.
void write_lists(const NumberLists& lists, MessageWriter& writer) {
  writer.add_value<std::uint64_t>(lists.size());
  for (const auto& [rank, list] : lists) {
    writer.add_value<std::uint64_t>(rank);
    writer.add(list.faces);
    writer.add(list.edges);
  }
}

std::vector<NumberList> read_lists(MessageReader& reader) {
  std::vector<NumberList> lists(reader.value<std::uint64_t>());
  for (NumberList& list : lists) {
    list.rank = reader.value<std::uint64_t>();
    list.faces = reader.values<Index>();
    list.edges = reader.values<Index>();
  }
  return lists;
}

}  // namespace

void write_joined_parts(const bulk::JoinedFaces& joined, const OpenRanges& ranges,
                        std::span<const std::uint64_t> indices, std::span<const Point> points,
                        std::span<MessageWriter> messages) {
  const auto listed = list_faces(joined, ranges);
  const std::size_t num_ranks = ranges.num_ranks();
  std::vector<NumberLists> told(num_ranks);
  for (std::size_t rank = 0; rank < num_ranks; ++rank) {
    const PartOfRank part(joined, ranges, rank, listed[rank], points);
    part.write(indices, messages[rank]);
    NumberLists asked;
    for (const Index f : part.asked_faces()) {
      const std::size_t other = rank_of(joined.faces[f][0], ranges.sites);
      asked[other].faces.push_back(part.face(f));
      const auto place = std::ranges::lower_bound(listed[other], f) - listed[other].begin();
      told[other][rank].faces.push_back(static_cast<Index>(place));
    }
    for (const Index e : part.asked_edges()) {
      const std::size_t other = rank_of(e, ranges.edges);
      asked[other].edges.push_back(part.edge(e));
      told[other][rank].edges.push_back(e - ranges.edges[other]);
    }
    write_lists(asked, messages[rank]);
  }
  for (std::size_t rank = 0; rank < num_ranks; ++rank) write_lists(told[rank], messages[rank]);
}

JoinedPart read_joined_part(MessageReader& reader, std::span<const std::uint64_t> own_indices,
                            std::span<const Point> own_points) {
  JoinedPart part;
  part.first_site = reader.value<Index>();
  part.first_edge = reader.value<Index>();
  part.faces.num_edges = reader.value<Index>();
  part.num_faces = reader.value<Index>();
  part.faces.faces = reader.values<Triple>();
  part.faces.neighbors = reader.values<Triple>();
  part.faces.owned_begin = reader.values<Index>();
  part.faces.ghost_faces = reader.values<Index>();
  // Only the rank's own open edges have a value here; no other edges are asked for.
  const std::vector<Index> across = reader.values<Index>();
  part.faces.across.assign(part.faces.num_edges, no_index);
  std::ranges::copy(across, part.faces.across.begin() + part.first_edge);
  part.site_indices = read_around(reader, own_indices);
  part.site_points = read_around(reader, own_points);
  part.asked = read_lists(reader);
  part.told = read_lists(reader);
  for (NumberList& list : part.told) {
    for (Index& e : list.edges) e += part.first_edge;
  }
  return part;
}

}  // namespace rondel::distributed
