// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Two passes over little memory, whatever the distribution:
//
//   deal   each site becomes one word, [ the key below its leaf's prefix | index ], in the list of
//          its leaf of the key tree, perhaps with its coordinates; parts of the input in parallel,
//          each with lists of its own
//   sort   the words of a leaf fit the cache: sorted there, their indices are the order; leaves in
//          parallel
//
// Words that agree in their part of the key, a few bits more than needed to tell spread-out sites
// apart, are put in order by all of their keys and coordinates (CloseSites).
#include "order/spatial_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <type_traits>

#include "order/close_sites.h"
#include "order/key_tree.h"
#include "order/sorts.h"
#include "system/chunk_lists.h"
#include "system/hash.h"
#include "system/large_arrays.h"
#include "system/parallel.h"
#include "system/prefetch.h"

namespace rondel::order {
namespace {

constexpr int unused_bits = 64 - high_key_bits;
constexpr std::size_t batch = 256;  // keys computed at once

// Below a longer prefix the high key has fewer than 24 bits: too few for the sites of a leaf, which
// are some thousands, so that their words continue with the low key.
constexpr int longest_shallow_prefix = high_key_bits - 24;

struct Word {
  std::uint64_t word;
};
struct WordAndSite {
  std::uint64_t word;
  Point site;
};

// Dealt is what is dealt: Word, or WordAndSite if sites are copied, too.
template <class Dealt>
class Ordering {
 public:
  Ordering(std::span<const Point> sites, Model model, const Point& center, unsigned threads,
           const SitesCheck& check, const system::SiteCopies& copies)
      : check_(check),
        copies_(copies),
        sites_(sites),
        model_(model),
        center_(center),
        threads_(system::num_threads(threads)),
        index_mask_(std::bit_ceil(std::max<std::size_t>(sites.size(), 2)) - 1),
        tree_(make_tree()) {}

  SpatialOrder run() {
    make_lists();
    system::parallel_invoke(
        threads_, [this] { deal(); }, [this] { make_room(); });
    count();
    sort();
    close_gaps();
    return std::move(result_);
  }

 private:
  static constexpr bool copies_sites = std::is_same_v<Dealt, WordAndSite>;

  // What a leaf holds, and what became of it.
  struct Leaf {
    std::size_t first_rank = 0;
    std::size_t num_sites = 0;
    std::size_t num_kept = 0;
  };

  // The keys of evenly spread indices, one of 256.
  [[nodiscard]] KeyTree make_tree() const {
    constexpr std::size_t sites_per_sample = 256;
    const int size_bits = static_cast<int>(std::bit_width(sites_.size()));
    const int root_bits = std::clamp(size_bits - (copies_sites ? 12 : 10), 3, 13);
    constexpr std::size_t grain = 4096;
    std::vector<std::uint64_t> keys(sites_.size() / sites_per_sample);
    system::parallel_for(threads_, keys.size(), grain, [&](std::size_t begin, std::size_t end) {
      std::vector<Point> points;
      points.reserve(end - begin);
      for (std::size_t k = begin; k < end; ++k) {
        // Any place within the stride: a constant one could meet the same column of every grid.
        const std::size_t i = k * sites_per_sample;
        points.push_back(sites_[i + (i * system::golden_multiplier >> 56)]);
      }
      if (check_) check_(points);
      const auto part = std::span(keys).subspan(begin, end - begin);
      place_keys(points, model_, center_, part);
      for (std::uint64_t& key : part) key <<= unused_bits;
    });
    std::vector<std::uint64_t> sample(keys.size());
    sort_words(keys, sample);
    const std::size_t most = std::max<std::size_t>(12, 6 * sample.size() >> root_bits);
    return {sample, high_key_bits, root_bits, most};
  }

  void make_room() {
    system::reserve_large(result_.order, sites_.size());
    result_.order.resize(sites_.size());
  }

  // The calling thread makes them, as its allocator keeps what is freed for the next build. A part of the
  // input has some sites for each leaf, or its lists would waste memory.
  void make_lists() {
    constexpr std::size_t least_of_leaf = 16;
    const std::size_t pieces = threads_ == 1 ? 1 : 4 * threads_;
    grain_ = std::max({std::size_t{1} << 14, system::num_pieces(sites_.size(), pieces),
                       threads_ == 1 ? 0 : least_of_leaf * tree_.num_leaves()});
    lists_.emplace(system::num_pieces(sites_.size(), grain_), tree_.num_leaves(),
                   std::min(grain_, sites_.size()));
  }

