// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites are read piece by piece. Each piece is sorted by bucket in memory, so that each bucket has
// one write of points and one of rows for each piece.

#include "distributed/site_spool.h"

#include <algorithm>

#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::distributed {
// Successive sites, sorted by bucket.
class SiteSpool::ScatteredSites {
 public:
  ScatteredSites(std::size_t max_num_sites, std::size_t num_buckets)
      : sites_(max_num_sites),
        keys_(max_num_sites),
        bucket_of_(max_num_sites),
        points_(max_num_sites),
        rows_(max_num_sites),
        begin_(num_buckets + 1) {}

  void read(const io::NpyRows& rows, std::uint64_t first, std::size_t size,
            std::uint64_t first_number, const system::Job& options,
            std::span<const BucketCut> cuts) {
    const std::span sites = std::span(sites_).first(size);
    rows.read(first, sites, options.threads);
    find_keys(sites, options, keys_);
    system::parallel_for(options.threads, size, std::size_t{1} << 14,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t i = begin; i < end; ++i) {
                             bucket_of_[i] = static_cast<Index>(bucket_of(keys_[i], cuts));
                           }
                         });
    system::RowPlaces<std::size_t> places(begin_.size() - 1);
    for (std::size_t i = 0; i < size; ++i) places.count(bucket_of_[i]);
    places.sum();
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = places.place(bucket_of_[i]);
      points_[place] = sites_[i];
      rows_[place] = first_number + first + i;
    }
    begin_ = std::move(places).offsets();
  }

  [[nodiscard]] std::span<const Point> points(std::size_t bucket) const {
    return std::span(points_).subspan(begin_[bucket], begin_[bucket + 1] - begin_[bucket]);
  }
  [[nodiscard]] std::span<const std::uint64_t> rows(std::size_t bucket) const {
    return std::span(rows_).subspan(begin_[bucket], begin_[bucket + 1] - begin_[bucket]);
  }

 private:
  std::vector<Point> sites_;
  std::vector<std::uint64_t> keys_;
  std::vector<Index> bucket_of_;
  std::vector<Point> points_;
  std::vector<std::uint64_t> rows_;
  std::vector<std::size_t> begin_;
};

SiteSpool::SiteSpool(const std::string& path, std::span<const BucketCut> cuts)
    : file_(path), cuts_(cuts), first_site_(1, 0) {
  for (const BucketCut& cut : cuts) first_site_.push_back(first_site_.back() + cut.num_sites);
}

std::vector<SpoolChecksums> SiteSpool::scatter(const io::NpyRows& rows, const system::Job& options,
                                               const std::vector<bool>& wanted,
                                               std::size_t piece_sites,
                                               std::uint64_t first_number) {
  std::vector<std::uint64_t> filled(cuts_.size(), 0);
  std::vector<Checksum> point_sums(cuts_.size());
  std::vector<Checksum> row_sums(cuts_.size());
  ScatteredSites piece(std::min<std::uint64_t>(piece_sites, rows.num_rows()), cuts_.size());
  for (std::uint64_t first = 0; first < rows.num_rows(); first += piece_sites) {
    system::obey_stop();
    const std::size_t size = std::min<std::uint64_t>(piece_sites, rows.num_rows() - first);
    piece.read(rows, first, size, first_number, options, cuts_);
    for (std::size_t b = 0; b < cuts_.size(); ++b) {
      const auto points = piece.points(b);
      if (points.empty() || !wanted[b]) continue;
      file_.write(points_at(b) + sizeof(Point) * filled[b], points);
      file_.write(rows_at(b) + sizeof(std::uint64_t) * filled[b], piece.rows(b));
      point_sums[b].add(points);
      row_sums[b].add(piece.rows(b));
      filled[b] += points.size();
    }
    system::announce(options, "scatter", first + size, rows.num_rows());
  }
  std::vector<SpoolChecksums> sums;
  for (std::size_t b = 0; b < cuts_.size(); ++b)
    sums.push_back({point_sums[b].value(), row_sums[b].value()});
  return sums;
}

void SiteSpool::read_points(std::size_t bucket, std::uint64_t first,
                            std::span<Point> points) const {
  file_.read(points_at(bucket) + sizeof(Point) * first, points);
}

void SiteSpool::read_rows(std::size_t bucket, std::uint64_t first,
                          std::span<std::uint64_t> rows) const {
  file_.read(rows_at(bucket) + sizeof(std::uint64_t) * first, rows);
}

}  // namespace rondel::distributed
