// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// All that the library knows of threads. What is promised:
// 1. `threads` is an upper bound on the threads that work on one call, the caller among them; 0
//    means one for each core. With 1, and in a build without threads, the caller does everything,
//    in order. The pool of threads is oneTBB's; without oneTBB a call starts and ends its own.
// 2. What is called, and with which arguments, does not depend on `threads`. So results do not
//    either, if the calls write to disjoint places.
// 3. A call returns when all of its work has ended, and has seen all that it wrote.
// 4. One of the exceptions of the work is rethrown, when nothing of the call runs any more. Pieces
//    that had not begun by then may be left out.
// 5. Calls may be nested and made by any thread. A nested call shares the threads of the outer one.
//    While a thread waits it may run other pieces of an outer call, so hold no lock over a call,
//    and expect nothing of thread_local values behind it.
// 6. Every piece has an ArithmeticScope: no piece sees how its thread rounds elsewhere.
// 7. Where the flag of a StopScope is true, a call throws Interrupted instead of beginning another
//    piece. It costs 0.15 ns a piece; a build of 2^20 sites has 376 of them.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

#include "rondel/export.h"

namespace rondel::system {

// RONDEL_API marks what rondel::geo and rondel::distributed use; it is promised to nobody else.

// How many threads a bound stands for: itself, but no more than 1024; for 0 the number of cores;
// 1 without threads.
RONDEL_API unsigned num_threads(unsigned threads);

// How many pieces parallel_for makes.
constexpr std::size_t num_pieces(std::size_t count, std::size_t grain) {
  return count / grain + (count % grain != 0 ? 1 : 0);
}

// Calls piece(begin, end) for the pieces [0, grain), [grain, 2 grain), ... of [0, count); the last
// one ends at `count`, and none is empty. begin / grain numbers them. A piece should take 10
// microseconds or more.
RONDEL_API void parallel_for(unsigned threads, std::size_t count, std::size_t grain,
                             const std::function<void(std::size_t begin, std::size_t end)>& piece);

// Calls both functions, at once if it can. A call costs a few tenths of a microsecond: recurse
// through it as long as the work is much longer.
RONDEL_API void parallel_invoke(unsigned threads, const std::function<void()>& first,
                                const std::function<void()>& second);

// Throws Interrupted if the flag of the calling thread's scope is true.
RONDEL_API void obey_stop();

// While it lives, calls that its thread makes obey the flag, wherever their pieces run; and no
// other flag. Scopes are nested.
class RONDEL_API StopScope {
 public:
  explicit StopScope(const std::atomic<bool>* stop) noexcept;
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  const std::atomic<bool>* before_;
};

}  // namespace rondel::system
