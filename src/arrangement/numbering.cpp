// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arcs are dealt to buckets of nodes, and sorted in each bucket.
#include "arrangement/numbering.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "order/spatial_order.h"
#include "rondel/error.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "system/row_assembly.h"
#include "system/site_copies.h"

namespace rondel::arrangement {
namespace {

constexpr std::size_t numbers_per_task = 4096;

// Sorts arcs by their nodes. A bucket has the arcs whose lower nodes have the same upper bits.
class ArcSort {
 public:
  ArcSort(std::span<const NodedArc> given, std::size_t num_nodes, unsigned threads)
      : given_(given), num_nodes_(num_nodes), threads_(threads) {
    constexpr std::size_t most_buckets = 1024;
    constexpr std::size_t most_parts = 64;
    while (system::num_pieces(num_nodes, std::size_t{1} << shift_) > most_buckets) ++shift_;
    num_buckets_ = system::num_pieces(num_nodes, std::size_t{1} << shift_);
    part_size_ = std::max(numbers_per_task, system::num_pieces(given.size(), most_parts));
  }

  NumberedArcs run() {
    deal();
    system::parallel_for(threads_, num_buckets_, 1,
                         [&](std::size_t bucket, std::size_t /*end*/) { sort_bucket(bucket); });
    system::sum_counts(num_different_);
    NumberedArcs result;
    result.arcs.resize(num_different_.back());
    result.halfedges.resize(given_.size());
    system::parallel_for(threads_, num_buckets_, 1, [&](std::size_t bucket, std::size_t /*end*/) {
      number_bucket(bucket, result);
    });
    return result;
  }

 private:
  // An arc from its lower node, and its place in the input, 2 * place + 1 if it is given backwards.
  struct SortedArc {
    Index low;
    Index high;
    Index halfedge;
  };

  [[nodiscard]] std::size_t bucket_of(const NodedArc& arc) const {
    return std::min(arc.from, arc.to) >> shift_;
  }
  [[nodiscard]] SortedArc entry_of(std::size_t i) const {
    const auto [low, high] = std::minmax(given_[i].from, given_[i].to);
    return {low, high, static_cast<Index>(2 * i) + (given_[i].from == low ? 0U : 1U)};
  }

  // Each part of the input has places of its own in each bucket.
  void deal() {
    begins_.resize(num_buckets_ + 1, given_.size());
    num_different_.assign(num_buckets_ + 1, 0);
    entries_.resize(given_.size());
    const std::size_t num_parts = system::num_pieces(given_.size(), part_size_);
    if (num_buckets_ == 1 && num_parts == 1) {
      begins_[0] = 0;
      for (std::size_t i = 0; i < given_.size(); ++i) entries_[i] = entry_of(i);
      return;
    }
    std::vector<std::size_t> places(num_parts * num_buckets_ + 1, 0);
    const auto place = [&](std::size_t begin, std::size_t bucket) {
      return bucket * num_parts + begin / part_size_;
    };
    system::parallel_for(threads_, given_.size(), part_size_,
                         [&](std::size_t begin, std::size_t end) {
                           std::vector<std::size_t> counts(num_buckets_, 0);
                           for (std::size_t i = begin; i < end; ++i) ++counts[bucket_of(given_[i])];
                           for (std::size_t k = 0; k < num_buckets_; ++k)
                             places[place(begin, k) + 1] = counts[k];
                         });
    system::sum_counts(places);
    for (std::size_t k = 0; k < num_buckets_; ++k) begins_[k] = places[k * num_parts];
    system::parallel_for(threads_, given_.size(), part_size_,
                         [&](std::size_t begin, std::size_t end) {
                           std::vector<std::size_t> next(num_buckets_);
                           for (std::size_t k = 0; k < num_buckets_; ++k)
                             next[k] = places[place(begin, k)];
                           for (std::size_t i = begin; i < end; ++i) {
                             entries_[next[bucket_of(given_[i])]++] = entry_of(i);
                           }
                         });
  }

  [[nodiscard]] std::span<SortedArc> bucket_entries(std::size_t bucket) {
    return std::span(entries_).subspan(begins_[bucket], begins_[bucket + 1] - begins_[bucket]);
  }

