// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "simulated_threads.h"

#include <algorithm>
#include <ctime>
#include <functional>
#include <tuple>
#include <utility>

#include "system/parallel.h"

namespace rondel::bench {
namespace {

double processor_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The work that runs now is that of a piece, or of the program.
struct Running {
  double since = 0;
  double seconds = 0;  // of all work in it
  double longest = 0;  // of the longest chain of work that waits for each other
  double alone = 0;    // since its last call

  void stop() {
    const double time = processor_seconds() - since;
    seconds += time;
    longest += time;
    alone += time;
  }
  void go_on() {
    alone = 0;
    since = processor_seconds();
  }
};

Running program;
Running* running = &program;
ThreadsLedger ledger;

template <class Run>
void run_pieces(unsigned threads, std::size_t num_pieces, const Run& run) {
  if (threads == 1 || num_pieces == 1) {
    for (std::size_t k = 0; k < num_pieces; ++k) run(k);
    return;
  }
  Running& caller = *running;
  caller.stop();
  SharedWork work{.alone = caller.alone, .num_pieces = num_pieces};
  for (std::size_t k = 0; k < num_pieces; ++k) {
    Running piece;
    running = &piece;
    piece.go_on();
    run(k);
    piece.stop();
    work.seconds += piece.seconds;
    work.longest = std::max(work.longest, piece.longest);
  }
  running = &caller;
  caller.seconds += work.seconds;
  caller.longest += std::max(work.longest, work.seconds / threads);
  if (&caller == &program) ledger.shared.push_back(work);
  caller.go_on();
}

}  // namespace

void start_threads_ledger() {
  ledger = {};
  program = {};
  program.go_on();
}

ThreadsLedger end_threads_ledger() {
  program.stop();
  ledger.alone = program.alone;
  return std::exchange(ledger, {});
}

}  // namespace rondel::bench

namespace rondel::system {

unsigned num_threads(unsigned threads) { return std::max(threads, 1U); }

void parallel_for(unsigned threads, std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& piece) {
  bench::run_pieces(threads, num_pieces(count, grain),
                    [&](std::size_t k) { piece(k * grain, std::min(count, (k + 1) * grain)); });
}

void parallel_invoke(unsigned threads, const std::function<void()>& first,
                     const std::function<void()>& second) {
  bench::run_pieces(threads, 2, [&](std::size_t k) { k == 0 ? first() : second(); });
}

// Nothing stops here.
void obey_stop() {}
StopScope::StopScope(const std::atomic<bool>* stop) noexcept : before_(stop) {}
StopScope::~StopScope() { std::ignore = before_; }

}  // namespace rondel::system
