// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The ranks of MPI for rondel/distributed.h. All code is in this header, so that it is compiled
/// with the MPI of the program that includes it, and the library itself does not depend on MPI.
///
///     MPI_Init(&argc, &argv);
///     {
///       rondel::MpiCommunicator ranks(MPI_COMM_WORLD);
///       const auto triangulation = rondel::delaunay(ranks, my_sites, {}, {}, {.threads = 1});
///     }
///     MPI_Finalize();
///
/// MPI 3 suffices: messages of any size are sent in pieces, whose sizes fit the 31-bit counts of
/// MPI.
#pragma once

// Keeps the C++ bindings that MPI once had out of the header.
#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1  // NOLINT(readability-identifier-naming)
#endif
#ifndef MPICH_SKIP_MPICXX
#define MPICH_SKIP_MPICXX 1  // NOLINT(readability-identifier-naming)
#endif
#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "rondel/distributed.h"

namespace rondel {

/// The ranks of an MPI communicator, of which it makes a copy, so that its messages are separate
/// from those of the program. An error of MPI ends all processes (MPI_ERRORS_ARE_FATAL). If one
/// rank lacks memory for the messages that it is to receive, the call throws on all ranks.
/// \pre MPI is initialized, all ranks construct it together, and it is destroyed before
///         MPI_Finalize().
class MpiCommunicator final : public Communicator {
 public:
  /// Sends or receives at most `max_bytes` in one piece; tests set it.
  explicit MpiCommunicator(MPI_Comm ranks, std::size_t max_bytes = std::size_t{1} << 30)
      : max_bytes_(max_bytes) {
    MPI_Comm_dup(ranks, &ranks_);
    MPI_Comm_set_errhandler(ranks_, MPI_ERRORS_ARE_FATAL);
    MPI_Comm_rank(ranks_, &rank_);
    MPI_Comm_size(ranks_, &size_);
  }
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;
  ~MpiCommunicator() override { MPI_Comm_free(&ranks_); }

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }

  std::vector<Bytes> all_gather(Bytes mine) override {
    const auto num_ranks = static_cast<std::size_t>(size_);
    const std::uint64_t own_size = mine.size();
    std::vector<std::uint64_t> sizes;
    std::vector<Bytes> received;
    std::vector<int> counts;
    std::vector<int> places;
    Bytes pieces;
    agree([&] {
      sizes.resize(num_ranks);
      received.resize(num_ranks);
      counts.resize(num_ranks);
      places.resize(num_ranks);
    });
    MPI_Allgather(&own_size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, ranks_);
    const std::uint64_t longest = *std::max_element(sizes.begin(), sizes.end());
    if (longest == 0) return received;
    // The pieces of all ranks are received into one array.
    const std::uint64_t most = std::max<std::uint64_t>(max_bytes_ / num_ranks, 1);
    agree([&] {
      for (std::size_t r = 0; r < num_ranks; ++r) received[r].resize(sizes[r]);
      pieces.resize(std::accumulate(
          sizes.begin(), sizes.end(), std::uint64_t{0},
          [&](std::uint64_t sum, std::uint64_t size) { return sum + std::min(size, most); }));
    });
    for (std::uint64_t begin = 0; begin < longest; begin += most) {
      int place = 0;
      for (std::size_t r = 0; r < num_ranks; ++r) {
        counts[r] = static_cast<int>(std::min(sizes[r] - std::min(sizes[r], begin), most));
        places[r] = place;
        place += counts[r];
      }
      const int own_count = counts[static_cast<std::size_t>(rank_)];
      MPI_Allgatherv(own_count == 0 ? nullptr : &mine[begin], own_count, MPI_BYTE, pieces.data(),
                     counts.data(), places.data(), MPI_BYTE, ranks_);
      for (std::size_t r = 0; r < num_ranks; ++r) {
        if (counts[r] == 0) continue;
        std::copy_n(pieces.begin() + places[r], counts[r],
                    received[r].begin() + static_cast<std::ptrdiff_t>(begin));
      }
    }
    return received;
  }

  std::vector<Bytes> exchange(std::vector<Bytes> messages) override {
    const auto num_ranks = static_cast<std::size_t>(size_);
    const auto self = static_cast<std::size_t>(rank_);
    std::vector<std::uint64_t> sizes;  // the sizes to send, then those to receive
    std::vector<Bytes> received;
    std::vector<MPI_Request> requests;
    agree([&] {
      sizes.resize(2 * num_ranks);
      received.resize(num_ranks);
    });
    for (std::size_t r = 0; r < num_ranks; ++r) sizes[r] = r == self ? 0 : messages[r].size();
    MPI_Alltoall(sizes.data(), 1, MPI_UINT64_T, sizes.data() + num_ranks, 1, MPI_UINT64_T, ranks_);
    agree([&] {
      std::uint64_t num_pieces = 0;
      for (const std::uint64_t size : sizes) num_pieces += (size + max_bytes_ - 1) / max_bytes_;
      requests.reserve(num_pieces);
      for (std::size_t r = 0; r < num_ranks; ++r) received[r].resize(sizes[num_ranks + r]);
    });
    for (std::size_t r = 0; r < num_ranks; ++r) {
      for_pieces(received[r], [&](std::byte* piece, int size) {
        MPI_Irecv(piece, size, MPI_BYTE, static_cast<int>(r), 0, ranks_, &requests.emplace_back());
      });
    }
    received[self] = std::move(messages[self]);
    for (std::size_t i = 1; i < num_ranks; ++i) {
      // So that not all ranks send to the same one at once.
      const std::size_t r = (self + i) % num_ranks;
      for_pieces(messages[r], [&](std::byte* piece, int size) {
        MPI_Isend(piece, size, MPI_BYTE, static_cast<int>(r), 0, ranks_, &requests.emplace_back());
      });
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return received;
  }

 private:
  // Throws on all ranks if one of them cannot allocate its memory.
  template <class Allocate>
  void agree(Allocate allocate) {
    int is_done = 1;
    try {
      allocate();
    } catch (const std::exception&) {
      is_done = 0;
    }
    int are_all_done = 0;
    MPI_Allreduce(&is_done, &are_all_done, 1, MPI_INT, MPI_MIN, ranks_);
    if (is_done == 0) throw std::bad_alloc();
    if (are_all_done == 0) throw std::runtime_error("not enough memory on another rank");
  }

  template <class Visit>
  void for_pieces(Bytes& bytes, Visit visit) const {
    for (std::size_t begin = 0; begin < bytes.size(); begin += max_bytes_)
      visit(&bytes[begin], static_cast<int>(std::min(max_bytes_, bytes.size() - begin)));
  }

  MPI_Comm ranks_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
  std::size_t max_bytes_;
};

}  // namespace rondel
