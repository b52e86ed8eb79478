// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Many growing lists in one piece of memory, which is written from front to back and no more than
// needed: the lists are chains of small chunks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "system/large_arrays.h"
#include "system/prefetch.h"

namespace rondel::system {

template <class T>
class ChunkLists {
 public:
  // Short ones waste less, long ones lie on fewer pages.
  static constexpr std::size_t chunk_size = sizeof(T) > 8 ? 64 : 32;

  // Room for `capacity` elements in all.
  ChunkLists(std::size_t num_lists, std::size_t capacity)
      : elements_(system::make_large_array<T>(max_chunks(num_lists, capacity) * chunk_size)),
        previous_(max_chunks(num_lists, capacity)),
        lists_(num_lists) {}

  void append(std::size_t list, const T& element) {
    List& l = lists_[list];
    if (l.size % chunk_size == 0) add_chunk(l);
    T* const place = elements_.get() + l.end;
    *place = element;
    ++l.size;
    ++l.end;
    prefetch_to_write(place + ahead);
  }

  [[nodiscard]] std::size_t size(std::size_t list) const { return lists_[list].size; }

  // Calls visit(chunk), a span, for the chunks of a list, the last one first.
  template <class Visit>
  void for_chunks(std::size_t list, Visit visit) const {
    std::size_t end = lists_[list].end;
    for (std::size_t left = lists_[list].size; left != 0;) {
      const std::size_t chunk = (end - 1) / chunk_size;
      const std::span elements(elements_.get() + chunk * chunk_size, end - chunk * chunk_size);
      visit(std::span<const T>(elements));
      left -= elements.size();
      end = (std::size_t{previous_[chunk]} + 1) * chunk_size;
    }
  }

 private:
  static constexpr std::size_t ahead = 128 / sizeof(T);  // what is asked for early, to write there

  // Ends where its last chunk is filled up to.
  struct List {
    std::size_t size = 0;
    std::size_t end = 0;
  };

  // With one that nothing is written to but asked for.
  static std::size_t max_chunks(std::size_t num_lists, std::size_t capacity) {
    return capacity / chunk_size + num_lists + 1;
  }

  void add_chunk(List& list) {
    previous_[num_chunks_] = static_cast<std::uint32_t>((list.end - 1) / chunk_size);
    list.end = num_chunks_ * chunk_size;
    ++num_chunks_;
    for (std::size_t i = 0; i < ahead; i += ahead / 2) {
      prefetch_to_write(elements_.get() + list.end + chunk_size + i);
    }
  }

  std::size_t num_chunks_ = 0;
  system::LargeArray<T> elements_;
  LargeVector<std::uint32_t> previous_;  // of a chunk, in its list
  std::vector<List> lists_;
};

}  // namespace rondel::system
