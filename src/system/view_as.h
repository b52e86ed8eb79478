// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The one place where numbers are read as rows of numbers without a copy.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

namespace rondel::system {

// Row is a struct of Numbers and nothing else, which compilers lay out as an array of them. Numbers
// at the end that make no whole row are left out.
template <class Row, class Number>
std::span<const Row> view_as(std::span<const Number> numbers) {
  static_assert(std::is_trivially_copyable_v<Row> && std::is_standard_layout_v<Row>);
  static_assert(sizeof(Row) % sizeof(Number) == 0 && alignof(Row) == alignof(Number));
  constexpr std::size_t width = sizeof(Row) / sizeof(Number);
  return {reinterpret_cast<const Row*>(numbers.data()), numbers.size() / width};
}

}  // namespace rondel::system