  void deal() {
    system::parallel_for(threads_, sites_.size(), grain_, [&](std::size_t begin, std::size_t end) {
      deal(begin, end, lists_->start(begin / grain_));
    });
  }

  void deal(std::size_t begin, std::size_t end,
            typename system::ChunkLists<Dealt>::Appender lists) const {
    std::array<std::uint64_t, batch> keys;
    std::array<std::uint64_t, batch> low_keys;
    const bool has_low_keys = tree_.longest_prefix_bits() > longest_shallow_prefix;
    for (std::size_t first = begin; first < end; first += batch) {
      const std::size_t size = std::min(batch, end - first);
      if (check_) check_(sites_.subspan(first, size));
      place_keys(sites_.subspan(first, size), model_, center_, std::span(keys).first(size),
                 std::span(low_keys).first(has_low_keys ? size : 0));
      for (std::size_t i = 0; i < size; ++i) {
        const std::uint64_t key = keys[i] << unused_bits;
        const std::uint32_t leaf = tree_.leaf(key);
        const int prefix = tree_.prefix_bits(leaf);
        std::uint64_t word = key << prefix;
        if (prefix > longest_shallow_prefix) {
          word |= low_keys[i] << (64 - 2 * low_levels) >> (high_key_bits - prefix);
        }
        word = (word & ~index_mask_) | (first + i);
        if constexpr (copies_sites) {
          lists.append(leaf, {word, sites_[first + i]});
        } else {
          lists.append(leaf, {word});
        }
      }
    }
  }

  void count() {
    constexpr std::size_t grain = 512;
    leaves_.resize(tree_.num_leaves());
    system::parallel_for(threads_, leaves_.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t part = 0; part < lists_->num_parts(); ++part) {
        for (std::size_t l = begin; l < end; ++l) leaves_[l].num_sites += lists_->size(part, l);
      }
    });
    std::size_t rank = 0;
    for (Leaf& leaf : leaves_) {
      leaf.first_rank = rank;
      rank += leaf.num_sites;
    }
  }

  struct Merged {
    std::vector<Duplicate> duplicates;
    std::vector<Renamed> renamed;  // ranks counted from the leaf's first
  };

  void sort() {
    merged_.resize(leaves_.size());
    system::parallel_for(threads_, leaves_.size(), 8, [&](std::size_t begin, std::size_t end) {
      Space space;
      list_chunks(begin, space.next);
      for (std::size_t l = begin; l < end; ++l) sort_leaf(l, space);
    });
  }

  using Chunks = std::vector<std::span<const Dealt>>;

  // What sorting a leaf needs.
  struct Space {
    Chunks chunks;
    Chunks next;  // of the next leaf
    std::vector<std::uint64_t> words;
  };

  void list_chunks(std::size_t l, Chunks& chunks) const {
    chunks.clear();
    if (l == leaves_.size()) return;
    lists_->for_chunks(l, [&](std::span<const Dealt> chunk) { chunks.push_back(chunk); });
  }

