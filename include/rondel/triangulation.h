// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The result of a triangulation: immutable flat arrays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "rondel/export.h"
#include "rondel/sites.h"
#include "rondel/types.h"

namespace rondel {

/// Corners or neighbors of a face.
using Triple = std::array<Index, 3>;

/// A site in the same place as another site.
struct Duplicate {
  Index site = no_index;
  Index representative = no_index;  ///< the lowest index in that place
  friend bool operator==(const Duplicate&, const Duplicate&) = default;
};

/// A site that is not a vertex of the regular triangulation.
struct Hidden {
  Index site = no_index;
  Index face = no_index;  ///< a face below which it lies; no_index below dimension 2
  friend bool operator==(const Hidden&, const Hidden&) = default;
};

/// The algorithm that made a triangulation.
enum class Builder : std::uint8_t {
  given,        ///< the triangulation was not built: it comes from arrays, or from changes
  ring,         ///< sorting around the great circle, below dimension 2
  incremental,  ///< insertion of one site after the other, for any input
  sphere,       ///< divide and conquer over the whole sphere
  blocks,       ///< divide and conquer in blocks that are certified, in parallel
};

/// Returns the name of a value: "ring", "incremental" ...
RONDEL_API const char* name_of(Builder builder) noexcept;

/// Returns the name of a model: "projected", "weighted"; empty for other numbers.
RONDEL_API std::string_view name_of(Model model) noexcept;

/// The work of a build and its time.
struct BuildReport {
  Builder builder = Builder::given;
  Tally rungs{};
  unsigned threads = 1;  ///< the largest number of threads
  double order_seconds = 0;
  double triangulate_seconds = 0;
};

/// The arrays for Triangulation::from_arrays(). Each is as the function of that name returns it.
struct TriangulationParts {
  int dimension = -1;
  std::span<const Triple> faces{};
  std::span<const Triple> neighbors{};
  std::span<const Index> ghost_faces{};
  std::span<const Index> ring{};
  std::span<const Duplicate> duplicates{};
  std::span<const Hidden> hidden{};
};

/// A triangulation of sites on or close to a sphere.
///
/// The result is unique: it depends on the set of sites only, not on their
/// order, the number of threads, the machine or the compiler.
///
/// 1. `dimension` is -1 without sites; 0 with one vertex; 1 when all sites lie
///    on one great circle (two sites always do); otherwise 2.
/// 2. In dimension 2 the V vertices carry 2V-4 faces that form a closed
///    surface. The corners of a face are input indices in counterclockwise
///    order seen from outside. `neighbors()[f][i]` is the face across the edge
///    opposite to corner i.
/// 3. A face is solid when the center of the sphere lies strictly below its
///    plane, otherwise ghost. Without ghost faces the surface surrounds the center.
/// 4. Canonical order: a face starts with the corner that comes first in the
///    spatial order, and faces are listed by that corner, then counterclockwise.
/// 5. Every site is a vertex, a duplicate or hidden, and only one of these.
/// 6. A triangulation is immutable and keeps its sites. Copies are cheap, as they share everything;
///    several threads may use one. A triangulation that was moved from is that of no sites.
class RONDEL_API Triangulation {
 public:
  /// Makes the triangulation of no sites.
  Triangulation() = default;

  /// Makes a triangulation of given arrays, for example from a file, in O(n) expected time.
  /// \throws InvalidInput (position in the array that the message names) as delaunay() does, and if
  ///         the arrays do not obey 1, 2 and 5: indices in range, a closed surface around every
  ///         vertex, each edge in two faces, duplicates in one place. Whether the faces are
  ///         Delaunay is tested by check(); a Locator, an Interpolator and a DynamicTriangulation,
  ///         which walk through the faces, test it once, when they are made, and throw
  ///         InvalidInput. Cells, graphs, outlines and meshes are made of the faces as they are.
  static Triangulation from_arrays(Sites sites, const TriangulationParts& parts,
                                   const Options& options = {});

  [[nodiscard]] int dimension() const noexcept;
  [[nodiscard]] Model model() const noexcept;
  [[nodiscard]] const Sphere& sphere() const noexcept;

  [[nodiscard]] const Sites& sites() const noexcept;
  [[nodiscard]] std::size_t num_sites() const noexcept;
  [[nodiscard]] std::size_t num_vertices() const noexcept;
  [[nodiscard]] std::size_t num_faces() const noexcept;
  [[nodiscard]] std::size_t num_ghost_faces() const noexcept;

  /// Returns the corners of the faces, shape (m, 3).
  [[nodiscard]] std::span<const Triple> faces() const noexcept;
  /// Returns the faces across the edges, shape (m, 3).
  [[nodiscard]] std::span<const Triple> neighbors() const noexcept;
  /// Returns the ghost faces in ascending order.
  [[nodiscard]] std::span<const Index> ghost_faces() const noexcept;
  [[nodiscard]] bool is_ghost(Index face) const noexcept;

  /// Returns the vertices in their order around the great circle below dimension 2; empty in
  /// dimension 2.
  [[nodiscard]] std::span<const Index> ring() const noexcept;

  /// Returns the duplicates in ascending order of `site`.
  [[nodiscard]] std::span<const Duplicate> duplicates() const noexcept;
  /// Returns the hidden sites in ascending order of `site`.
  [[nodiscard]] std::span<const Hidden> hidden() const noexcept;

  [[nodiscard]] const BuildReport& report() const noexcept;

  struct Impl;
  /// For the library itself.
  explicit Triangulation(std::shared_ptr<const Impl> impl) noexcept;

 private:
  [[nodiscard]] const Impl& impl() const noexcept;

  std::shared_ptr<const Impl> impl_;  // null without sites
};

}  // namespace rondel
