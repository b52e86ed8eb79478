// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces that the sites of a bucket own, in canonical order: its own, and those between buckets.
//
// in    the border of a bucket, the faces between buckets, and where the bucket stands among all
// out   faces one by one, numbered through all buckets; and the numbers that other buckets need
// index codes: a face of the bucket, or behind those an open edge while it is not known what is
//       across, or a face between buckets; 64 bits for what is counted through all buckets
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bulk/bucket.h"

namespace rondel::distributed {

using GlobalIndex = std::uint64_t;

// A corner: a site of the bucket by its rank, or an open site of another one.
struct BucketCorner {
  bool is_own;
  Index index;
};

// The face across an edge: the number of a face of the same bucket; or a face between buckets, or
// an open edge with a face on its left, whose numbers are known when all buckets are done.
struct BucketNeighbor {
  enum class Across : std::uint8_t { number, joined, edge };
  Across across;
  GlobalIndex index;
};

// The numbers of faces that more than one bucket asks for. All are known when each bucket has
// numbered its faces.
struct JoinedNumbers {
  explicit JoinedNumbers(const bulk::JoinedFaces& joined)
      : faces(joined.faces.size()), at_edge(joined.num_edges) {}

  [[nodiscard]] GlobalIndex operator[](const BucketNeighbor& neighbor) const {
    if (neighbor.across == BucketNeighbor::Across::number) return neighbor.index;
    return (neighbor.across == BucketNeighbor::Across::joined ? faces : at_edge)[neighbor.index];
  }

  std::vector<GlobalIndex> faces;    // between buckets
  std::vector<GlobalIndex> at_edge;  // on the left of each open edge
};

class BucketFaces {
 public:
  // The bucket's open sites and open edges are counted from these on. `border` must stay, as must
  // `joined`.
  BucketFaces(const bulk::BucketBorder& border, const bulk::JoinedFaces& joined,
              Index first_open_site, Index first_open_edge);

  [[nodiscard]] GlobalIndex size() const { return size_; }

  // Numbers the faces `first`, `first` + 1, ..., and tells the numbers that others ask for.
  void number(GlobalIndex first, JoinedNumbers& numbers);

  [[nodiscard]] GlobalIndex first() const { return first_; }
  // Returns the places of the bucket's own faces, counted from the first number on.
  [[nodiscard]] LargeVector<Index> places_of_own() const;

  // visit(corners) for each face in the order of the numbers. `faces` are the bucket's.
  template <class Visit>
  void for_each_face(std::span<const Triple> faces, Visit visit) const {
    for (const CodeRun& run : runs_) {
      if (is_own(run.begin)) {
        for (Index f = run.begin; f < run.end; ++f) visit(corners_of_own(faces[f]));
      } else {
        visit(corners_of_joined(joined_of(run.begin)));
      }
    }
  }

  // visit(neighbors) for each face in the order of the numbers. `neighbors` are the bucket's.
  template <class Visit>
  void for_each_neighbors(std::span<const Triple> neighbors, Visit visit) const {
    const LargeVector<Index> place_of = places_of_own();
    for (const CodeRun& run : runs_) {
      if (is_own(run.begin)) {
        for (Index f = run.begin; f < run.end; ++f) visit(neighbors_of_own(neighbors[f], place_of));
      } else {
        visit(neighbors_of_joined(joined_of(run.begin)));
      }
    }
  }

 private:
  // Codes begin ... end-1, which follow each other in the result; a face between buckets is a run
  // of its own.
  struct CodeRun {
    Index begin;
    Index end;
  };
  using Corners = std::array<BucketCorner, 3>;
  using Neighbors = std::array<BucketNeighbor, 3>;

  [[nodiscard]] Index num_own() const { return border_.num_faces; }
  [[nodiscard]] bool is_own(Index code) const { return code < num_own(); }
  [[nodiscard]] Index joined_of(Index code) const { return code - num_own() - num_edges_; }
  [[nodiscard]] Index code_of_joined(Index face) const { return num_own() + num_edges_ + face; }
  [[nodiscard]] bool is_own_site(Index open_site) const {
    return open_site - first_site_ < border_.open_sites.size();
  }
  // Returns the position in the rim of a face at an open site.
  [[nodiscard]] std::size_t rim_place(Index own_face) const;

  [[nodiscard]] BucketCorner corner_of_joined(Index open_site) const {
    if (!is_own_site(open_site)) return {false, open_site};
    return {true, border_.open_sites[open_site - first_site_].rank};
  }
  [[nodiscard]] static Corners corners_of_own(const Triple& v) {
    return {{{true, v[0]}, {true, v[1]}, {true, v[2]}}};
  }
  [[nodiscard]] Corners corners_of_joined(Index face) const {
    const Triple& v = joined_.faces[face];
    return {{corner_of_joined(v[0]), corner_of_joined(v[1]), corner_of_joined(v[2])}};
  }
  [[nodiscard]] Neighbors neighbors_of_own(const Triple& n, std::span<const Index> place_of) const;
  [[nodiscard]] Neighbors neighbors_of_joined(Index face) const;
  // Returns a corner of a face at an open site.
  [[nodiscard]] BucketCorner corner(Index code, unsigned i) const;
  [[nodiscard]] Index across(Index code, unsigned i) const;
  // In the order of all ranks of all buckets.
  [[nodiscard]] GlobalIndex place(const BucketCorner& corner) const;
  void append(Index begin, Index end);
  void append_open(Index open_site);

  const bulk::BucketBorder& border_;
  const bulk::JoinedFaces& joined_;
  Index first_site_;
  Index first_edge_;
  Index num_edges_;  // open edges of this bucket
  GlobalIndex size_ = 0;
  GlobalIndex first_ = 0;
  GlobalIndex next_ = 0;
  std::vector<CodeRun> runs_;
  std::vector<Index> rim_places_;  // of the faces in the rim, counted from first_ on
  std::vector<Index> ring_;
};

}  // namespace rondel::distributed
