// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that all move at once, in the form in which a model stores them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "exact/vector.h"
#include "rondel/types.h"
#include "system/parallel.h"
#include "system/prefetch.h"

namespace rondel::models {

// Replaces stored[i] by the form of input[order[i]] for all i, where forms_of(points, forms) computes
// those of some points. Returns the largest square of a distance between an old and a new form, of
// those i where in_use[i] is there and not no_index.
template <class FormsOf>
double replace_all(std::span<exact::Vector3<double>> stored, std::span<const Point> input,
                   std::span<const Index> order, std::span<const Index> in_use, unsigned threads,
                   const FormsOf& forms_of) {
  constexpr std::size_t grain = 8192;
  constexpr std::size_t some = 128;
  std::vector<double> largest(system::num_pieces(stored.size(), grain), 0.0);
  system::parallel_for(threads, stored.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::array<Point, some> points;
    std::array<exact::Vector3<double>, some> forms;
    double square = 0;
    for (std::size_t first = begin; first < end; first += some) {
      const std::size_t size = std::min(some, end - first);
      for (std::size_t i = 0; i < size; ++i) {
        // The order of the input is anyone's guess.
        if (first + i + system::prefetch_distance < end) {
          system::prefetch(&input[order[first + i + system::prefetch_distance]]);
        }
        points[i] = input[order[first + i]];
      }
      forms_of(std::span(points).first(size), forms.data());
      for (std::size_t i = 0; i < size; ++i) {
        const exact::Vector3<double> step = forms[i] - stored[first + i];
        stored[first + i] = forms[i];
        const bool counts = first + i < in_use.size() && in_use[first + i] != no_index;
        square = std::max(square, counts ? dot(step, step) : 0);
      }
    }
    largest[begin / grain] = square;
  });
  return largest.empty() ? 0 : *std::ranges::max_element(largest);
}

}  // namespace rondel::models