  // Its chunks are space.next, which become those of the leaf that follows.
  void sort_leaf(std::size_t l, Space& space) {
    const int chunk_bits = lists_->chunk_bits();
    const std::size_t in_chunk = (std::size_t{1} << chunk_bits) - 1;
    Leaf& leaf = leaves_[l];
    const std::size_t size = leaf.num_sites;
    space.chunks.swap(space.next);
    list_chunks(l + 1, space.next);
    // To find the sites to copy, words have their places in the chunks instead of indices.
    const bool has_places = copies_sites && space.chunks.size() << chunk_bits <= index_mask_ + 1;
    if (space.words.size() < 2 * size) space.words.resize(2 * size);
    std::uint64_t* end = space.words.data();
    for (std::size_t c = 0; c < space.chunks.size(); ++c) {
      for (std::size_t i = 0; i < space.chunks[c].size(); ++i) {
        const std::uint64_t word = space.chunks[c][i].word;
        *end++ = has_places ? (word & ~index_mask_) | ((c << chunk_bits) + i) : word;
      }
    }
    const std::span words(end, size);
    sort_words({space.words.data(), size}, words);

    const std::span<Index> order(result_.order.data() + leaf.first_rank, size);
    bool has_ties = false;
    for (std::size_t i = 0; i < size; ++i) {
      if (i >> chunk_bits < space.next.size()) {
        system::prefetch(space.next[i >> chunk_bits].data() + (i & in_chunk));
      }
      const std::size_t place = words[i] & index_mask_;
      order[i] = static_cast<Index>(place);
      if constexpr (copies_sites) {
        if (has_places) {
          const Dealt& dealt = space.chunks[place >> chunk_bits][place & in_chunk];
          order[i] = static_cast<Index>(dealt.word & index_mask_);
          copies_.set(leaf.first_rank + i, dealt.site);
        }
      }
      has_ties |= i > 0 && (words[i] ^ words[i - 1]) <= index_mask_;
    }
    leaf.num_kept = has_ties ? order_ties(words, order, merged_[l]) : size;
    if (copies_sites && (has_ties || !has_places)) {
      for (std::size_t i = 0; i < leaf.num_kept; ++i) {
        copies_.set(leaf.first_rank + i, sites_[order[i]]);
      }
    }
  }

  std::size_t order_ties(std::span<const std::uint64_t> words, std::span<Index> order,
                         Merged& merged) const {
    const CloseSites close_sites(sites_, model_, center_);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < words.size();) {
      std::size_t end = i + 1;
      while (end < words.size() && (words[i] ^ words[end]) <= index_mask_) ++end;
      const auto group = order.subspan(i, end - i);
      const std::size_t size =
          end - i == 1 ? 1 : close_sites.order(group, kept, merged.duplicates, merged.renamed);
      std::ranges::copy(group.first(size), order.begin() + static_cast<std::ptrdiff_t>(kept));
      kept += size;
      i = end;
    }
    return kept;
  }

  // Duplicates have left gaps behind the order of their leaves.
  void close_gaps() {
    lists_.reset();
    std::size_t rank = 0;
    auto& order = result_.order;
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      const Leaf& leaf = leaves_[l];
      if (rank != leaf.first_rank) {
        std::copy_n(order.data() + leaf.first_rank, leaf.num_kept, order.data() + rank);
        if (copies_sites) copies_.move(leaf.first_rank, leaf.num_kept, rank);
      }
      for (const auto& [in_leaf, name] : merged_[l].renamed) {
        result_.renamed.push_back({static_cast<Index>(rank + in_leaf), name});
      }
      rank += leaf.num_kept;
    }
    order.resize(rank);
    if (rank < sites_.size()) collect_duplicates();
  }

  void collect_duplicates() {
    std::vector<Index> representative(sites_.size(), no_index);
    for (Merged& merged : merged_) {
      for (const Duplicate& d : merged.duplicates) representative[d.site] = d.representative;
      merged = {};
    }
    result_.duplicates.reserve(sites_.size() - result_.order.size());
    for (Index i = 0; i < sites_.size(); ++i) {
      if (representative[i] != no_index) result_.duplicates.push_back({i, representative[i]});
    }
  }

  const SitesCheck& check_;
  system::SiteCopies copies_;
  std::span<const Point> sites_;
  Model model_;
  Point center_;
  unsigned threads_;
  std::uint64_t index_mask_;
  KeyTree tree_;
  std::size_t grain_ = 0;                           // sites of a part of the input
  std::optional<system::ChunkLists<Dealt>> lists_;  // by part and leaf
  std::vector<Leaf> leaves_;
  std::vector<Merged> merged_;
  SpatialOrder result_;
};

}  // namespace

SpatialOrder spatial_order(std::span<const Point> sites, Model model, const Point& center,
                           unsigned threads, const SitesCheck& check,
                           const system::SiteCopies& copies) {
  return copies.is_empty()
             ? Ordering<Word>(sites, model, center, threads, check, copies).run()
             : Ordering<WordAndSite>(sites, model, center, threads, check, copies).run();
}

}  // namespace rondel::order
