// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a std::lock_guard locks. Where a program cannot have more than one thread (WebAssembly
// without shared memory) the standard library may have no mutex, and there is nothing to lock. GCC for
// Windows with that system's own threads has none either: only one thread may use the library there.
// RONDEL_PARALLEL=OFF is something else: the library starts no threads then, but its user may.
#pragma once

#include <mutex>

namespace rondel::system {

#if defined(__STDCPP_THREADS__) && (!defined(__GLIBCXX__) || defined(_GLIBCXX_HAS_GTHREADS))

using Mutex = std::mutex;

#else

class Mutex {
 public:
  void lock() noexcept {}
  void unlock() noexcept {}
};

#endif

}  // namespace rondel::system
