// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/twins.h"

#include <algorithm>
#include <atomic>
#include <tuple>
#include <utility>
#include <vector>

#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::overlay {
namespace {

class TwinSearch {
 public:
  TwinSearch(std::span<const Index> rings, std::span<const Index> corners, std::size_t num_points,
             unsigned threads)
      : corners_(corners), threads_(threads), ends_(corners.size()), twins_(corners.size()) {
    find_ends(rings);
    list_leaving(num_points);
  }

  LargeVector<Index> run() {
    system::parallel_for(threads_, corners_.size(), halfedges_per_task,
                         [this](std::size_t begin, std::size_t end) {
                           for (std::size_t h = begin; h < end; ++h) {
                             // From the lower end: once for each pair.
                             if (corners_[h] <= ends_[h]) link(static_cast<Index>(h));
                           }
                         });
    return std::move(twins_);
  }

 private:
  static constexpr std::size_t rings_per_task = 4096;
  static constexpr std::size_t halfedges_per_task = 16384;
  // Rows with more are in the order of ends, for searches; others are in that of the halfedges.
  static constexpr std::size_t many = 16;

  void find_ends(std::span<const Index> rings) {
    system::parallel_for(threads_, rings.size() - 1, rings_per_task,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t r = begin; r < end; ++r) {
                             for (Index h = rings[r]; h < rings[r + 1]; ++h) {
                               ends_[h] = corners_[h + 1 == rings[r + 1] ? rings[r] : h + 1];
                               twins_[h] = no_index;
                             }
                           }
                         });
  }

  // Increments a count that several threads may have, and returns what it was before.
  Index take(Index& count) const {
    return threads_ == 1 ? count++ : std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
  }

  // Lists the halfedges by their origins.
  void list_leaving(std::size_t num_points) {
    begin_.assign(num_points + 1, 0);
    const auto for_corners = [&](auto visit) {
      system::parallel_for(threads_, corners_.size(), halfedges_per_task,
                           [&](std::size_t begin, std::size_t end) {
                             for (std::size_t h = begin; h < end; ++h) visit(h);
                           });
    };
    for_corners([&](std::size_t h) { take(begin_[corners_[h] + 1]); });
    system::sum_counts(begin_);
    std::vector<Index> next = begin_;
    leaving_.resize(corners_.size());
    for_corners([&](std::size_t h) { leaving_[take(next[corners_[h]])] = static_cast<Index>(h); });
    system::parallel_for(threads_, num_points, halfedges_per_task,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t p = begin; p < end; ++p) sort_row(p);
                         });
  }

  [[nodiscard]] std::span<Index> row(std::size_t p) {
    return std::span(leaving_).subspan(begin_[p], begin_[p + 1] - begin_[p]);
  }

  void sort_row(std::size_t p) {
    const std::span<Index> halfedges = row(p);
    if (halfedges.size() > many) {
      std::ranges::sort(halfedges, {}, [this](Index h) { return std::tuple(ends_[h], h); });
    } else if (threads_ != 1) {
      std::ranges::sort(halfedges);
    }
  }

  // The first of the halfedges of a long row that lead to this end.
  [[nodiscard]] std::size_t first_to(std::span<const Index> halfedges, Index end) const {
    const auto first =
        std::ranges::lower_bound(halfedges, end, {}, [this](Index h) { return ends_[h]; });
    return static_cast<std::size_t>(first - halfedges.begin());
  }

  // How many halfedges before this one have the same ends in the same direction.
  [[nodiscard]] std::size_t rank_of(Index h) {
    const std::span<const Index> halfedges = row(corners_[h]);
    if (halfedges.size() > many) {
      const std::size_t first = first_to(halfedges, ends_[h]);
      return static_cast<std::size_t>(std::ranges::find(halfedges.subspan(first), h) -
                                      halfedges.subspan(first).begin());
    }
    std::size_t rank = 0;
    for (std::size_t k = 0; halfedges[k] != h; ++k) rank += ends_[halfedges[k]] == ends_[h] ? 1 : 0;
    return rank;
  }

  void link(Index h) {
    std::size_t left = rank_of(h);
    const std::span<const Index> halfedges = row(ends_[h]);
    std::size_t k = 0;
    if (halfedges.size() > many) {
      k = first_to(halfedges, corners_[h]) + left;
      if (k >= halfedges.size() || ends_[halfedges[k]] != corners_[h]) return;
    } else {
      while (k < halfedges.size() && (ends_[halfedges[k]] != corners_[h] || left-- != 0)) ++k;
      if (k == halfedges.size()) return;
    }
    twins_[h] = halfedges[k];
    twins_[halfedges[k]] = h;
  }

  std::span<const Index> corners_;
  unsigned threads_;
  LargeVector<Index> ends_;
  std::vector<Index> begin_;  // of each point in `leaving_`
  LargeVector<Index> leaving_;
  LargeVector<Index> twins_;
};

}  // namespace

LargeVector<Index> twins_of(std::span<const Index> rings, std::span<const Index> corners,
                            std::size_t num_points, unsigned threads) {
  return TwinSearch(rings, corners, num_points, system::num_threads(threads)).run();
}

}  // namespace rondel::overlay
