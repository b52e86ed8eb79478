// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Ranks in one process, a thread each, of which one runs at a time: what each phase costs each rank in
// processor time and in bytes is then exact, whatever the machine has. And ranks that fail.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/distributed.h"

namespace rondel::test {

// Of one phase on one rank. Bytes that a rank sends to itself do not count.
struct PhaseCost {
  double cpu_seconds = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t num_calls = 0;
};

class SimulatedRanks {
 public:
  explicit SimulatedRanks(int size) : size_(size), costs_(static_cast<std::size_t>(size)) {}

  // Called before each call of a rank, and at the beginning of each phase, and may throw: then the
  // communicator has failed, or the work that is done there.
  std::function<void(int rank, std::uint64_t call)> on_call;
  std::function<void(int rank, std::string_view phase)> on_begin;

  // Calls work(communicator) on all ranks; returns what each threw, or nothing.
  std::vector<std::string> run(const std::function<void(Communicator&)>& work);

  // Of the last run, by rank and phase.
  [[nodiscard]] const std::vector<std::map<std::string, PhaseCost>>& costs() const {
    return costs_;
  }
  [[nodiscard]] std::uint64_t bytes_sent(std::string_view phase) const;
  [[nodiscard]] std::uint64_t bytes_sent() const;
  [[nodiscard]] double cpu_seconds() const;

 private:
  class Rank;
  using Bytes = Communicator::Bytes;

  // Gives messages[r] to each rank r; returns when all have given theirs.
  std::vector<Bytes> meet(std::size_t rank, std::vector<Bytes> messages);
  void leave();
  void take_turn(std::unique_lock<std::mutex>& lock);

  int size_;
  std::vector<std::map<std::string, PhaseCost>> costs_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_turn_taken_ = false;
  std::uint64_t num_meetings_ = 0;
  int num_there_ = 0;
  int num_gone_ = 0;
  std::vector<std::vector<Bytes>> given_;     // by the rank that gives
  std::vector<std::vector<Bytes>> received_;  // by the rank that gets
};

}  // namespace rondel::test
