// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/rank_sites.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "system/prefetch.h"

namespace rondel::distributed {
namespace {

// Finds the bucket of a key: a table of its first bits leads to a few candidates.
class BucketTable {
 public:
  explicit BucketTable(std::span<const BucketCut> cuts) : cuts_(cuts) {
    first_.reserve(table_size + 1);
    for (std::size_t i = 0; i < table_size; ++i)
      first_.push_back(static_cast<Index>(bucket_of(std::uint64_t{i} << shift, cuts) + 1));
    first_.push_back(static_cast<Index>(cuts.size()));
  }

  // Returns the number of buckets that begin at or before the key, minus one.
  [[nodiscard]] Index operator()(std::uint64_t key) const {
    const std::size_t i = key >> shift;
    const auto cuts = cuts_.subspan(first_[i], first_[i + 1] - first_[i]);
    const auto next = std::ranges::upper_bound(cuts, key, {}, &BucketCut::first_key);
    return first_[i] + static_cast<Index>(next - cuts.begin()) - 1;
  }

 private:
  static constexpr std::size_t table_size = std::size_t{1} << 13;
  static constexpr int shift = order::high_key_bits - 13;

  std::span<const BucketCut> cuts_;
  std::vector<Index> first_;
};

// A piece of this rank's sites, from site `first` on, with the keys of those that are not copies.
struct SiteRow {
  std::span<const Point> points;
  std::uint64_t first;
  std::span<const PointCopy> copies;
  std::span<const std::uint64_t> keys;

  // Calls visit(i, k) for each site i of the piece, counted from 0, that is the k-th one that is
  // not a copy.
  template <class Visit>
  void for_each(Visit visit) const {
    auto copy = copies.begin();
    std::size_t k = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (copy != copies.end() && copy->site == first + i) {
        ++copy;
      } else {
        visit(i, k++);
      }
    }
  }
};

// Makes the messages with a piece of the sites, sorted by bucket. A message has the index of the
// first site, for each bucket of the receiver the number of its sites, all points, and for each
// site the difference of its index to that of the first one.
class Scatter {
 public:
  Scatter(const RankPlan& plan, std::size_t self, std::size_t num_ranks)
      : plan_(plan), table_(plan.buckets), self_(self), num_ranks_(num_ranks) {}

  std::vector<Bytes> scatter(const SiteRow& row, std::uint64_t first_index) {
    counts_.assign(plan_.buckets.size(), 0);
    bucket_of_.resize(row.keys.size());
    for (std::size_t k = 0; k < row.keys.size(); ++k) {
      bucket_of_[k] = table_(row.keys[k]);
      ++counts_[bucket_of_[k]];
    }
    std::vector<Bytes> messages;
    for (std::size_t rank = 0; rank < num_ranks_; ++rank)
      messages.push_back(make_message(rank, first_index));
    find_places(messages);
    row.for_each([&](std::size_t i, std::size_t k) {
      ScatteredPlace& place = places_[bucket_of_[k]];
      const auto offset = static_cast<Index>(i);
      if (place.point != nullptr) {
        std::memcpy(place.point, &row.points[i], sizeof(Point));
        place.point += sizeof(Point);
        system::prefetch_to_write(place.point + lines_ahead);
      }
      std::memcpy(place.offset, &offset, sizeof offset);
      place.offset += sizeof offset;
    });
    return messages;
  }

 private:
  static constexpr std::size_t lines_ahead = 256;  // bytes

  // The addresses at which the next site of a bucket is written.
  struct ScatteredPlace {
    std::byte* point;  // null if points are not sent
    std::byte* offset;
  };

  // Returns the message for a rank, with room for its sites.
  [[nodiscard]] Bytes make_message(std::size_t rank, std::uint64_t first_index) const {
    const auto counts =
        std::span(counts_).subspan(plan_.first_bucket[rank], plan_.num_buckets(rank));
    std::size_t num_sites = 0;
    for (const Index count : counts) num_sites += count;
    if (num_sites == 0) return {};
    MessageWriter writer;
    const std::size_t room = num_sites * (sizeof(Index) + (rank == self_ ? 0 : sizeof(Point)));
    writer.reserve(sizeof first_index + counts.size_bytes() + room);
    writer.add_value(first_index);
    writer.add_values(counts);
    writer.add_room(room);
    return writer.take();
  }

  void find_places(std::span<Bytes> messages) {
    places_.clear();
    for (std::size_t rank = 0; rank < num_ranks_; ++rank) {
      const auto counts =
          std::span(counts_).subspan(plan_.first_bucket[rank], plan_.num_buckets(rank));
      std::size_t num_sites = 0;
      for (const Index count : counts) num_sites += count;
      std::byte* const end = messages[rank].data() + messages[rank].size();
      std::byte* offset = end - num_sites * sizeof(Index);
      std::byte* point = rank == self_ ? offset : offset - num_sites * sizeof(Point);
      for (const Index count : counts) {
        places_.push_back({rank == self_ ? nullptr : point, offset});
        point += count * sizeof(Point);
        offset += count * sizeof(Index);
      }
    }
  }

