// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The result of a triangulation: immutable flat arrays.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/large_vector.h"
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

/// What a build did and how long it took.
struct BuildReport {
  Tally rungs{};
  unsigned threads = 1;  ///< at most
  double order_seconds = 0;
  double triangulate_seconds = 0;
};

/// The arrays of a Triangulation, for those who make one.
struct TriangulationArrays {
  std::size_t num_sites = 0;
  int dimension = -1;
  LargeVector<Triple> faces;
  LargeVector<Triple> neighbors;
  std::vector<Index> ghost_faces;
  std::vector<Index> ring;
  std::vector<Duplicate> duplicates;
  std::vector<Hidden> hidden;
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
class RONDEL_API Triangulation {
 public:
  Triangulation() = default;
  /// Of arrays that the library made.
  Triangulation(TriangulationArrays arrays, const Options& options, const BuildReport& report);
  /// Of arrays that come from elsewhere, a file say. Expected time O(n).
  /// \throws InvalidInput (position in the array that the message names) if they do not obey 1, 2
  ///         and 5: indices in range, a closed surface around every vertex, each edge in two faces.
  ///         Whether the faces are Delaunay is for check() to say.
  static Triangulation from_arrays(TriangulationArrays arrays, const Options& options);

  [[nodiscard]] int dimension() const noexcept { return arrays_.dimension; }
  [[nodiscard]] Model model() const noexcept { return model_; }
  [[nodiscard]] const Sphere& sphere() const noexcept { return sphere_; }

  [[nodiscard]] std::size_t num_sites() const noexcept { return arrays_.num_sites; }
  [[nodiscard]] std::size_t num_vertices() const noexcept;
  [[nodiscard]] std::size_t num_faces() const noexcept { return arrays_.faces.size(); }
  [[nodiscard]] std::size_t num_ghost_faces() const noexcept { return arrays_.ghost_faces.size(); }

  /// Corners of the faces, shape (m, 3).
  [[nodiscard]] std::span<const Triple> faces() const noexcept { return arrays_.faces; }
  /// Faces across the edges, shape (m, 3).
  [[nodiscard]] std::span<const Triple> neighbors() const noexcept { return arrays_.neighbors; }
  /// The ghost faces in increasing order.
  [[nodiscard]] std::span<const Index> ghost_faces() const noexcept { return arrays_.ghost_faces; }
  [[nodiscard]] bool is_ghost(Index face) const noexcept;

  /// Below dimension 2: the vertices in their order around the great circle.
  /// Empty in dimension 2.
  [[nodiscard]] std::span<const Index> ring() const noexcept { return arrays_.ring; }

  /// In increasing order of `site`.
  [[nodiscard]] std::span<const Duplicate> duplicates() const noexcept {
    return arrays_.duplicates;
  }
  /// In increasing order of `site`.
  [[nodiscard]] std::span<const Hidden> hidden() const noexcept { return arrays_.hidden; }

  [[nodiscard]] const BuildReport& report() const noexcept { return report_; }

 private:
  TriangulationArrays arrays_;
  Model model_ = Model::projected;
  Sphere sphere_{};
  BuildReport report_{};
};

}  // namespace rondel
