// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces that the sites of a bucket own, in canonical order: its own, and those between buckets.
//
// in    a bucket, the faces between buckets, and where the bucket stands among all
// out   faces one by one, numbered through all buckets; and the numbers that other buckets need
// index codes: a face of the bucket, or behind those an open edge while it is not known what is across,
//       or a face between buckets; 64 bits for what is counted through all buckets
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bulk/bucket.h"

namespace rondel::bulk {

using GlobalIndex = std::uint64_t;

// A corner: a site of the bucket by its rank, or an open site of another one.
struct BucketCorner {
  bool is_own;
  Index index;
};

// Across an edge: the number of a face of the same bucket; or a face between buckets, or an open edge
// with a face on its left, whose numbers are known when all buckets are done.
struct BucketNeighbor {
  enum class Across : std::uint8_t { number, joined, edge };
  Across across;
  GlobalIndex index;
};

// The numbers of faces that more than one bucket asks for.
struct JoinedNumbers {
  explicit JoinedNumbers(const JoinedFaces& joined)
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
  // The bucket's open sites and open edges are counted from these on. Its neighbors across open
  // edges are replaced by codes; it must stay, as must `joined`.
  BucketFaces(Bucket& bucket, const JoinedFaces& joined, Index first_open_site,
              Index first_open_edge);

  [[nodiscard]] GlobalIndex size() const { return size_; }

  // Numbers the faces `first`, `first` + 1, ..., and tells the numbers that others ask for.
  void number(GlobalIndex first, JoinedNumbers& numbers);

  // visit(corners, neighbors) for each face in the order of the numbers.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const CodeRun& run : runs_) {
      for (Index f = run.begin; f < run.end; ++f) {
        std::array<BucketCorner, 3> corners{};
        std::array<BucketNeighbor, 3> neighbors{};
        for (unsigned i = 0; i < 3; ++i) {
          corners[i] = corner(f, i);
          neighbors[i] = neighbor(f, i);
        }
        visit(corners, neighbors);
      }
    }
  }

 private:
  // Codes begin ... end-1, which follow each other in the result.
  struct CodeRun {
    Index begin;
    Index end;
  };

  [[nodiscard]] Index num_own() const { return static_cast<Index>(bucket_.faces.size()); }
  [[nodiscard]] bool is_own(Index code) const { return code < num_own(); }
  [[nodiscard]] Index joined_of(Index code) const { return code - num_own() - num_edges_; }
  [[nodiscard]] Index code_of_joined(Index face) const { return num_own() + num_edges_ + face; }
  [[nodiscard]] bool is_own_site(Index open_site) const {
    return open_site - first_site_ < bucket_.open_sites.size();
  }

  [[nodiscard]] BucketCorner corner(Index code, unsigned i) const;
  [[nodiscard]] BucketNeighbor neighbor(Index code, unsigned i) const;
  // The code of the face across, around a site of the bucket.
  [[nodiscard]] Index across(Index code, unsigned i) const;
  // In the order of all ranks of all buckets.
  [[nodiscard]] GlobalIndex place(const BucketCorner& corner) const;
  void append(Index begin, Index end);
  void append_open(Index open_site);

  Bucket& bucket_;
  const JoinedFaces& joined_;
  Index first_site_;
  Index first_edge_;
  Index num_edges_;  // open edges of this bucket
  GlobalIndex size_ = 0;
  GlobalIndex first_ = 0;
  GlobalIndex next_ = 0;
  std::vector<CodeRun> runs_;
  LargeVector<Index> number_of_;  // of own faces, from first_ on
  std::vector<Index> ring_;
};

}  // namespace rondel::bulk
