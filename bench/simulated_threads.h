// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Stands for the library's threads (system/parallel.h) in a program that is linked with
// simulated_threads.cpp: the pieces of a call run one after the other, in one thread, and each is timed.
// The library calls what it would call with as many threads as are asked for, on a machine with any
// number of cores. What is written down says which work threads would share, and which they would wait for.
#pragma once

#include <cstddef>
#include <vector>

namespace rondel::bench {

// A call of parallel_for() or parallel_invoke() with more than one piece, made by no other piece.
struct SharedWork {
  double alone = 0;  // seconds since the last such call, of the one thread that makes them
  std::size_t num_pieces = 0;
  double seconds = 0;  // of all pieces
  double longest = 0;  // of one piece; what it shares in turn is divided by the threads
};

// Processor time of the program, but for what the ledger itself takes.
struct ThreadsLedger {
  std::vector<SharedWork> shared;
  double alone = 0;  // after the last one
};

// Forgets what was written down. From here on calls count as those of so many threads.
void start_threads_ledger();
// Returns what was done since then.
ThreadsLedger end_threads_ledger();

}  // namespace rondel::bench
