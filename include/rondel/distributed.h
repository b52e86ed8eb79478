// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Triangulations by several processes, none of which ever has all sites (target rondel::distributed).
/// The faces are those of delaunay() of all sites, bit by bit, whatever the number of processes.
///
/// The processes are the ranks 0, 1, ... of a Communicator: of MPI (rondel/mpi.h), or of anything else
/// that has its two operations. All of them call the same functions in the same order.
///
///     rondel::MpiCommunicator ranks(MPI_COMM_WORLD);
///     const auto triangulation = rondel::delaunay(ranks, my_sites, {}, {}, {.threads = 1});
///     triangulation.visit_faces([&](std::span<const rondel::GlobalTriple> faces) { ... });
///
/// Each rank gets a run of squares of the sphere with about as many sites as every other one,
/// triangulates it by itself, and what it cannot decide alone, together some 11 sqrt(n P) of n uniform
/// sites on P ranks, is joined by rank 0 (docs/theory/blocks.md, "A tree of seams").
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

/// Some processes, or threads, that work together.
///
/// 1. Every rank makes the same calls in the same order; a call returns when this rank has what the
///    others sent. Messages may have any size, none too, in any call and from any rank.
/// 2. A call that throws has failed for good: calls that the other ranks make then, or are in, throw as
///    well or end the process. Nobody uses the communicator after that.
/// 3. One thread of a rank calls, the one that was given the communicator.
class RONDEL_API Communicator {
 public:
  using Bytes = std::vector<std::byte>;

  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  virtual ~Communicator();

  /// Which one this is: 0 ... size() - 1.
  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int size() const = 0;

  /// What every rank gave, by rank.
  virtual std::vector<Bytes> all_gather(Bytes mine) = 0;
  /// Gives messages[r] to rank r, also to this one itself; returns what each rank gave to this one.
  /// \pre there are size() messages
  virtual std::vector<Bytes> exchange(std::vector<Bytes> messages) = 0;

  /// Told by the library before the work that leads to the next call: "count", "deal", "triangulate",
  /// "join", "number", "finish"; "areas". For those who measure; does nothing here. What it throws ends all
  /// ranks.
  virtual void begin(std::string_view phase);
};

/// What one rank could not do; all ranks throw it, with one and the same line:
/// "rank 2, triangulate: std::bad_alloc".
class RONDEL_API DistributedError : public std::runtime_error {
 public:
  DistributedError(int rank, const std::string& phase, const std::string& text);
  DistributedError(const DistributedError&) = default;
  DistributedError& operator=(const DistributedError&) = default;
  ~DistributedError() override;

  /// The lowest one of those that failed.
  [[nodiscard]] int rank() const noexcept { return rank_; }

 private:
  int rank_;
};

/// Corners or neighbors of a face, counted through all ranks.
using GlobalTriple = std::array<std::uint64_t, 3>;

/// A site in the same place as another site.
struct GlobalDuplicate {
  std::uint64_t site = 0;
  std::uint64_t representative = 0;  ///< the lowest index in that place
  friend bool operator==(const GlobalDuplicate&, const GlobalDuplicate&) = default;
};

/// How the work is divided, and what is kept. No result depends on it.
struct DistributedOptions {
  /// At most so many sites are triangulated at once, where squares of 2^-28 of a face of the cube have
  /// no more; a rank has several squares then.
  std::uint64_t most_bucket_sites = std::uint64_t{1} << 28;
  /// At most so many sites are sent at once by each rank.
  std::uint64_t most_dealt_sites = std::uint64_t{1} << 21;
  /// Each rank keeps the points of the sites in its squares and around them, 24 bytes each, for areas()
  /// and visit_circumcenters().
  bool keep_points = false;
};

/// The results of delaunay_file(), .npy files on a disk that all ranks see. They appear complete, when
/// all ranks are done, or not at all. Numbers of sites and faces are uint32 while all of them fit, and
/// int64 otherwise.
struct DistributedFiles {
  std::string faces;         ///< (m, 3): input indices, counterclockwise, as Triangulation::faces()
  std::string neighbors{};   ///< (m, 3): faces, opposite to each corner; empty: not written
  std::string duplicates{};  ///< (k, 2): site and representative, by site; empty: not written
  std::string areas{};       ///< (n,) float64: those of the cells, as areas(); empty: not written
  std::string circumcenters{};  ///< (m, 3) float64: those of the faces; empty: not written
  bool radians = false;         ///< longitudes and latitudes of the input are in radians
};

