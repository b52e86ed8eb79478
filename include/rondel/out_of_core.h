// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Triangulations that are larger than the memory (target rondel::distributed; POSIX and Windows):
/// from a file of sites to a file of faces, with temporary files in a scratch directory. The faces
/// are those of delaunay(), bit by bit, whatever the memory.
///
/// The sites are distributed to squares of the sphere that fit into memory, and each square is
/// triangulated alone. The sites whose faces no square can decide, some 5 sqrt(n) for each, are
/// joined at last (docs/theory/blocks.md, "A tree of seams"; the plan is that of Isenburg, Liu,
/// Shewchuk, Snoeyink: Streaming Computation of Delaunay Triangulations, SIGGRAPH 2006, with a
/// proof in place of a sweep).
#pragma once

#include <cstdint>
#include <string>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel {

/// The results: .npy files. They appear complete, when all is done, or not at all. Indices of sites
/// and faces are uint32 if all of them fit, and int64 otherwise.
struct OutOfCoreFiles {
  std::string faces;         ///< (m, 3): input indices, counterclockwise, as Triangulation::faces()
  std::string neighbors{};   ///< (m, 3): faces, opposite to each corner; empty: not written
  std::string areas{};       ///< (n,) float64: steradians, as areas(); empty: not written
  std::string duplicates{};  ///< (k, 2): site and representative, by site; empty: not written
  std::string ghost_faces{};  ///< (g,): faces, as Triangulation::ghost_faces(); empty: not written
};

/// The memory and the directory that delaunay_file() may use.
struct OutOfCoreOptions {
  /// The number of bytes that the process may have in memory, from the beginning to the end.
  std::uint64_t memory = std::uint64_t{2} << 30;
  /// A directory for some 64 bytes for each site, 88 with neighbors, 128 with areas. It is made if
  /// it does not exist.
  std::string scratch;
  /// Whether to continue the work that an interrupted run left in the scratch directory, if any.
  /// The results are the same.
  bool resume = false;
  bool radians = false;  ///< longitudes and latitudes of the input are in radians
};

/// The counts of the triangulation and of the work.
struct OutOfCoreReport {
  std::uint64_t num_sites = 0;
  std::uint64_t num_vertices = 0;
  std::uint64_t num_faces = 0;
  std::uint64_t num_ghost_faces = 0;
  std::uint64_t num_duplicates = 0;
  std::uint64_t num_hidden = 0;
  int dimension = -1;             ///< as Triangulation::dimension()
  std::uint64_t num_buckets = 0;  ///< squares that were triangulated one by one
  std::uint64_t num_resumed = 0;  ///< the squares among these that an earlier run had triangulated
  std::uint64_t num_open_sites = 0;  ///< sites that no square could decide alone
};

/// Computes the triangulation of the sites of a file. The number of sites is not limited, but those
/// in one square of 2^-28 of a face of the cube must fit into memory, and so must those that are
/// joined at last.
/// \param sites  a .npy file, (n, 3) points or (n, 2) longitudes and latitudes in degrees, with any
///               type of numbers
/// \throws FileError with one line that names file, row and value of what is wrong in a file; or
///         that says how much memory or disk is missing, before work begins where that can be known
/// \throws InvalidInput if the options are not valid
/// \throws Interrupted as Execution::stop says; the work that is done stays in the scratch
///         directory
RONDEL_API OutOfCoreReport delaunay_file(const std::string& sites, const OutOfCoreFiles& files,
                                         const OutOfCoreOptions& out_of_core,
                                         const Options& options = {},
                                         const Execution& execution = {});

}  // namespace rondel
