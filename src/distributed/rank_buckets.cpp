// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Each bucket is triangulated alone; its faces stay on the rank, and its open sites and edges go
// into a message for rank 0. The format of this message is in write_open_buckets() and
// read_open_buckets(), which must agree.

#include "distributed/rank_buckets.h"

#include <array>
#include <utility>

#include "distributed/same_points.h"
#include "system/prefetch.h"

namespace rondel::distributed {
namespace {

using OpenEnds = std::array<Index, 2>;

// Appends values[order[0]], values[order[1]], ...
template <class T>
void append_gathered(const LargeVector<T>& values, std::span<const Index> order,
                     LargeVector<T>& result) {
  constexpr std::size_t distance = system::prefetch_distance;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + distance < order.size()) system::prefetch(&values[order[i + distance]]);
    result.push_back(values[order[i]]);
  }
}

// Writes which of the rank's open sites have a point of their own, other than that of their place;
// they are few.
void add_other_points(const RankBuckets& own, MessageWriter& writer) {
  std::vector<Index> positions;
  std::vector<Point> points;
  Index position = 0;
  for (std::size_t b = 0; b < own.buckets.size(); ++b) {
    const auto kept = own.points_of(b);
    const auto& open_sites = own.buckets[b].border.open_sites;
    for (std::size_t s = 0; s < open_sites.size(); ++s, ++position) {
      const Point& p = kept[open_sites[s].rank];
      if (bits_of(p) == bits_of(own.open_points[b][s])) continue;
      positions.push_back(position);
      points.push_back(p);
    }
  }
  writer.add(positions);
  writer.add(points);
}

}  // namespace

std::vector<std::uint64_t> RankBuckets::open_sites() const {
  std::vector<std::uint64_t> result;
  for (std::size_t b = 0; b < buckets.size(); ++b) {
    for (std::size_t s = 0; s < buckets[b].border.open_sites.size(); ++s)
      result.push_back(open_site(b, s));
  }
  return result;
}

std::vector<Point> RankBuckets::kept_open_points() const {
  std::vector<Point> result;
  if (points.empty()) return result;
  for (std::size_t b = 0; b < buckets.size(); ++b) {
    for (const bulk::SeamSite& site : buckets[b].border.open_sites)
      result.push_back(points_of(b)[site.rank]);
  }
  return result;
}

RankBuckets triangulate_buckets(const RankSites& sites, const RankCounts& counts,
                                std::size_t first_bucket, std::size_t num_buckets, bool keep_points,
                                const system::Job& options) {
  RankBuckets own;
  own.first_site.push_back(0);
  system::Job job = options;
  job.progress = {};  // the progress over all buckets is shown instead
  LargeVector<Point> points;
  LargeVector<std::uint64_t> indices;
  std::uint64_t num_sites = 0;
  for (std::size_t b = 0; b < num_buckets; ++b)
    num_sites += counts.plan.buckets[first_bucket + b].num_sites;
  own.sites.reserve(num_sites);
  if (keep_points) own.points.reserve(num_sites);
  for (std::size_t b = 0; b < num_buckets; ++b) {
    system::obey_stop();
    system::announce(options, "triangulate", b, num_buckets);
    sites.gather(b, points, indices);
    bulk::Bucket bucket = bulk::triangulate_bucket(
        points, counts.plan.buckets[first_bucket + b].square, counts.all, job);
    std::vector<Point> open_points;
    for (const bulk::SeamSite& site : bucket.border.open_sites)
      open_points.push_back(points[bucket.order.order[site.rank]]);
    own.open_points.push_back(std::move(open_points));
    const std::size_t first = own.sites.size();
    append_gathered(indices, bucket.order.order, own.sites);
    for (const auto& [rank, name] : bucket.order.renamed) own.sites[first + rank] = indices[name];
    if (keep_points) {
      append_gathered(points, bucket.order.order, own.points);
      for (const auto& [rank, name] : bucket.order.renamed) own.points[first + rank] = points[name];
    }
    own.first_site.push_back(own.sites.size());
    for (const Duplicate& d : bucket.order.duplicates)
      own.duplicates.push_back({indices[d.site], indices[d.representative]});
    for (const Index rank : bucket.hidden) own.hidden.push_back(own.sites[first + rank]);
    bucket.order = {};
    own.buckets.push_back(std::move(bucket));
  }
  return own;
}

Bytes write_open_buckets(const RankBuckets& own, bool keep_points) {
  MessageWriter writer;
  for (std::size_t b = 0; b < own.buckets.size(); ++b) {
    const bulk::BucketBorder& border = own.buckets[b].border;
    std::vector<OpenEnds> edges;
    edges.reserve(border.open_edges.size());
    for (const bulk::SeamEdge& edge : border.open_edges) edges.push_back({edge.a, edge.b});
    writer.add_value<std::uint64_t>(own.first_site[b + 1] - own.first_site[b]);
    writer.add(own.open_points[b]);
    writer.add(edges);
    writer.add(border.hidden);
  }
  writer.add(own.open_sites());
  if (keep_points) add_other_points(own, writer);
  return writer.take();
}

void read_open_buckets(MessageReader& reader, std::span<const BucketCut> cuts, bool keep_points,
                       OpenBuckets& all) {
  const std::size_t first = all.sites.size();
  for (const BucketCut& cut : cuts) {
    bulk::OpenBucket& open = all.buckets.emplace_back();
    open.square = cut.square;
    open.num_sites = static_cast<double>(reader.value<std::uint64_t>());
    open.points = reader.values<Point>();
    for (const auto& [a, b] : reader.values<OpenEnds>()) open.open_edges.push_back({a, b, 0, 0});
    open.hidden = reader.values<Index>();
    if (keep_points) all.points.insert(all.points.end(), open.points.begin(), open.points.end());
  }
  const auto sites = reader.values<std::uint64_t>();
  all.sites.insert(all.sites.end(), sites.begin(), sites.end());
  if (!keep_points) return;
  const auto positions = reader.values<Index>();
  const auto points = reader.values<Point>();
  for (std::size_t i = 0; i < points.size(); ++i) all.points[first + positions[i]] = points[i];
}

}  // namespace rondel::distributed
