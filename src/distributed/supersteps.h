// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Work and communication in turns, so that what one rank throws all ranks throw.
//
//     rank 0   work --.       .-- work --.       .--
//     rank 1   work ---\     /--- work -X \     /---   throws
//     rank 2   work ---- all gather ------- all gather  throw the same
//
// Each superstep opens with an all-gather, in which the first byte of a message says how its sender is.
// Whatever a rank throws between two of them takes it to the next one, wherever the others are.
//
// in    the work of a rank, which calls all_gather() and exchange()
// out   what the others sent, or the same exception everywhere
#pragma once

#include <cstddef>
#include <vector>

#include "distributed/messages.h"
#include "rondel/distributed.h"

namespace rondel::distributed {

class Supersteps {
 public:
  explicit Supersteps(Communicator& ranks) noexcept;

  [[nodiscard]] std::size_t rank() const { return rank_; }
  [[nodiscard]] std::size_t size() const { return size_; }

  // Calls work(), in which everything below is called, and all others with theirs.
  template <class Work>
  auto run(Work work) {
    try {
      reserve_failure();
      auto result = work();
      all_gather({});
      return result;
    } catch (...) {
      if (!is_heard_) tell_failure();
      throw;
    }
  }

  // What comes now. Also a place to stop at.
  void begin(const char* phase);
  // `mine` is what a writer wrote, or empty.
  std::vector<Bytes> all_gather(Bytes mine);
  std::vector<Bytes> exchange(std::vector<Bytes> messages);

 private:
  void reserve_failure();
  void tell_failure();
  void describe_failure() noexcept;
  // Throws what a rank tells.
  void listen(const std::vector<Bytes>& received);

  Communicator& ranks_;
  std::size_t rank_;
  std::size_t size_;
  const char* phase_ = "begin";
  Bytes failure_;          // with memory that is there when there is no more
  bool is_heard_ = false;  // no rank waits for this one any more
};

}  // namespace rondel::distributed
