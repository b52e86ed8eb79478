// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a std::lock_guard locks. Where a program cannot have more than one thread (WebAssembly
// without shared memory) the standard library may have no mutex, and there is nothing to lock.
// RONDEL_PARALLEL=OFF is something else: the library starts no threads then, but its user may.
#pragma once

#include <mutex>

namespace rondel::system {

#if defined(__STDCPP_THREADS__)

using Mutex = std::mutex;

#else

class Mutex {
 public:
  void lock() noexcept {}
  void unlock() noexcept {}
};

#endif

}  // namespace rondel::system
