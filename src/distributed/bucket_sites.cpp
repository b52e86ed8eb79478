// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/bucket_sites.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "distributed/run_limits.h"
#include "order/spatial_order.h"
#include "rondel/error.h"

namespace rondel::distributed {
namespace {

// Sites at different places, in increasing order of row: the first row of each place, and the
// smallest coordinates of its points.
class DistinctSites {
 public:
  explicit DistinctSites(const system::Job& options) : options_(options) {}

  [[nodiscard]] std::size_t size() const { return sites_.rows.size(); }
  BucketSites take() { return std::move(sites_); }

  // Adds sites with larger rows; returns which of them are duplicates, in increasing order of row.
  std::vector<DuplicateRow> add(std::span<const Point> points,
                                std::span<const std::uint64_t> rows) {
    sites_.points.insert(sites_.points.end(), points.begin(), points.end());
    sites_.named_points.insert(sites_.named_points.end(), points.begin(), points.end());
    sites_.rows.insert(sites_.rows.end(), rows.begin(), rows.end());
    const order::SpatialOrder order = order::spatial_order(
        sites_.points, options_.model, options_.sphere.center, options_.threads);
    std::vector<DuplicateRow> duplicates = duplicate_rows(order.duplicates, sites_.rows);
    keep(order);
    return duplicates;
  }

 private:
  // Keeps one site of each place.
  void keep(const order::SpatialOrder& order) {
    std::vector<Index> space;
    const auto names = order::names_of(order.order, order.renamed, space);
    std::vector<Index> ranks(names.size());
    std::iota(ranks.begin(), ranks.end(), Index{0});
    std::ranges::sort(ranks, {}, [&](Index rank) { return names[rank]; });
    BucketSites kept;
    for (const Index rank : ranks) {
      kept.points.push_back(sites_.points[order.order[rank]]);
      kept.named_points.push_back(sites_.named_points[names[rank]]);
      kept.rows.push_back(sites_.rows[names[rank]]);
    }
    sites_ = std::move(kept);
  }

  const system::Job& options_;
  BucketSites sites_;
};

// Reads a crowded slot piece by piece; both the kept sites and the new ones are at most
// `max_num_sites`.
std::optional<BucketSites> read_crowd(const BucketFiles& files, std::uint64_t max_num_sites,
                                      const system::Job& options, StoredBucket& stored) {
  DistinctSites places(options);
  Checksum point_sum;
  Checksum row_sum;
  std::vector<Point> points(max_num_sites);
  std::vector<std::uint64_t> rows(max_num_sites);
  for (std::uint64_t first = 0; first < files.num_sites; first += max_num_sites) {
    system::obey_stop();
    const std::uint64_t size = std::min(max_num_sites, files.num_sites - first);
    points.resize(size);
    rows.resize(size);
    files.spool.read_points(files.bucket, first, points);
    files.spool.read_rows(files.bucket, first, rows);
    point_sum.add(std::span<const Point>(points));
    row_sum.add(std::span<const std::uint64_t>(rows));
    files.store.add_duplicates(files.bucket, stored, places.add(points, rows));
    if (places.size() <= max_num_sites) continue;
    throw FileError(
        "of " + std::to_string(files.num_sites) + " sites within 2^-28 rad of each other, row " +
        std::to_string(rows[0]) + " among them, more than " + std::to_string(max_num_sites) +
        " are in different places: for all of them " + memory_of_crowd(files.num_sites) +
        " of memory are enough, then the run can be resumed");
  }
  if (point_sum.value() != files.scattered.points || row_sum.value() != files.scattered.rows)
    return {};
  return places.take();
}

}  // namespace

std::vector<std::uint64_t> vertex_rows(const order::SpatialOrder& order,
                                       std::span<const std::uint64_t> rows) {
  std::vector<std::uint64_t> result;
  result.reserve(order.order.size());
  for (const Index site : order.order) result.push_back(rows[site]);
  for (const auto& [rank, name] : order.renamed) result[rank] = rows[name];
  return result;
}

LargeVector<Point> vertex_points(const order::SpatialOrder& order, const BucketSites& sites) {
  const LargeVector<Point>& points = sites.named_points.empty() ? sites.points : sites.named_points;
  LargeVector<Point> result;
  result.reserve(order.order.size());
  for (const Index site : order.order) result.push_back(points[site]);
  for (const auto& [rank, name] : order.renamed) result[rank] = points[name];
  return result;
}

std::vector<DuplicateRow> duplicate_rows(std::span<const Duplicate> duplicates,
                                         std::span<const std::uint64_t> rows) {
  std::vector<DuplicateRow> result;
  result.reserve(duplicates.size());
  for (const Duplicate& d : duplicates) result.push_back({rows[d.site], rows[d.representative]});
  return result;
}

std::optional<BucketSites> read_bucket_sites(const BucketFiles& files, std::uint64_t max_num_sites,
                                             const system::Job& options, StoredBucket& stored) {
  if (files.num_sites > max_num_sites) return read_crowd(files, max_num_sites, options, stored);
  BucketSites sites;
  sites.points.resize(files.num_sites);
  files.spool.read_points(files.bucket, 0, sites.points);
  Checksum sum;
  sum.add(std::span<const Point>(sites.points));
  if (sum.value() != files.scattered.points) return {};
  return sites;
}

std::optional<std::vector<std::uint64_t>> read_bucket_rows(const BucketFiles& files) {
  std::vector<std::uint64_t> rows(files.num_sites);
  files.spool.read_rows(files.bucket, 0, rows);
  Checksum sum;
  sum.add(std::span<const std::uint64_t>(rows));
  if (sum.value() != files.scattered.rows) return {};
  return rows;
}

}  // namespace rondel::distributed
