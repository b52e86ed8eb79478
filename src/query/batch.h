// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Many queries at once: in spatial order, so that each starts where the one before ended and finds
// what it needs in the cache; ranges of that order in parallel.
#pragma once

#include <span>

#include "order/hilbert.h"
#include "order/radix_sort.h"
#include "query/directory.h"
#include "query/engine.h"
#include "system/parallel.h"
#include "system/prefetch.h"

namespace rondel::query {

// So many queries are one thread's work at a time.
inline constexpr std::size_t queries_per_piece = 4096;

inline order::KeyedIndices sort_queries(std::span<const Point> queries, const Point& center,
                                        unsigned threads) {
  order::KeyedIndices sorted;
  sorted.keys.resize(queries.size());
  sorted.indices.resize(queries.size());
  system::parallel_for(threads, queries.size(), queries_per_piece,
                       [&](std::size_t first, std::size_t last) {
                         for (std::size_t i = first; i < last; ++i) {
                           sorted.keys[i] = spatial_key(queries[i], center);
                           sorted.indices[i] = static_cast<Index>(i);
                         }
                       });
  order::radix_sort(sorted, 3 + 2 * order::high_levels);
  return sorted;
}

// Calls work(range, cursor) for ranges of the queries in spatial order, given by their indices.
template <class Work>
void for_each_range(const order::KeyedIndices& sorted, std::span<const Point> queries,
                    const Directory& directory, unsigned threads, const Work& work) {
  system::parallel_for(
      threads, sorted.indices.size(), queries_per_piece, [&](std::size_t first, std::size_t last) {
        Cursor cursor;
        cursor.vertex = directory.near(queries[sorted.indices[first]]);
        work(std::span<const Index>(sorted.indices).subspan(first, last - first), cursor);
      });
}

// Calls answer(i, cursor) for the queries i of a range.
template <class Answer>
void for_each_query(std::span<const Index> range, std::span<const Point> queries, Cursor& cursor,
                    const Answer& answer) {
  for (std::size_t i = 0; i < range.size(); ++i) {
    const std::size_t ahead = i + system::prefetch_distance;
    if (ahead < range.size()) system::prefetch(&queries[range[ahead]]);
    answer(range[i], cursor);
  }
}

}  // namespace rondel::query
