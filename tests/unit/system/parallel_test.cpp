// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The promises of system/parallel.h, by their numbers.
#include "system/parallel.h"

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <vector>

#include "gtest/gtest.h"
#include "rondel/error.h"

namespace rondel::system {
namespace {

// Calls `work` in the scope of a flag.
template <class Work>
void call_interruptible(const std::atomic<bool>& stop, const Work& work) {
  const StopScope scope(&stop);
  work();
}

constexpr unsigned thread_counts[] = {0, 1, 2, 3, 7, 16};

TEST(parallel_for, cuts_the_range_into_the_same_pieces_for_any_number_of_threads) {
  for (const unsigned threads : thread_counts) {
    for (const std::size_t count : {0U, 1U, 99U, 100U, 101U, 1000U, 12345U}) {
      std::vector<std::size_t> ends(num_pieces(count, 100));
      std::vector<int> visits(count);
      parallel_for(threads, count, 100, [&](std::size_t begin, std::size_t end) {
        ends[begin / 100] = end;
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1));
      for (std::size_t k = 0; k < ends.size(); ++k) {
        EXPECT_EQ(ends[k], std::min((k + 1) * 100, count)) << threads << ' ' << count;
      }
    }
  }
}

TEST(parallel_for, does_everything_in_order_in_the_caller_with_one_thread) {
  std::vector<std::size_t> begins;
  const auto caller = std::this_thread::get_id();
  parallel_for(1, 10, 3, [&](std::size_t begin, std::size_t) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    begins.push_back(begin);
  });
  EXPECT_EQ(begins, (std::vector<std::size_t>{0, 3, 6, 9}));
}

TEST(parallel_for, never_uses_more_threads_than_allowed) {
  std::atomic<int> running = 0;
  std::atomic<int> most = 0;
  parallel_for(2, 200, 1, [&](std::size_t, std::size_t) {
    const int now = ++running;
    int seen = most;
    while (now > seen && !most.compare_exchange_weak(seen, now)) {
    }
    std::this_thread::yield();
    --running;
  });
  EXPECT_LE(most, 2);
}

TEST(parallel_for, begins_no_piece_when_its_flag_is_set) {
  for (const unsigned threads : thread_counts) {
    std::atomic<bool> stop = false;
    std::atomic<int> begun = 0;
    const auto count_pieces = [&] {
      parallel_for(threads, 1000, 1, [&](std::size_t i, std::size_t) {
        ++begun;
        if (i == 100) stop = true;
        parallel_for(threads, 10, 1, [&](std::size_t, std::size_t) {});
      });
    };
    EXPECT_THROW(call_interruptible(stop, count_pieces), Interrupted);
    EXPECT_GE(begun, 1);
    EXPECT_LT(begun, 1000);
    count_pieces();  // outside of the scope nobody obeys the flag
    EXPECT_GE(begun, 1001);
  }
}

TEST(parallel_for, obeys_the_innermost_flag) {
  const std::atomic<bool> stop = true;
  const std::atomic<bool> go = false;
  int pieces = 0;
  const auto work = [&] { parallel_for(1, 5, 1, [&](std::size_t, std::size_t) { ++pieces; }); };
  call_interruptible(go, [&] { EXPECT_THROW(call_interruptible(stop, work), Interrupted); });
  EXPECT_EQ(pieces, 0);
  EXPECT_NO_THROW(call_interruptible(stop, [&] { call_interruptible(go, work); }));
  EXPECT_EQ(pieces, 5);
}

TEST(parallel_invoke, calls_nothing_when_its_flag_is_set) {
  const std::atomic<bool> stop = true;
  for (const unsigned threads : thread_counts) {
    bool called = false;
    const auto call = [&] { called = true; };
    EXPECT_THROW(call_interruptible(stop, [&] { parallel_invoke(threads, call, call); }),
                 Interrupted);
    EXPECT_FALSE(called);
  }
}

TEST(parallel_for, rethrows_when_nothing_runs_any_more) {
  for (const unsigned threads : thread_counts) {
    std::atomic<int> running = 0;
    const auto fail = [&] {
      parallel_for(threads, 1000, 1, [&](std::size_t begin, std::size_t) {
        ++running;
        std::this_thread::yield();
        --running;
        if (begin % 10 == 7) throw std::out_of_range("seven");
      });
    };
    EXPECT_THROW(fail(), std::out_of_range);
    EXPECT_EQ(running, 0);
  }
}

std::uint64_t sum(unsigned threads, std::uint64_t first, std::uint64_t last) {
  if (last - first < 1000) {
    std::uint64_t result = 0;
    for (; first < last; ++first) result += first;
    return result;
  }
  const std::uint64_t middle = first + (last - first) / 2;
  std::uint64_t left = 0;
  std::uint64_t right = 0;
  parallel_invoke(
      threads, [&] { left = sum(threads, first, middle); },
      [&] { right = sum(threads, middle, last); });
  return left + right;
}

TEST(parallel_invoke, may_be_nested_with_loops_and_called_from_any_thread) {
  constexpr std::uint64_t n = 200000;
  for (const unsigned threads : thread_counts) {
    std::vector<std::uint64_t> sums(40);
    std::thread other([&] { EXPECT_EQ(sum(threads, 0, n), n * (n - 1) / 2); });
    parallel_for(threads, sums.size(), 3, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) sums[i] = sum(threads, 0, n);
    });
    other.join();
    EXPECT_EQ(sums, std::vector<std::uint64_t>(40, n * (n - 1) / 2));
  }
}

TEST(parallel_invoke, rethrows_from_either_function) {
  for (const unsigned threads : thread_counts) {
    const auto nothing = [] {};
    const auto fail = [] { throw std::length_error("end"); };
    EXPECT_THROW(parallel_invoke(threads, nothing, fail), std::length_error);
    EXPECT_THROW(parallel_invoke(threads, fail, nothing), std::length_error);
  }
}

}  // namespace
}  // namespace rondel::system
