// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Many queries at once: in spatial order, so that each starts where the one before ended and finds
// what it needs in the cache; ranges of that order in parallel.
#pragma once

#include <numeric>
#include <span>
#include <utility>

#include "order/along_the_curve.h"
#include "query/engine.h"
#include "system/parallel.h"
#include "system/prefetch.h"

namespace rondel::query {

// So many queries are one thread's work at a time.
inline constexpr std::size_t queries_per_piece = 4096;

// Calls work(range, cursor) for ranges of the queries in spatial order, given by their indices. A
// cursor begins at near(query), a vertex close to the first query of its range.
template <class Near, class Work>
void for_each_range(std::span<const Point> queries, Model model, const Point& center,
                    unsigned threads, const Near& near, const Work& work) {
  std::vector<Index> indices(queries.size());
  std::iota(indices.begin(), indices.end(), Index{0});
  const auto sorted = order::along_the_curve(std::move(indices), model, center, threads,
                                             [queries](Index i) { return queries[i]; });
  system::parallel_for(
      threads, queries.size(), queries_per_piece, [&](std::size_t first, std::size_t last) {
        Cursor cursor;
        cursor.vertex = near(queries[sorted.indices[first]]);
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
