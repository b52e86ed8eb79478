// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "system/arithmetic.h"

namespace rondel::system {

#if defined(__x86_64__) && defined(__GNUC__)

void ArithmeticScope::change(std::uint32_t vector, std::uint16_t x87) noexcept {
  vector_ = vector;
  x87_ = x87;
  _mm_setcsr(default_vector);
  asm volatile("fldcw %0" : : "m"(default_x87));
}

void ArithmeticScope::restore() noexcept {
  _mm_setcsr(vector_);
  asm volatile("fldcw %0" : : "m"(x87_));
}

#else

void ArithmeticScope::change() noexcept {
  std::fegetenv(&before_);
  std::fesetenv(FE_DFL_ENV);
}

void ArithmeticScope::restore() noexcept { std::fesetenv(&before_); }

#endif

}  // namespace rondel::system