  // Deals the arcs of a bucket to their lower nodes, then sorts those of each node.
  void sort_bucket(std::size_t bucket) {
    const std::span<SortedArc> entries = bucket_entries(bucket);
    const auto first = static_cast<Index>(bucket << shift_);
    const std::size_t width = std::min(std::size_t{1} << shift_, num_nodes_ - first);
    system::RowPlaces<Index> places(width);
    for (const SortedArc& entry : entries) places.count(entry.low - first);
    // A word has the higher node of an arc and its place in the input.
    std::vector<std::uint64_t> words(places.sum());
    for (const SortedArc& entry : entries) {
      words[places.place(entry.low - first)] =
          std::uint64_t{entry.high} << 32U | std::uint64_t{entry.halfedge};
    }
    const std::vector<Index> offsets = std::move(places).offsets();
    std::size_t num_different = 0;
    for (std::size_t node = 0; node < width; ++node) {
      if (offsets[node] == offsets[node + 1]) continue;
      const std::span row =
          std::span(words).subspan(offsets[node], offsets[node + 1] - offsets[node]);
      std::ranges::sort(row);
      for (std::size_t k = 0; k < row.size(); ++k) {
        const auto high = static_cast<Index>(row[k] >> 32U);
        num_different += k == 0 || high != static_cast<Index>(row[k - 1] >> 32U) ? 1 : 0;
        entries[offsets[node] + k] = {static_cast<Index>(first + node), high,
                                      static_cast<Index>(row[k])};
      }
    }
    num_different_[bucket + 1] = num_different;
  }

  void number_bucket(std::size_t bucket, NumberedArcs& result) {
    const std::span<const SortedArc> entries = bucket_entries(bucket);
    std::size_t next = num_different_[bucket];
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const SortedArc& entry = entries[k];
      if (k + system::prefetch_distance < entries.size()) {
        const SortedArc& later = entries[k + system::prefetch_distance];
        system::prefetch_to_write(&result.halfedges[later.halfedge / 2]);
      }
      const NodedArc arc = {entry.low, entry.high};
      if (k == 0 || NodedArc{entries[k - 1].low, entries[k - 1].high} != arc) {
        result.arcs[next++] = arc;
      }
      result.halfedges[entry.halfedge / 2] =
          static_cast<Index>(2 * (next - 1)) + entry.halfedge % 2;
    }
  }

  std::span<const NodedArc> given_;
  std::size_t num_nodes_;
  unsigned threads_;
  unsigned shift_ = 12;
  std::size_t num_buckets_ = 0;
  std::size_t part_size_ = 0;
  std::vector<std::size_t> begins_;         // the entries of each bucket
  std::vector<std::size_t> num_different_;  // in each bucket, and at last before it
  std::vector<SortedArc> entries_;
};

}  // namespace

NumberedPoints numbered(std::span<const Point> given, std::size_t num_fixed, unsigned threads) {
  NumberedPoints result;
  result.points.resize(given.size());
  order::SpatialOrder order = order::spatial_order(given, Model::projected, {}, threads, {},
                                                   system::SiteCopies(std::span(result.points)));
  bool is_replaced = false;
  for (const auto& [rank, name] : order.renamed) {
    if (name >= num_fixed) continue;
    order.order[rank] = name;
    result.points[rank] = given[name];
    is_replaced = true;
  }
  result.sources = std::move(order.order);
  result.points.resize(result.sources.size());
  result.numbers.resize(given.size());
  system::parallel_for(threads, result.sources.size(), numbers_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t rank = begin; rank < end; ++rank) {
                           if (rank + system::prefetch_distance < end) {
                             system::prefetch_to_write(
                                 &result.numbers[result.sources[rank + system::prefetch_distance]]);
                           }
                           result.numbers[result.sources[rank]] = static_cast<Index>(rank);
                         }
                       });
  for (const auto& [rank, name] : order.renamed) result.numbers[name] = rank;
  for (const auto& [site, representative] : order.duplicates) {
    result.numbers[site] = result.numbers[representative];
  }
  if (!is_replaced) return result;
  // The order was that of points which others on their rays have replaced.
  NumberedPoints sorted = numbered(result.points, 0, threads);
  for (Index& number : result.numbers) number = sorted.numbers[number];
  for (Index& source : sorted.sources) source = result.sources[source];
  result.sources = std::move(sorted.sources);
  result.points = std::move(sorted.points);
  return result;
}

NumberedArcs numbered_arcs(std::span<const NodedArc> given, std::size_t num_nodes,
                           unsigned threads) {
  // A halfedge is twice the number of its arc, or one more.
  if (given.size() > no_index / 2) throw InvalidInput("there are more than 2147483647 arcs");
  return ArcSort(given, num_nodes, threads).run();
}

}  // namespace rondel::arrangement
