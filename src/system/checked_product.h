// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Products and sums of lengths that somebody gives, and that may not fit. Each function sets its
// result and returns true, or leaves the result alone and returns false.
#pragma once

#include <concepts>
#include <limits>
#include <type_traits>

namespace rondel::system {

// The result may be one of the factors.
template <std::unsigned_integral T>
bool multiply_checked(T a, std::type_identity_t<T> b, T& product) {
  if (b != 0 && a > std::numeric_limits<T>::max() / b) return false;
  product = static_cast<T>(a * b);
  return true;
}

template <std::unsigned_integral T>
bool add_checked(T a, std::type_identity_t<T> b, T& sum) {
  if (a > std::numeric_limits<T>::max() - b) return false;
  sum = static_cast<T>(a + b);
  return true;
}

}  // namespace rondel::system
