// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Buckets that are triangulated, in files: what their faces are, and apart from that, as it is read more
// often, what they left open.
//
// in    one bucket after the other
// out   their faces, borders and duplicates, again and again
// index ranks and faces of a bucket; rows of the input
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bulk/bucket.h"
#include "bulk/bucket_cuts.h"
#include "distributed/packed_words.h"
#include "distributed/scratch_file.h"

namespace rondel::distributed {

// Rows of the input.
struct DuplicateRow {
  std::uint64_t row;
  std::uint64_t representative;
};
struct AreaRow {
  std::uint64_t row;
  double area;
};

// What of the buckets is kept, for the results that are wanted.
struct StoreParts {
  bool has_neighbors = false;
  bool has_points = false;
};

// Of v vertices there are less than 2v faces, and a duplicate takes less than a vertex.
constexpr std::uint64_t bytes_of_stored_site(StoreParts parts) {
  return sizeof(std::uint64_t) + (parts.has_neighbors ? 4 : 2) * sizeof(Triple) +
         (parts.has_points ? sizeof(Point) : 0);
}

// Where a bucket is, and how large: what the journal says of it.
struct StoredBucket {
  std::uint64_t num_vertices = 0;  // and hidden sites
  std::uint64_t num_faces = 0;
  std::uint64_t num_duplicates = 0;
  std::uint64_t num_hidden = 0;  // that are hidden whatever others have
  std::uint64_t checksum = 0;    // of all but the duplicates
  std::uint64_t duplicates_checksum = 0;
  std::uint64_t border_place = 0;
  std::uint64_t border_words = 0;
  std::uint64_t border_checksum = 0;
};

// What the buckets between which there are faces must know of each other.
struct StoredBorder {
  bulk::BucketBorder border;
  std::vector<Point> points;        // of the open sites, those that speak for their places
  std::vector<Point> named_points;  // of their rows, if points are stored
  std::vector<std::uint64_t> rows;  // theirs
};

class BucketStore {
 public:
  // In these two files, which are made if they are not there.
  BucketStore(const std::string& faces, const std::string& borders,
              std::span<const bulk::BucketCut> cuts, StoreParts parts);

  // Adds to the duplicates of a bucket, which is not written yet.
  void add_duplicates(std::size_t i, StoredBucket& stored,
                      std::span<const DuplicateRow> duplicates);
  // Of its ranks are the rows and, if they are kept, the points. The bucket's border has been taken.
  void write(std::size_t i, const bulk::Bucket& bucket, std::span<const std::uint64_t> vertex_rows,
             std::span<const Point> points, const StoredBorder& border, StoredBucket& stored);
  // Whether the files have what was written.
  [[nodiscard]] bool has(std::size_t i, const StoredBucket& stored) const;

  [[nodiscard]] std::vector<std::uint64_t> vertex_rows(std::size_t i,
                                                       const StoredBucket& stored) const;
  [[nodiscard]] LargeVector<Triple> faces(std::size_t i, const StoredBucket& stored) const;
  [[nodiscard]] LargeVector<Triple> neighbors(std::size_t i, const StoredBucket& stored) const;
  [[nodiscard]] LargeVector<Point> points(std::size_t i, const StoredBucket& stored) const;
  // Some of the duplicates, which are in increasing order of site.
  void read_duplicates(std::size_t i, std::uint64_t first,
                       std::span<DuplicateRow> duplicates) const;
  [[nodiscard]] std::uint64_t num_open_sites(const StoredBucket& stored) const;
  [[nodiscard]] StoredBorder border(const StoredBucket& stored) const;
  // The same without the rim.
  [[nodiscard]] StoredBorder outline(const StoredBucket& stored) const;

 private:
  [[nodiscard]] std::uint64_t site_bytes() const { return bytes_of_stored_site(parts_); }
  // One after the other: duplicates, rows of vertices, faces, neighbors, points.
  [[nodiscard]] std::uint64_t duplicates_at(std::size_t i) const {
    return site_bytes() * first_site_[i];
  }
  [[nodiscard]] std::uint64_t rows_at(std::size_t i, const StoredBucket& stored) const {
    return duplicates_at(i) + sizeof(DuplicateRow) * stored.num_duplicates;
  }
  [[nodiscard]] std::uint64_t faces_at(std::size_t i, const StoredBucket& stored) const {
    return rows_at(i, stored) + sizeof(std::uint64_t) * stored.num_vertices;
  }
  [[nodiscard]] std::uint64_t neighbors_at(std::size_t i, const StoredBucket& stored) const {
    return faces_at(i, stored) + sizeof(Triple) * stored.num_faces;
  }
  [[nodiscard]] std::uint64_t points_at(std::size_t i, const StoredBucket& stored) const {
    return neighbors_at(i, stored) + (parts_.has_neighbors ? sizeof(Triple) * stored.num_faces : 0);
  }
  [[nodiscard]] std::uint64_t duplicates_sum(std::size_t i, const StoredBucket& stored) const;
  [[nodiscard]] Words border_words(const StoredBucket& stored) const;

  ScratchFile faces_;
  ScratchFile borders_;
  std::uint64_t borders_end_ = 0;
  std::vector<std::uint64_t> first_site_;
  StoreParts parts_;
};

}  // namespace rondel::distributed
