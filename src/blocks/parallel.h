// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A parallel loop whose result does not depend on the number of threads, as long as the
// calls write to disjoint places.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace rondel::blocks {

// Calls fn(first, last) for consecutive ranges that cover [begin, end), one
// for each thread; 0 threads: one for each core. Rethrows the first exception.
inline void parallel_for(std::size_t begin, std::size_t end, unsigned threads,
                         const std::function<void(std::size_t, std::size_t)>& fn) {
  // Below this a thread costs more than it saves.
  constexpr std::size_t smallest_range = 4096;
  const std::size_t size = end - begin;
  const std::size_t wanted = threads != 0 ? threads : std::thread::hardware_concurrency();
  const std::size_t count =
      std::clamp<std::size_t>(size / smallest_range, 1, std::max<std::size_t>(wanted, 1));
  if (count == 1) {
    fn(begin, end);
    return;
  }
  std::vector<std::exception_ptr> errors(count);
  {
    std::vector<std::jthread> workers;
    workers.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
      workers.emplace_back([&, k] {
        try {
          fn(begin + size * k / count, begin + size * (k + 1) / count);
        } catch (...) {
          errors[k] = std::current_exception();
        }
      });
    }
  }
  for (const auto& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace rondel::blocks
