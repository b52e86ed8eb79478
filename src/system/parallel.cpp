// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "system/parallel.h"

#include <algorithm>

#include "rondel/error.h"
#include "system/arithmetic.h"

#if defined(RONDEL_HAS_TBB)
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>
#elif defined(RONDEL_HAS_THREADS)
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace rondel::system {
namespace {

// More than a machine has that the library was tried on; few enough for what is made for each.
constexpr unsigned max_threads = 1U << 10;

#if defined(RONDEL_HAS_TBB)

unsigned num_cores() { return static_cast<unsigned>(tbb::info::default_concurrency()); }

// Runs `work` where at most so many threads help: here, if the arena of the caller is no larger.
template <class Work>
void run_in_arena(unsigned threads, const Work& work) {
  const int limit = static_cast<int>(threads);
  if (tbb::this_task_arena::max_concurrency() <= limit) {
    work();
  } else {
    tbb::task_arena(limit).execute(work);
  }
}

template <class Run>
void run_pieces(unsigned threads, std::size_t pieces, const Run& run) {
  run_in_arena(threads, [&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, pieces),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t k = range.begin(); k != range.end(); ++k) run(k);
        },
        tbb::simple_partitioner());
  });
}

void run_both(unsigned threads, const std::function<void()>& first,
              const std::function<void()>& second) {
  run_in_arena(threads, [&] { tbb::parallel_invoke(first, second); });
}

constexpr bool has_threads = true;

#elif defined(RONDEL_HAS_THREADS)

unsigned num_cores() { return std::max(1U, std::thread::hardware_concurrency()); }

std::atomic<unsigned> num_helpers = 0;  // in all calls that run

// Helpers start with the call and end with it. What orders the pieces of different threads is
// nothing but their start and end, so that a sanitizer sees every race between them.
template <class Run>
void run_pieces(unsigned threads, std::size_t pieces, const Run& run) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr error;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (;;) {
        const std::size_t k = next.fetch_add(1, std::memory_order_relaxed);
        if (k >= pieces) return;
        run(k);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      error = std::current_exception();
      next.store(pieces, std::memory_order_relaxed);
    }
  };
  std::vector<std::thread> helpers;  // C++ libraries of LLVM before 20 have no std::jthread
  while (helpers.size() + 1 < std::min<std::size_t>(threads, pieces)) {
    if (num_helpers.fetch_add(1) + 1 >= threads) {
      --num_helpers;
      break;
    }
    try {
      helpers.emplace_back([&] {
        work();
        --num_helpers;
      });
    } catch (const std::exception&) {  // no memory for one more: those that are there suffice
      --num_helpers;
      break;
    }
  }
  work();
  for (std::thread& helper : helpers) helper.join();
  if (error) std::rethrow_exception(error);
}

void run_both(unsigned threads, const std::function<void()>& first,
              const std::function<void()>& second) {
  run_pieces(threads, 2, [&](std::size_t k) { k == 0 ? first() : second(); });
}

constexpr bool has_threads = true;

#else

unsigned num_cores() { return 1; }

template <class Run>
void run_pieces(unsigned, std::size_t, const Run&) {}

void run_both(unsigned, const std::function<void()>&, const std::function<void()>&) {}

constexpr bool has_threads = false;

#endif

// What the thread obeys.
thread_local const std::atomic<bool>* current_stop = nullptr;

// A piece of a call that obeys `stop`.
template <class Piece>
void run_piece(const std::atomic<bool>* stop, const Piece& piece) {
  const ArithmeticScope arithmetic;
  if (stop == nullptr && current_stop == nullptr) {
    piece();
    return;
  }
  const StopScope scope(stop);
  if (stop != nullptr && stop->load(std::memory_order_relaxed)) throw Interrupted();
  piece();
}

}  // namespace

void obey_stop() {
  if (current_stop != nullptr && current_stop->load(std::memory_order_relaxed)) throw Interrupted();
}

StopScope::StopScope(const std::atomic<bool>* stop) noexcept : before_(current_stop) {
  current_stop = stop;
}

StopScope::~StopScope() { current_stop = before_; }

unsigned num_threads(unsigned threads) {
  return threads != 0 && has_threads ? std::min(threads, max_threads) : num_cores();
}

void parallel_for(unsigned threads, std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& piece) {
  const std::size_t pieces = num_pieces(count, grain);
  const auto* const stop = current_stop;
  const auto run = [&](std::size_t k) {
    run_piece(stop, [&] { piece(k * grain, std::min(count, (k + 1) * grain)); });
  };
  threads = num_threads(threads);
  if (threads > 1 && pieces > 1) {
    run_pieces(threads, pieces, run);
  } else {
    for (std::size_t k = 0; k < pieces; ++k) run(k);
  }
}

void parallel_invoke(unsigned threads, const std::function<void()>& first,
                     const std::function<void()>& second) {
  threads = num_threads(threads);
  const auto* const stop = current_stop;
  const auto run_first = [&] { run_piece(stop, first); };
  const auto run_second = [&] { run_piece(stop, second); };
  if (threads > 1) {
    run_both(threads, run_first, run_second);
  } else {
    run_first();
    run_second();
  }
}

}  // namespace rondel::system
