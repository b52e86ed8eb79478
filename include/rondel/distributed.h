// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Triangulations by several processes, none of which ever has all sites (target
/// rondel::distributed). The faces are those of delaunay() for all sites, bit by bit, whatever the
/// number of processes.
///
/// The processes are the ranks 0, 1, ... of a Communicator: that of MPI (rondel/mpi.h), or any
/// other class with the same two operations. All ranks call the same functions in the same order.
///
///     rondel::MpiCommunicator ranks(MPI_COMM_WORLD);
///     const auto triangulation = rondel::delaunay(ranks, my_sites, {}, {}, {.threads = 1});
///     triangulation.visit_faces([&](std::span<const rondel::GlobalTriple> faces) { ... });
///
/// Each rank gets consecutive squares of the sphere with about as many sites as every other rank
/// has, and triangulates them alone. The sites whose faces it cannot decide, together some 11
/// sqrt(n P) of n uniform sites on P ranks, are joined by rank 0 (docs/theory/blocks.md, "A tree of
/// seams").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel {

/// Processes, or threads, that work together.
///
/// 1. Every rank makes the same calls in the same order. A call returns when this rank has the
///    messages that the others sent to it. Messages may have any size, 0 included, in any call and
///    from any rank.
/// 2. A call that throws has failed for good: the calls that the other ranks are in, or make later,
///    throw as well or end the process. Nobody uses the communicator after that.
/// 3. Only one thread of a rank makes calls, the one that was given the communicator.
class RONDEL_API Communicator {
 public:
  using Bytes = std::vector<std::byte>;

  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  virtual ~Communicator();

  /// Returns the number of this rank: 0 ... size() - 1.
  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int size() const = 0;

  /// Gives `mine` to all ranks; returns what every rank gave, by rank.
  virtual std::vector<Bytes> all_gather(Bytes mine) = 0;
  /// Gives messages[r] to each rank r, this rank included; returns what each rank gave to this one,
  /// by rank.
  /// \pre There are size() messages.
  virtual std::vector<Bytes> exchange(std::vector<Bytes> messages) = 0;

  /// Is called by the library before the work that leads to the next call, with its phase: "count",
  /// "scatter", "triangulate", "join", "number", "finish"; "areas". It is meant for measurements;
  /// the default does nothing. An exception ends the work of all ranks.
  virtual void begin(std::string_view phase);
};

/// A failure of one rank. All ranks throw it, with the same line: "rank 2, triangulate:
/// std::bad_alloc".
class RONDEL_API DistributedError : public std::runtime_error {
 public:
  DistributedError(int rank, const std::string& phase, const std::string& text);
  DistributedError(const DistributedError&) = default;
  DistributedError& operator=(const DistributedError&) = default;
  ~DistributedError() override;

  /// Returns the lowest rank that failed.
  [[nodiscard]] int rank() const noexcept { return rank_; }

 private:
  int rank_;
};

/// The corners or neighbors of a face, as indices that count through all ranks.
using GlobalTriple = std::array<std::uint64_t, 3>;

/// A site in the same place as another site.
struct GlobalDuplicate {
  std::uint64_t site = 0;
  std::uint64_t representative = 0;  ///< the lowest index in that place
  friend bool operator==(const GlobalDuplicate&, const GlobalDuplicate&) = default;
};

/// How the work is divided, and what is kept. The triangulation does not depend on it.
struct DistributedOptions {
  /// The number of sites that are triangulated at once at most, unless a square of 2^-28 of a face
  /// of the cube has more; a rank may have several squares.
  std::uint64_t max_bucket_sites = std::uint64_t{1} << 28;
  /// The number of sites that each rank sends at once at most.
  std::uint64_t max_scattered_sites = std::uint64_t{1} << 21;
  /// Whether each rank keeps the points of the sites in its squares and around them, 24 bytes each,
  /// for areas() and visit_circumcenters().
  bool keep_points = false;
};

/// The results of delaunay_file(): .npy files on a disk that all ranks see. They appear complete,
/// when all ranks are done, or not at all. Indices of sites and faces are uint32 if all of them
/// fit, and int64 otherwise.
struct DistributedFiles {
  std::string faces;         ///< (m, 3): input indices, counterclockwise, as Triangulation::faces()
  std::string neighbors{};   ///< (m, 3): faces, opposite to each corner; empty: not written
  std::string duplicates{};  ///< (k, 2): site and representative, by site; empty: not written
  std::string areas{};       ///< (n,) float64: areas of cells, as areas(); empty: not written
  std::string circumcenters{};  ///< (m, 3) float64: circumcenters of faces; empty: not written
  bool radians = false;         ///< longitudes and latitudes of the input are in radians
};

