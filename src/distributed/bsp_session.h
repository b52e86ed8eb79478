// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Alternates work and communication, so that an exception on one rank is thrown on all ranks.
//
//     rank 0   work --.       .-- work --.       .--
//     rank 1   work ---\     /--- work -X \     /---   throws
//     rank 2   work ---- all gather ------- all gather  throw the same
//
// Each superstep begins with an all-gather, in which the first byte of a message says whether its
// sender has failed. A rank that throws between two of them goes to the next one, wherever the
// others are.
//
// in    the work of a rank, which calls all_gather() and exchange()
// out   what the others sent, or the same exception everywhere
#pragma once

#include <cstddef>
#include <vector>

#include "distributed/messages.h"
#include "rondel/distributed.h"

namespace rondel::distributed {

// The communication of one rank with all others.
class BspSession {
 public:
  explicit BspSession(Communicator& ranks) noexcept;

  [[nodiscard]] std::size_t rank() const { return rank_; }
  [[nodiscard]] std::size_t size() const { return size_; }

  // Calls work(), in which all other functions are called; all ranks call run() together.
  template <class Work>
  auto run(Work work) {
    try {
      reserve_failure();
      auto result = work();
      all_gather({});
      return result;
    } catch (...) {
      if (!peers_notified_) broadcast_failure();
      throw;
    }
  }

  // Names the phase that begins, and checks whether the user has stopped the work.
  void begin(const char* phase);
  // Sends this rank's message to all, and returns the messages of all. `mine` comes from a
  // MessageWriter, or is empty.
  std::vector<Bytes> all_gather(Bytes mine);
  // Sends messages[r] to rank r, and returns the message of each rank to this one.
  std::vector<Bytes> exchange(std::vector<Bytes> messages);

 private:
  // Allocates the memory that reporting a failure needs.
  void reserve_failure();
  // Sends the exception that is being handled to all ranks.
  void broadcast_failure();
  // Writes that exception into failure_.
  void describe_failure() noexcept;
  // Throws the failure that a message reports.
  void rethrow_remote(const std::vector<Bytes>& received);

  Communicator& ranks_;
  std::size_t rank_;
  std::size_t size_;
  const char* phase_ = "begin";
  Bytes failure_;                // allocated before, so that running out of memory can be reported
  bool peers_notified_ = false;  // no other rank waits for this one
};

}  // namespace rondel::distributed
