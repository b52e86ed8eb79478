// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/rank_sites.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace rondel::distributed {
namespace {

// Some of this rank's sites in a row, sorted by their buckets. Of a site its index is sent as what it is
// above that of the first one.
class DealtRound {
 public:
  DealtRound(std::span<const Point> points, std::span<const std::uint64_t> keys, std::uint64_t first_index,
        const RankPlan& plan)
      : plan_(plan), first_index_(first_index), begin_(plan.buckets.size() + 1, 0) {
    std::vector<Index> bucket_of(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      bucket_of[i] = static_cast<Index>(bulk::bucket_of(keys[i], plan.buckets));
      ++begin_[bucket_of[i] + 1];
    }
    for (std::size_t b = 1; b < begin_.size(); ++b) begin_[b] += begin_[b - 1];
    points_.resize(points.size());
    offsets_.resize(points.size());
    std::vector<Index> next = begin_;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Index place = next[bucket_of[i]]++;
      points_[place] = points[i];
      offsets_[place] = static_cast<Index>(i);
    }
  }

  [[nodiscard]] Bytes message_to(std::size_t rank) const {
    const std::size_t first = plan_.first_bucket[rank];
    const std::size_t num_buckets = plan_.num_buckets(rank);
    const Index begin = begin_[first];
    const Index size = begin_[first + num_buckets] - begin;
    if (size == 0) return {};
    MessageWriter writer;
    writer.reserve(sizeof(std::uint64_t) + num_buckets * sizeof(Index) +
                   size * (sizeof(Point) + sizeof(Index)));
    writer.add_value(first_index_);
    for (std::size_t b = first; b < first + num_buckets; ++b)
      writer.add_value<Index>(begin_[b + 1] - begin_[b]);
    writer.add_values(std::span<const Point>(points_).subspan(begin, size));
    writer.add_values(std::span<const Index>(offsets_).subspan(begin, size));
    return writer.take();
  }

 private:
  const RankPlan& plan_;
  std::uint64_t first_index_;
  std::vector<Index> begin_;  // of each bucket, and behind the last one
  LargeVector<Point> points_;
  LargeVector<Index> offsets_;
};

}  // namespace

RankSites::RankSites(Supersteps& steps, std::span<const Point> mine, RankCounts& counts,
                     const RankLimits& limits)
    : pieces_(steps.size()) {
  steps.begin("deal");
  std::uint64_t most_sites = 0;
  for (std::size_t rank = 0; rank < steps.size(); ++rank)
    most_sites = std::max(most_sites, counts.num_sites(rank));
  const std::uint64_t first_index = limits.first_number + counts.first_site[steps.rank()];
  const std::size_t num_buckets = counts.plan.num_buckets(steps.rank());
  for (std::uint64_t first = 0; first < most_sites; first += limits.most_dealt_sites) {
    system::obey_stop();
    const std::uint64_t begin = std::min<std::uint64_t>(first, mine.size());
    const std::uint64_t size = std::min(limits.most_dealt_sites, mine.size() - begin);
    std::vector<Bytes> messages;
    {
      const DealtRound round(mine.subspan(begin, size), std::span(counts.keys).subspan(begin, size),
                        first_index + begin, counts.plan);
      for (std::size_t rank = 0; rank < steps.size(); ++rank)
        messages.push_back(round.message_to(rank));
    }
    std::vector<Bytes> received = steps.exchange(std::move(messages));
    for (std::size_t rank = 0; rank < steps.size(); ++rank)
      add(std::move(received[rank]), num_buckets, pieces_[rank]);
  }
  counts.keys = {};
}

void RankSites::add(Bytes message, std::size_t num_buckets, std::vector<DealtPiece>& pieces) {
  if (message.empty()) return;
  DealtPiece& piece = pieces.emplace_back();
  piece.bytes = std::move(message);
  MessageReader reader(piece.bytes);
  piece.first_index = reader.value<std::uint64_t>();
  piece.begin.push_back(0);
  for (std::size_t b = 0; b < num_buckets; ++b)
    piece.begin.push_back(piece.begin.back() + reader.value<Index>());
  piece.points = reader.skip(piece.begin.back() * sizeof(Point));
  piece.offsets = reader.skip(piece.begin.back() * sizeof(Index));
}

void RankSites::gather(std::size_t bucket, LargeVector<Point>& points,
                       std::vector<std::uint64_t>& indices) const {
  std::size_t num_sites = 0;
  for (const auto& of_rank : pieces_) {
    for (const DealtPiece& piece : of_rank) num_sites += piece.begin[bucket + 1] - piece.begin[bucket];
  }
  points.resize(num_sites);
  indices.resize(num_sites);
  std::size_t next = 0;
  for (const auto& of_rank : pieces_) {
    for (const DealtPiece& piece : of_rank) {
      const std::size_t begin = piece.begin[bucket];
      const std::size_t size = piece.begin[bucket + 1] - begin;
      if (size == 0) continue;
      std::memcpy(static_cast<void*>(&points[next]), &piece.points[begin * sizeof(Point)],
                  size * sizeof(Point));
      for (std::size_t i = 0; i < size; ++i, ++next) {
        Index offset = 0;
        std::memcpy(&offset, &piece.offsets[(begin + i) * sizeof(Index)], sizeof offset);
        indices[next] = piece.first_index + offset;
      }
    }
  }
}

}  // namespace rondel::distributed
