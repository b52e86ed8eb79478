// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "run_pieces.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace rondel::cli {

unsigned num_workers(unsigned threads) {
  return threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
}

void run_pieces(unsigned threads, int count, const std::function<void(int)>& work) {
  // The number of the next piece; threads take pieces until there are none, or one has failed.
  std::atomic<int> next = 0;
  std::exception_ptr error;
  std::mutex mutex;
  const auto run = [&] {
    try {
      for (int k = next.fetch_add(1); k < count; k = next.fetch_add(1)) work(k);
    } catch (...) {
      const std::lock_guard lock(mutex);
      error = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> helpers;
  try {
    while (helpers.size() + 1 < threads && static_cast<int>(helpers.size()) + 1 < count) {
      helpers.emplace_back(run);
    }
  } catch (const std::exception&) {
    // There is no memory for another thread; the existing ones suffice.
  }
  run();
  for (std::thread& helper : helpers) helper.join();
  if (error) std::rethrow_exception(error);
}

}  // namespace rondel::cli
