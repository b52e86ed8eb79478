// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "blocks/place_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "blocks/cube_position.h"

namespace rondel::blocks {
namespace {

// Rounded differences from a center would give sites on one ray different keys.
bool is_rounding_harmless(Model model, const Point& center) {
  return model == Model::weighted || center == Point{};
}

}  // namespace

HilbertKey place_key(const Point& p, Model model, const Point& center) {
  return hilbert_key(is_rounding_harmless(model, center) ? cube_position(p, center)
                                                         : exact_cube_position(p, center));
}

void high_place_keys(std::span<const Point> sites, Model model, const Point& center,
                     std::span<std::uint64_t> keys) {
  if (!is_rounding_harmless(model, center)) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      keys[i] = hilbert_key(exact_cube_position(sites[i], center)).high;
    }
    return;
  }
  for (std::size_t i = 0; i < sites.size(); ++i) {
    keys[i] = hilbert_key(cube_position(sites[i], center)).high;
  }
}

}  // namespace rondel::blocks
