// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The keys of places along the spatial order: one by one, and of many at once.
#pragma once

#include <cstdint>
#include <span>

#include "order/cube_position.h"
#include "order/hilbert.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::order {

inline constexpr int high_key_bits = 3 + 2 * high_levels;

// The position of a site on the cube by which it has its place in the spatial order.
CubePosition place_position(const Point& p, Model model, const Point& center);

// The key of a site's place: all sites in one place have it.
RONDEL_API HilbertKey place_key(const Point& p, Model model, const Point& center);

// keys[i] = place_key(sites[i]).high and, unless empty, low_keys[i] = place_key(sites[i]).low.
RONDEL_API void place_keys(std::span<const Point> sites, Model model, const Point& center,
                           std::span<std::uint64_t> keys, std::span<std::uint64_t> low_keys = {});

}  // namespace rondel::order
