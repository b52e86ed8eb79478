// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rank 0 reads what the ranks left open, in the order of the curve, and joins it. If all sites are
// open and on one great circle there is nothing to join, and they are sorted into a ring.

#include "distributed/rank_join.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "api/triangulation_impl.h"
#include "distributed/rank_buckets.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"

namespace rondel::distributed {
namespace {

std::vector<Point> in_order(std::span<const Point> points, std::span<const Index> order) {
  std::vector<Point> ordered;
  ordered.reserve(order.size());
  for (const Index i : order) ordered.push_back(points[i]);
  return ordered;
}

// Joins sites that are all open and lie on one great circle. Uses the order of their indices, which
// decides where the ring begins.
JoinedReport join_ring(const OpenBuckets& open, const system::Job& options,
                       MessageWriter& message) {
  std::vector<Point> points;
  for (const bulk::OpenBucket& bucket : open.buckets)
    points.insert(points.end(), bucket.points.begin(), bucket.points.end());
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order, {}, [&](Index s) { return open.sites[s]; });
  const Triangulation flat = delaunay(Sites(in_order(points, order)), options, options);
  std::vector<std::uint64_t> ring;
  std::vector<std::uint64_t> hidden;
  for (const Index s : flat.ring()) ring.push_back(open.sites[order[s]]);
  for (const Hidden& h : flat.hidden()) hidden.push_back(open.sites[order[h.site]]);
  const JoinedReport report = {flat.dimension(), 0};
  message.add_value(report);
  message.add(ring);
  message.add(hidden);
  std::vector<SiteArea> all;
  if (!open.points.empty()) {
    const Triangulation named = api::make_triangulation(
        Sites(in_order(open.points, order)), Triangulation::Impl::of(flat).arrays, options, {});
    for (const double area : areas(named, options))
      all.push_back({open.sites[order[all.size()]], area});
  }
  message.add(all);
  return report;
}

// Returns the messages that were written, by rank.
std::vector<Bytes> take(std::vector<MessageWriter> writers) {
  std::vector<Bytes> messages;
  messages.reserve(writers.size());
  for (MessageWriter& writer : writers) messages.push_back(writer.take());
  return messages;
}

}  // namespace

std::vector<Bytes> join_ranks(std::vector<Bytes> received, const RankCounts& counts,
                              bool keep_points, const system::Job& options) {
  OpenBuckets open;
  OpenRanges ranges = {{0}, {0}};
  for (std::size_t rank = 0; rank < received.size(); ++rank) {
    const std::size_t first = counts.plan.first_bucket[rank];
    const std::size_t end = counts.plan.first_bucket[rank + 1];
    const Bytes message = std::exchange(received[rank], {});
    MessageReader reader(message);
    read_open_buckets(reader, std::span(counts.plan.buckets).subspan(first, end - first),
                      keep_points, open);
    Index num_edges = ranges.edges.back();
    for (std::size_t b = first; b < end; ++b)
      num_edges += static_cast<Index>(open.buckets[b].open_edges.size());
    ranges.sites.push_back(static_cast<Index>(open.sites.size()));
    ranges.edges.push_back(num_edges);
  }
  system::Job job = options;
  job.progress = {};
  std::vector<MessageWriter> messages(received.size());
  const auto joined = bulk::join_buckets(open.buckets, counts.all, job);
  if (joined) {
    open.buckets = {};
    for (MessageWriter& message : messages)
      message.add_value(JoinedReport{2, joined->ghost_faces.size()});
    write_joined_parts(*joined, ranges, open.sites, open.points, messages);
  } else {
    const JoinedReport report = join_ring(open, job, messages[0]);
    for (MessageWriter& message : std::span(messages).subspan(1)) message.add_value(report);
  }
  return take(std::move(messages));
}

}  // namespace rondel::distributed
