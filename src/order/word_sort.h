// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sorts words that fit the cache.
#pragma once

#include <cstdint>
#include <span>

namespace rondel::order {

// Sorts `words` into `result`, of the same size; uses up `words`. Linear in their number if their
// leading bits differ, and in any case linear in their number times their bits.
void sort_words(std::span<std::uint64_t> words, std::span<std::uint64_t> result);

}  // namespace rondel::order
