// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Memory that runs out on command: failing_allocation.cpp replaces operator new, and calloc by a
// linker's option, in the whole program.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <new>
#include <optional>

namespace rondel::test {

// Blocks of operator new and calloc that are not freed yet.
std::size_t blocks_in_use();

enum class Shortage { of_one_block, from_there_on };

// While it lives, the n-th allocation fails (from 1), or that one and all after it.
class FailingAllocation {
 public:
  FailingAllocation(std::size_t n, Shortage shortage);
  ~FailingAllocation() { stop(); }
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;

  // Ends it early. Whether an allocation has failed.
  bool stop();
};

// Every one of the first allocations, then some: a build with exact arithmetic makes thousands.
inline std::size_t next_to_fail(std::size_t n) { return n + 1 + n / 128; }

// Runs attempt(n, shortage) with n = 1, 2, ... until no allocation fails any more. It makes one
// FailingAllocation and returns what stop() told. Whatever fails, all memory must come back.
template <class Attempt>
void fail_each_allocation(const Attempt& attempt) {
  for (const Shortage shortage : {Shortage::of_one_block, Shortage::from_there_on}) {
    bool has_failed = true;
    for (std::size_t n = 1; has_failed; n = next_to_fail(n)) {
      const std::size_t before = blocks_in_use();
      has_failed = attempt(n, shortage);
      ASSERT_FALSE(testing::Test::HasFailure()) << "allocation " << n;
      ASSERT_EQ(blocks_in_use(), before) << "allocation " << n << " failed, and some were lost";
    }
  }
}

// For work without a lasting effect: it gives its result, or throws std::bad_alloc.
template <class Work>
void expect_result_or_bad_alloc(const Work& work) {
  const auto expected = work();
  fail_each_allocation([&](std::size_t n, Shortage shortage) {
    std::optional<decltype(work())> result;
    FailingAllocation failing(n, shortage);
    try {
      result = work();
    } catch (const std::bad_alloc&) {  // as it should be
    }
    const bool has_failed = failing.stop();
    EXPECT_TRUE(has_failed || result) << "threw without a reason";
    if (result) {
      EXPECT_TRUE(*result == expected);
    }
    return has_failed;
  });
}

}  // namespace rondel::test
