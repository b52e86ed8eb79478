// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that all move at once, in the form in which a model stores them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "exact/vector.h"
#include "rondel/types.h"
#include "system/parallel.h"
#include "system/prefetch.h"

namespace rondel::models {

// Replaces stored[i] by form_of(input[order[i]]) for all i. Returns the largest square of a distance
// between an old and a new form, of those i where in_use[i] is there and not no_index.
template <class FormOf>
double replace_all(std::span<exact::Vector3<double>> stored, std::span<const Point> input,
                   std::span<const Index> order, std::span<const Index> in_use, unsigned threads,
                   const FormOf& form_of) {
  constexpr std::size_t grain = 8192;
  std::vector<double> largest(system::num_pieces(stored.size(), grain), 0.0);
  system::parallel_for(threads, stored.size(), grain, [&](std::size_t begin, std::size_t end) {
    double square = 0;
    for (std::size_t i = begin; i < end; ++i) {
      // The order of the input is anyone's guess.
      if (i + system::prefetch_distance < end) {
        system::prefetch(&input[order[i + system::prefetch_distance]]);
      }
      const exact::Vector3<double> form = form_of(input[order[i]]);
      if (i < in_use.size() && in_use[i] != no_index) {
        const exact::Vector3<double> step = form - stored[i];
        square = std::max(square, dot(step, step));
      }
      stored[i] = form;
    }
    largest[begin / grain] = square;
  });
  return largest.empty() ? 0 : *std::ranges::max_element(largest);
}

}  // namespace rondel::models
