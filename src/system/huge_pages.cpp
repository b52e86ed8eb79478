// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <cstdint>
#include <memory>
#include <new>

#include "system/large_arrays.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace rondel::system {
namespace {

constexpr std::size_t page = std::size_t{2} << 20;
#if defined(__wasm__)
constexpr bool has_huge_pages = false;
#else
constexpr bool has_huge_pages = true;
#endif

}  // namespace

void advise_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(memory) % page) % page;
  if (bytes < before + page) return;
  const std::size_t size = (bytes - before) / page * page;
  // Failure costs speed only.
  madvise(static_cast<char*>(memory) + before, size, MADV_HUGEPAGE);
#endif
}

}  // namespace rondel::system

namespace rondel::detail {

// Aligned by hand: glibc keeps what is freed for the next build, but not what it aligns. Where the
// memory begins stands before it.
void* allocate_large(std::size_t bytes) {
  constexpr std::size_t cache_line = 64;
  const std::size_t alignment =
      !system::has_huge_pages || bytes < system::page ? cache_line : system::page;
  void* const begin = ::operator new(bytes + alignment + sizeof(void*));
  void* memory = static_cast<void**>(begin) + 1;
  std::size_t room = bytes + alignment;
  std::align(alignment, bytes, memory, room);
  static_cast<void**>(memory)[-1] = begin;
  system::advise_huge_pages(memory, bytes);
  return memory;
}

void free_large(void* memory) noexcept {
  if (memory != nullptr) ::operator delete(static_cast<void**>(memory)[-1]);
}

}  // namespace rondel::detail
