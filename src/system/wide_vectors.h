// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Loops that the compiler turns into vector code, compiled for wider vectors too than every machine
// has, and chosen at run time (RONDEL_WIDE_VECTORS=OFF: never). The results are the same: fused
// multiply-adds are off everywhere.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

// GCC for Windows stores vectors of 256 bits on a stack that is aligned to 128 bits only.
#if defined(__GNUC__) && defined(__x86_64__) && !defined(_WIN32) && !defined(RONDEL_NARROW_VECTORS)
#define RONDEL_HAS_WIDE_VECTORS
#endif
// A function that is called from a loop prevents vector code of any width, unless it is inlined.
// The module for WebAssembly has no vectors, and must be small.
#if defined(__GNUC__) && !defined(__wasm__)
#define RONDEL_ALWAYS_INLINE __attribute__((always_inline))
#else
#define RONDEL_ALWAYS_INLINE
#endif

// Before a loop of few rounds: GCC would write them one after the other, and make vector code of the
// loops that are left.
#if defined(__GNUC__) && !defined(__clang__)
#define RONDEL_KEEP_LOOP _Pragma("GCC unroll 1")
#else
#define RONDEL_KEEP_LOOP
#endif

namespace rondel::system {

#if defined(RONDEL_HAS_WIDE_VECTORS)

namespace wide_vectors {

enum class Width { bits_128, bits_256, bits_512 };

// Intel's first processors with vectors of 512 bits (Skylake to Cooper Lake) lower their clock for up
// to a millisecond after them, longer than a small build takes: those without VBMI2.
inline Width widest() {
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512vbmi2")) {
    return Width::bits_512;
  }
  return __builtin_cpu_supports("avx2") ? Width::bits_256 : Width::bits_128;
}

// Found out once.
inline Width width() {
  static const Width result = widest();
  return result;
}

// All that the work calls is compiled into it.
template <class Work>
__attribute__((flatten)) void run_128(const Work& work) {
  work();
}

template <class Work>
__attribute__((flatten, target("avx2"))) void run_256(const Work& work) {
  work();
}

template <class Work>
__attribute__((flatten, target("avx2,avx512f,avx512dq,avx512vl"))) void run_512(const Work& work) {
  work();
}

}  // namespace wide_vectors

// Whether vectors are wider than every machine has. Choices by masks lose against branches and
// tables where they are not.
inline bool has_wide_vectors() { return wide_vectors::width() != wide_vectors::Width::bits_128; }

// Calls work(), a lambda marked RONDEL_ALWAYS_INLINE that calls nothing but inline functions.
template <class Work>
void with_wide_vectors(const Work& work) {
  switch (wide_vectors::width()) {
    case wide_vectors::Width::bits_512:
      return wide_vectors::run_512(work);
    case wide_vectors::Width::bits_256:
      return wide_vectors::run_256(work);
    case wide_vectors::Width::bits_128:
      return wide_vectors::run_128(work);
  }
}

#else

inline bool has_wide_vectors() { return false; }

template <class Work>
void with_wide_vectors(const Work& work) {
  work();
}

#endif

}  // namespace rondel::system

namespace rondel::system {

// Choices as arithmetic, of which GCC makes vector code where it does not of branches.

// All bits, or none.
RONDEL_ALWAYS_INLINE inline std::uint64_t mask(bool condition) {
  return std::uint64_t{0} - static_cast<std::uint64_t>(condition);
}

RONDEL_ALWAYS_INLINE inline double choose(std::uint64_t mask, double yes, double no) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(yes) & mask) |
                               (std::bit_cast<std::uint64_t>(no) & ~mask));
}

}  // namespace rondel::system

namespace rondel::system {

// An array for code of wide vectors, which may call nothing that is not always inline:
// std::array's operators are not.
template <class T, std::size_t N>
struct PlainArray {
  T items[N];

  RONDEL_ALWAYS_INLINE constexpr T& operator[](std::size_t i) { return items[i]; }
  RONDEL_ALWAYS_INLINE constexpr const T& operator[](std::size_t i) const { return items[i]; }
};

}  // namespace rondel::system
