// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "faults/failing_allocation.h"

#include <atomic>
#include <cstdlib>
#include <limits>

namespace rondel::test {
namespace {

constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

std::atomic<std::size_t> num_blocks = 0;
std::atomic<std::size_t> num_allocations = 0;
std::atomic<std::size_t> first_to_fail = never;
std::atomic<std::size_t> last_to_fail = never;
std::atomic<bool> has_failed = false;

bool is_to_fail() {
  const std::size_t n = ++num_allocations;
  const bool fails = n >= first_to_fail && n <= last_to_fail;
  if (fails) has_failed = true;
  return fails;
}

void* allocate(std::size_t size, std::size_t alignment) {
  if (is_to_fail()) return nullptr;
  void* const block =
      alignment <= alignof(std::max_align_t)
          ? std::malloc(size)
          : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (block != nullptr) ++num_blocks;
  return block;
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  void* const block = allocate(size, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void release(void* block) {
  if (block == nullptr) return;
  --num_blocks;
  std::free(block);
}

}  // namespace

std::size_t blocks_in_use() { return num_blocks; }

FailingAllocation::FailingAllocation(std::size_t n, Shortage shortage) {
  has_failed = false;
  num_allocations = 0;
  last_to_fail = shortage == Shortage::of_one_block ? n : never;
  first_to_fail = n;
}

bool FailingAllocation::stop() {
  first_to_fail = never;
  return has_failed;
}

}  // namespace rondel::test

void* operator new(std::size_t size) { return rondel::test::allocate_or_throw(size, 1); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return rondel::test::allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return rondel::test::allocate(size, 1);
}
void operator delete(void* block) noexcept { rondel::test::release(block); }
void operator delete(void* block, std::size_t) noexcept { rondel::test::release(block); }
void operator delete(void* block, std::align_val_t) noexcept { rondel::test::release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  rondel::test::release(block);
}
void operator delete(void* block, const std::nothrow_t&) noexcept { rondel::test::release(block); }

// What is asked for by calloc is given back by free, which is not counted.
// NOLINTBEGIN(readability-identifier-naming): the linker's names
extern "C" void* __real_calloc(std::size_t count, std::size_t size);
extern "C" void* __wrap_calloc(std::size_t count, std::size_t size) {
  return rondel::test::is_to_fail() ? nullptr : __real_calloc(count, size);
}
// NOLINTEND(readability-identifier-naming)
