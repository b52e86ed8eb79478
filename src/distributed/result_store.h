// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Stores triangulated buckets in files: their faces in one, and in another their borders, which are
// read more often.
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
#include "distributed/bucket_cuts.h"
#include "distributed/packed_words.h"
#include "distributed/scratch_file.h"

namespace rondel::distributed {

// A duplicate site and the site that represents its place, as rows of the input.
struct DuplicateRow {
  std::uint64_t row;
  std::uint64_t representative;
};
// The area of a site, by its row of the input.
struct AreaRow {
  std::uint64_t row;
  double area;
};

// The parts of the buckets that are stored, as the wanted results need.
struct StoreParts {
  bool has_neighbors = false;
  bool has_points = false;
};

// An upper bound: v vertices have fewer than 2v faces, and a duplicate takes less than a vertex.
constexpr std::uint64_t bytes_of_stored_site(StoreParts parts) {
  return sizeof(std::uint64_t) + (parts.has_neighbors ? 4 : 2) * sizeof(Triple) +
         (parts.has_points ? sizeof(Point) : 0);
}

// The place and the sizes of a stored bucket. The journal records it.
struct StoredBucket {
  std::uint64_t num_vertices = 0;  // with the hidden sites
  std::uint64_t num_faces = 0;
  std::uint64_t num_duplicates = 0;
  std::uint64_t num_hidden = 0;  // hidden whatever other buckets contain
  std::uint64_t checksum = 0;    // of everything but the duplicates
  std::uint64_t duplicates_checksum = 0;
  std::uint64_t border_place = 0;
  std::uint64_t border_words = 0;
  std::uint64_t border_checksum = 0;
};

// The data of a bucket that other buckets need to compute the faces between them.
struct StoredBorder {
  bulk::BucketBorder border;
  std::vector<Point> points;        // by open site: the point that represents its place
  std::vector<Point> named_points;  // by open site: the point of its row, if points are stored
  std::vector<std::uint64_t> rows;  // by open site
};

class ResultStore {
 public:
  // Opens or creates the two files. `cuts` are the buckets.
  ResultStore(const std::string& faces, const std::string& borders, std::span<const BucketCut> cuts,
              StoreParts parts);

  // Adds to the duplicates of bucket i, which has not been written yet.
  void add_duplicates(std::size_t i, StoredBucket& stored,
                      std::span<const DuplicateRow> duplicates);
  // Writes bucket i. `vertex_rows` and, if points are stored, `points` are by rank. The border has
  // been moved out of `bucket`.
  void write(std::size_t i, const bulk::Bucket& bucket, std::span<const std::uint64_t> vertex_rows,
             std::span<const Point> points, const StoredBorder& border, StoredBucket& stored);
  // True if the files contain bucket i as it was written, by its checksums.
  [[nodiscard]] bool has(std::size_t i, const StoredBucket& stored) const;

  [[nodiscard]] std::vector<std::uint64_t> vertex_rows(std::size_t i,
                                                       const StoredBucket& stored) const;
  [[nodiscard]] LargeVector<Triple> faces(std::size_t i, const StoredBucket& stored) const;
  [[nodiscard]] LargeVector<Triple> neighbors(std::size_t i, const StoredBucket& stored) const;
  [[nodiscard]] LargeVector<Point> points(std::size_t i, const StoredBucket& stored) const;
  // Reads some of the duplicates, from `first` on; they are in increasing order of row.
  void read_duplicates(std::size_t i, std::uint64_t first,
                       std::span<DuplicateRow> duplicates) const;
  [[nodiscard]] std::uint64_t num_open_sites(const StoredBucket& stored) const;
  [[nodiscard]] StoredBorder border(const StoredBucket& stored) const;
  // Returns the border without the rim, which takes less memory.
  [[nodiscard]] StoredBorder outline(const StoredBucket& stored) const;

 private:
  [[nodiscard]] std::uint64_t site_bytes() const { return bytes_of_stored_site(parts_); }
  // The parts of a bucket follow each other: duplicates, rows of vertices, faces, neighbors,
  // points.
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
