// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "system/huge_pages.h"

#include <cstdint>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace rondel::system {
namespace {

constexpr std::size_t page = std::size_t{2} << 20;

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

// Aligned by hand: glibc keeps what is freed for the next build, but for what it aligns.
std::unique_ptr<void, FreeLarge> allocate_large(std::size_t bytes) {
  const bool is_large = bytes >= page;
  void* const allocated = ::operator new(is_large ? bytes + page : bytes);
  void* memory = allocated;
  if (is_large) {
    std::size_t room = bytes + page;
    memory = std::align(page, bytes, memory, room);
    advise_huge_pages(memory, bytes);
  }
  return {memory, FreeLarge(allocated)};
}

void FreeLarge::operator()(void* /*memory*/) const noexcept { ::operator delete(allocated_); }

}  // namespace rondel::system