  const RankPlan& plan_;
  BucketTable table_;
  std::size_t self_;
  std::size_t num_ranks_;
  std::vector<Index> counts_;           // by bucket
  std::vector<Index> bucket_of_;        // by site that is not a copy
  std::vector<ScatteredPlace> places_;  // by bucket
};

}  // namespace

RankSites::RankSites(BspSession& session, std::span<const Point> mine, RankCounts& counts,
                     const RankLimits& limits)
    : mine_(mine),
      first_index_(limits.first_number + counts.first_site[session.rank()]),
      pieces_(session.size()) {
  session.begin("scatter");
  std::uint64_t max_num_sites = 0;
  for (std::size_t rank = 0; rank < session.size(); ++rank)
    max_num_sites = std::max(max_num_sites, counts.num_sites(rank));
  const std::size_t num_buckets = counts.plan.num_buckets(session.rank());
  Scatter scatter(counts.plan, session.rank(), session.size());
  std::span<const PointCopy> copies = counts.copies;
  std::span<const std::uint64_t> keys = counts.keys;
  for (std::uint64_t first = 0; first < max_num_sites; first += limits.max_scattered_sites) {
    system::obey_stop();
    const std::uint64_t begin = std::min<std::uint64_t>(first, mine.size());
    const std::uint64_t size = std::min(limits.max_scattered_sites, mine.size() - begin);
    const auto next = std::ranges::lower_bound(copies, begin + size, {}, &PointCopy::site);
    const auto num_copies = static_cast<std::size_t>(next - copies.begin());
    std::vector<Bytes> received = session.exchange(scatter.scatter(
        {mine.subspan(begin, size), begin, copies.first(num_copies), keys.first(size - num_copies)},
        first_index_ + begin));
    copies = copies.subspan(num_copies);
    keys = keys.subspan(size - num_copies);
    for (std::size_t rank = 0; rank < session.size(); ++rank)
      add(std::move(received[rank]), num_buckets, rank != session.rank(), pieces_[rank]);
  }
  counts.keys = {};
}

void RankSites::add(Bytes message, std::size_t num_buckets, bool has_points,
                    std::vector<ScatteredPiece>& pieces) {
  if (message.empty()) return;
  ScatteredPiece& piece = pieces.emplace_back();
  piece.bytes = std::move(message);
  MessageReader reader(piece.bytes);
  piece.first_index = reader.value<std::uint64_t>();
  piece.begin.push_back(0);
  for (std::size_t b = 0; b < num_buckets; ++b)
    piece.begin.push_back(piece.begin.back() + reader.value<Index>());
  if (has_points) piece.points = reader.skip(piece.begin.back() * sizeof(Point));
  piece.offsets = reader.skip(piece.begin.back() * sizeof(Index));
}

void RankSites::gather(std::size_t bucket, LargeVector<Point>& points,
                       LargeVector<std::uint64_t>& indices) const {
  std::size_t num_sites = 0;
  for (const auto& of_rank : pieces_) {
    for (const ScatteredPiece& piece : of_rank)
      num_sites += piece.begin[bucket + 1] - piece.begin[bucket];
  }
  points.resize(num_sites);
  indices.resize(num_sites);
  std::size_t next = 0;
  for (const auto& of_rank : pieces_) {
    for (const ScatteredPiece& piece : of_rank) {
      const std::size_t begin = piece.begin[bucket];
      const std::size_t size = piece.begin[bucket + 1] - begin;
      if (size == 0) continue;
      const bool is_own = piece.points.empty();
      if (!is_own) {
        std::memcpy(static_cast<void*>(&points[next]), &piece.points[begin * sizeof(Point)],
                    size * sizeof(Point));
      }
      const Point* const own = is_own ? &mine_[piece.first_index - first_index_] : nullptr;
      const auto offset_of = [&](std::size_t i) {
        Index offset = 0;
        std::memcpy(&offset, &piece.offsets[(begin + i) * sizeof(Index)], sizeof offset);
        return offset;
      };
      for (std::size_t i = 0; i < size; ++i, ++next) {
        const Index offset = offset_of(i);
        indices[next] = piece.first_index + offset;
        if (!is_own) continue;
        if (i + system::prefetch_distance < size)
          system::prefetch(own + offset_of(i + system::prefetch_distance));
        points[next] = own[offset];
      }
    }
  }
}

}  // namespace rondel::distributed
