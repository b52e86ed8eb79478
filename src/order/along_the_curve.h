// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points along the spatial order, for whoever visits them one after the other: each is then close
// to the one before, on the sphere and in memory. Only speed depends on it; the order of a build,
// which knows duplicates and ties, is spatial_order.h.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "order/place_keys.h"
#include "order/sorts.h"
#include "system/parallel.h"

namespace rondel::order {

// The indices sorted by the high keys of their points, point(i) for index i, and these keys.
template <class PointOf>
KeyedIndices along_the_curve(std::vector<Index> indices, Model model, const Point& center,
                             unsigned threads, const PointOf& point) {
  constexpr std::size_t grain = 4096;
  KeyedIndices sorted;
  sorted.keys.resize(indices.size());
  sorted.indices = std::move(indices);
  system::parallel_for(
      threads, sorted.indices.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::vector<Point> points;
        points.reserve(end - begin);
        for (std::size_t i = begin; i < end; ++i) {
          points.push_back(point(sorted.indices[i]));
        }
        place_keys(points, model, center, std::span(sorted.keys).subspan(begin, end - begin));
      });
  radix_sort(sorted, high_key_bits);
  return sorted;
}

// Sorts a few indices by the whole key(i), and by themselves where points share a place.
template <class KeyOf>
void sort_along_the_curve(std::span<Index> indices, const KeyOf& key) {
  std::vector<std::pair<HilbertKey, Index>> entries;
  entries.reserve(indices.size());
  for (const Index i : indices) entries.emplace_back(key(i), i);
  std::ranges::sort(entries);
  std::ranges::transform(entries, indices.begin(), [](const auto& entry) { return entry.second; });
}

}  // namespace rondel::order