/// A triangulation of which each rank has its part: consecutive faces, those of rank r after those
/// of rank r - 1. Sites have indices in the whole input, those of rank r after those of rank r - 1.
/// The triangulation is immutable; copies share the memory.
class RONDEL_API DistributedTriangulation {
 public:
  /// Numbers of all ranks together, with the meaning that they have in Triangulation.
  [[nodiscard]] int dimension() const noexcept;
  [[nodiscard]] std::uint64_t num_sites() const noexcept;
  [[nodiscard]] std::uint64_t num_vertices() const noexcept;
  [[nodiscard]] std::uint64_t num_faces() const noexcept;
  [[nodiscard]] std::uint64_t num_ghost_faces() const noexcept;
  [[nodiscard]] std::uint64_t num_duplicates() const noexcept;
  [[nodiscard]] std::uint64_t num_hidden() const noexcept;
  /// Returns the number of sites that no rank could decide alone, which rank 0 joined.
  [[nodiscard]] std::uint64_t num_open_sites() const noexcept;

  /// Returns the index of this rank's first face.
  [[nodiscard]] std::uint64_t first_face() const noexcept;
  /// Returns the number of this rank's faces.
  [[nodiscard]] std::uint64_t num_own_faces() const noexcept;
  /// Calls visit() with the corners of this rank's faces, in order, some at a time.
  void visit_faces(const std::function<void(std::span<const GlobalTriple>)>& visit) const;
  /// Calls visit() with the neighbors of this rank's faces, opposite to each corner.
  void visit_neighbors(const std::function<void(std::span<const GlobalTriple>)>& visit) const;
  /// Calls visit() with the circumcenters of this rank's faces, the same bits as circumcenters().
  /// Only this rank has to call it.
  /// \throws InvalidInput if the points were not kept
  void visit_circumcenters(const std::function<void(std::span<const Point>)>& visit,
                           const Execution& execution = {}) const;
  /// Returns the ghost faces among this rank's faces, ascending.
  [[nodiscard]] std::span<const std::uint64_t> ghost_faces() const noexcept;

  /// Returns the sites in this rank's squares, in spatial order; of several in one place the lowest
  /// index. Each face of such a site is this rank's, or has another corner here that is in this
  /// rank's squares.
  [[nodiscard]] std::span<const std::uint64_t> owned_sites() const noexcept;

  /// Returns Triangulation::ring() on rank 0 below dimension 2; it is empty on other ranks and in
  /// dimension 2.
  [[nodiscard]] std::span<const std::uint64_t> ring() const noexcept;

  /// Returns the duplicates among the sites that this rank gave, ascending by site, so that the
  /// lists of all ranks, one after the other, are in order.
  [[nodiscard]] std::span<const GlobalDuplicate> duplicates() const noexcept;
  /// Returns the hidden sites among those that this rank gave, ascending.
  [[nodiscard]] std::span<const std::uint64_t> hidden() const noexcept;

  struct Impl;
  /// For the library itself.
  explicit DistributedTriangulation(std::shared_ptr<const Impl> impl) noexcept;

 private:
  std::shared_ptr<const Impl> impl_;
};

/// Computes the triangulation of the sites of all ranks. All ranks call it together, with the same
/// options.
/// \param mine  the sites of this rank; any rank may have none
/// \param execution  the threads are those of one rank: ranks on one machine share its cores
/// \throws DistributedError on all ranks: what delaunay() would throw because of a site or an
///         option, or because memory is short on one rank
/// \throws Interrupted on all ranks, if the flag of one of them is set
RONDEL_API DistributedTriangulation delaunay(Communicator& ranks, std::span<const Point> mine,
                                             const DistributedOptions& distributed = {},
                                             const Options& options = {},
                                             const Execution& execution = {});

/// Computes the areas of the cells of the sites that this rank gave, the same bits as areas(): 0
/// for duplicates and hidden sites. All ranks call it together; each one computes those of its own
/// squares and sends them to the ranks that gave the sites, 16 bytes each.
/// \throws DistributedError on all ranks: also if the points were not kept
/// \throws Interrupted on all ranks, if the flag of one of them is set
RONDEL_API std::vector<double> areas(Communicator& ranks,
                                     const DistributedTriangulation& triangulation,
                                     const Execution& execution = {});

/// Computes the triangulation of the sites of a file. Each rank reads its share, and writes its
/// share of the results. Until all is written, a file is called ".rondel-N-M.tmp" and is in the
/// directory of the result.
/// \param sites  a .npy file, (n, 3) points or (n, 2) longitudes and latitudes in degrees, with any
///               type of numbers
/// \throws DistributedError on all ranks: also for what is not valid in a file or its rows
RONDEL_API DistributedTriangulation delaunay_file(Communicator& ranks, const std::string& sites,
                                                  const DistributedFiles& files,
                                                  const DistributedOptions& distributed = {},
                                                  const Options& options = {},
                                                  const Execution& execution = {});

}  // namespace rondel
