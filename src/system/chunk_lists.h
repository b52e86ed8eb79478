// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Many growing lists in one piece of memory, which several parts of a job append to at the same time,
// each to a share of its own. A share is written from front to back and no more than needed: what a part
// appends to a list is a chain of small chunks.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "system/large_arrays.h"
#include "system/prefetch.h"

namespace rondel::system {

template <class T>
class ChunkLists {
  // What one part has appended to a list. It ends where its last chunk is filled up to.
  struct List {
    std::size_t size;
    std::size_t end;
  };

 public:
  // Room for `capacity` elements of each part.
  ChunkLists(std::size_t num_parts, std::size_t num_lists, std::size_t capacity)
      : chunk_bits_(choose_chunk_bits(num_lists, capacity)),
        num_parts_(num_parts),
        num_lists_(num_lists),
        // The last chunk is asked for, and nothing is written to it.
        max_chunks_((capacity >> chunk_bits_) + num_lists + 1),
        elements_(make_large_array<T>((num_parts * max_chunks_) << chunk_bits_)),
        previous_(make_large_array<std::uint32_t>(num_parts * max_chunks_)),
        lists_(make_large_array<List>(num_parts * num_lists)) {}

  // Appends for one part. The lists must stay.
  class Appender {
   public:
    void append(std::size_t list, const T& element) {
      List& l = lists_[list];
      if ((l.size & mask_) == 0) add_chunk(l);
      T* const place = elements_ + l.end;
      *place = element;
      ++l.size;
      ++l.end;
      prefetch_to_write(place + ahead);
    }

   private:
    friend class ChunkLists;
    static constexpr std::size_t ahead =
        128 / sizeof(T);  // what is asked for early, to write there

    Appender(T* elements, std::uint32_t* previous, List* lists, int chunk_bits)
        : elements_(elements),
          previous_(previous),
          lists_(lists),
          chunk_bits_(chunk_bits),
          mask_((std::size_t{1} << chunk_bits) - 1) {}

    void add_chunk(List& list) {
      previous_[num_chunks_] = static_cast<std::uint32_t>((list.end - 1) >> chunk_bits_);
      list.end = num_chunks_ << chunk_bits_;
      ++num_chunks_;
      for (std::size_t i = 0; i < ahead; i += ahead / 2) {
        prefetch_to_write(elements_ + list.end + mask_ + 1 + i);
      }
    }

    T* elements_;
    std::uint32_t* previous_;
    List* lists_;
    int chunk_bits_;
    std::size_t mask_;
    std::size_t num_chunks_ = 0;
  };

  // Each part calls this once, before anything is read.
  Appender start(std::size_t part) {
    List* const lists = lists_.get() + part * num_lists_;
    std::fill_n(lists, num_lists_, List{0, 0});
    return {elements_of(part), previous_.get() + part * max_chunks_, lists, chunk_bits_};
  }

  [[nodiscard]] std::size_t num_parts() const { return num_parts_; }
  // Chunks have 2^chunk_bits() elements.
  [[nodiscard]] int chunk_bits() const { return chunk_bits_; }
  // Returns how much a part has appended to a list.
  [[nodiscard]] std::size_t size(std::size_t part, std::size_t list) const {
    return lists_[part * num_lists_ + list].size;
  }

  // Calls visit(chunk), a span, for the chunks that each part has appended to a list, the last one first.
  template <class Visit>
  void for_chunks(std::size_t list, Visit visit) const {
    for (std::size_t part = 0; part < num_parts_; ++part) {
      std::size_t end = lists_[part * num_lists_ + list].end;
      for (std::size_t left = size(part, list); left != 0;) {
        const std::size_t chunk = (end - 1) >> chunk_bits_;
        const std::size_t begin = chunk << chunk_bits_;
        visit(std::span<const T>(elements_of(part) + begin, end - begin));
        left -= end - begin;
        end = (std::size_t{previous_[part * max_chunks_ + chunk]} + 1) << chunk_bits_;
      }
    }
  }

 private:
  // Short chunks waste less, where a part has little for each list; long ones lie on fewer pages.
  static int choose_chunk_bits(std::size_t num_lists, std::size_t capacity) {
    constexpr int most = sizeof(T) > 8 ? 6 : 5;
    return std::clamp(static_cast<int>(std::bit_width(capacity / num_lists / 2)) - 1, 2, most);
  }

  [[nodiscard]] T* elements_of(std::size_t part) const {
    return elements_.get() + ((part * max_chunks_) << chunk_bits_);
  }

  int chunk_bits_;
  std::size_t num_parts_;
  std::size_t num_lists_;
  std::size_t max_chunks_;  // of a part
  LargeArray<T> elements_;
  LargeArray<std::uint32_t> previous_;  // of a chunk, in its list
  LargeArray<List> lists_;              // by part, then by list
};

}  // namespace rondel::system
