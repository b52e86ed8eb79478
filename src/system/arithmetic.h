// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The arithmetic that all proofs of the library suppose: that of IEEE 754 as a program finds it
// when it starts. Numbers are rounded to nearest, subnormal ones are numbers like others, and nothing
// traps. Another library, a linker's flag or the program may have chosen otherwise for a thread.
#pragma once

#include <cfloat>
#include <cstdint>
#include <limits>
#if !defined(__x86_64__) || !defined(__GNUC__)
#include <cfenv>
#else
#include <xmmintrin.h>
#endif

#include "rondel/export.h"

// Clang has macros for the first two only, and none for contraction; docs/guide/embedding.md says so.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "Rondel does not compile with -ffast-math or its parts: every result rests on IEEE 754."
#endif

namespace rondel::system {

static_assert(std::numeric_limits<double>::is_iec559, "doubles are those of IEEE 754");
static_assert(FLT_EVAL_METHOD == 0, "every operation rounds to a double");

// While it lives, its thread computes as the proofs suppose; then as before. Every public function
// that computes has one, and so has every piece of a parallel loop, which may run on any thread.
// What changes something is out of line, and a function that computes itself does so by
// apart(), so that the compiler moves no computation past it.
class RONDEL_API ArithmeticScope {
 public:
#if defined(__x86_64__) && defined(__GNUC__)
  ArithmeticScope() noexcept {
    const std::uint32_t vector = _mm_getcsr();
    std::uint16_t x87 = 0;
    asm volatile("fnstcw %0" : "=m"(x87));
    has_changed_ = (vector & ~status_bits) != default_vector || x87 != default_x87;
    if (has_changed_) [[unlikely]]
      change(vector, x87);
  }
#else
  ArithmeticScope() noexcept : has_changed_(true) { change(); }
#endif
  ~ArithmeticScope() {
    if (has_changed_) [[unlikely]]
      restore();
  }
  ArithmeticScope(const ArithmeticScope&) = delete;
  ArithmeticScope& operator=(const ArithmeticScope&) = delete;

 private:
  bool has_changed_;
#if defined(__x86_64__) && defined(__GNUC__)
  // All exceptions masked, rounding to nearest, subnormal numbers neither read nor written as zero;
  // for long double all of its 64 bits.
  static constexpr std::uint32_t status_bits = 0x3f;
  static constexpr std::uint32_t default_vector = 0x1f80;
  static constexpr std::uint16_t default_x87 = 0x037f;

  void change(std::uint32_t vector, std::uint16_t x87) noexcept;

  std::uint32_t vector_;
  std::uint16_t x87_;
#else
  void change() noexcept;

  std::fenv_t before_;
#endif
  void restore() noexcept;
};

// Calls `work` where no compiler inlines it: an operation whose result is only needed later may else be
// done after the end of the scope, as the operation does not say that it depends on a mode.
template <class Work>
[[gnu::noinline]] auto apart(const Work& work) {
  return work();
}

}  // namespace rondel::system