/// The triangulation, of which each rank has its part: consecutive faces, those of rank r behind those
/// of rank r - 1. Sites have the indices of all input, that of rank r behind that of rank r - 1.
/// Immutable; copies share everything.
class RONDEL_API DistributedTriangulation {
 public:
  /// Of all ranks, as the functions of Triangulation of these names.
  [[nodiscard]] int dimension() const noexcept;
  [[nodiscard]] std::uint64_t num_sites() const noexcept;
  [[nodiscard]] std::uint64_t num_vertices() const noexcept;
  [[nodiscard]] std::uint64_t num_faces() const noexcept;
  [[nodiscard]] std::uint64_t num_ghost_faces() const noexcept;
  [[nodiscard]] std::uint64_t num_duplicates() const noexcept;
  [[nodiscard]] std::uint64_t num_hidden() const noexcept;
  /// Sites that no rank could decide alone: those that rank 0 joined.
  [[nodiscard]] std::uint64_t num_open_sites() const noexcept;

  /// The number of this rank's first face among all, and how many it has.
  [[nodiscard]] std::uint64_t first_face() const noexcept;
  [[nodiscard]] std::uint64_t num_own_faces() const noexcept;
  /// Shows the corners of this rank's faces, in order, some at a time.
  void visit_faces(const std::function<void(std::span<const GlobalTriple>)>& visit) const;
  /// Shows the faces across their edges, opposite to each corner.
  void visit_neighbors(const std::function<void(std::span<const GlobalTriple>)>& visit) const;
  /// Shows the circumcenters of this rank's faces, those of circumcenters() in every bit. A matter of this
  /// rank alone.
  /// \throws InvalidInput if the points were not kept
  void visit_circumcenters(const std::function<void(std::span<const Point>)>& visit,
                           const Execution& execution = {}) const;
  /// Those of this rank's faces that are ghost faces, increasing.
  [[nodiscard]] std::span<const std::uint64_t> ghost_faces() const noexcept;

  /// The sites in this rank's squares, in the spatial order; of those in one place the lowest. All their
  /// faces are this rank's or have another corner here that is.
  [[nodiscard]] std::span<const std::uint64_t> owned_sites() const noexcept;

  /// Below dimension 2, on rank 0, else empty: as Triangulation::ring().
  [[nodiscard]] std::span<const std::uint64_t> ring() const noexcept;

  /// Of the sites that this rank gave, in increasing order of site; so the lists of all ranks, one
  /// behind the other, are in order.
  [[nodiscard]] std::span<const GlobalDuplicate> duplicates() const noexcept;
  /// Of the sites that this rank gave, increasing.
  [[nodiscard]] std::span<const std::uint64_t> hidden() const noexcept;

  struct Impl;
  /// For the library itself.
  explicit DistributedTriangulation(std::shared_ptr<const Impl> impl) noexcept;

 private:
  std::shared_ptr<const Impl> impl_;
};

/// The triangulation of the sites of all ranks, `mine` being those of this one; any rank may have none.
/// All ranks call it together, with the same options. The threads of an Execution are those of one
/// rank: where several are on one machine they share its cores.
/// \throws DistributedError on all ranks: what delaunay() would throw because of a site or an option, or
///         because memory is short on one rank
/// \throws Interrupted on all ranks, if the flag of one of them is set
RONDEL_API DistributedTriangulation delaunay(Communicator& ranks, std::span<const Point> mine,
                                             const DistributedOptions& distributed = {},
                                             const Options& options = {},
                                             const Execution& execution = {});

/// The areas of the cells of the sites that this rank gave, those of areas() in every bit: 0 for duplicates
/// and hidden sites. All ranks call it together; each one finds those of its own squares and sends them to
/// the ranks that gave the sites, 16 bytes each.
/// \throws DistributedError on all ranks: also if the points were not kept
/// \throws Interrupted on all ranks, if the flag of one of them is set
RONDEL_API std::vector<double> areas(Communicator& ranks,
                                     const DistributedTriangulation& triangulation,
                                     const Execution& execution = {});

/// As delaunay() above, of the sites of a .npy file, (n, 3) points or (n, 2) longitudes and latitudes in degrees, of
/// any type of numbers, of which each rank reads its share, as it writes its share of the results.
/// Until all is written a file is called ".rondel-N-M.tmp", in the directory of the result.
/// \throws DistributedError on all ranks: also what a file or its rows have that is not valid
RONDEL_API DistributedTriangulation delaunay_file(Communicator& ranks, const std::string& sites,
                                                  const DistributedFiles& files,
                                                  const DistributedOptions& distributed = {},
                                                  const Options& options = {},
                                                  const Execution& execution = {});

}  // namespace rondel
