// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Values at the sites of a triangulation, carried to other points of the sphere.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel {

/// How a value follows from those of sites. u is the unit vector of the target, x of a site its own.
enum class Method : std::uint8_t {
  /// That of the nearest site; of several at one distance the first in the spatial order.
  nearest,
  /// Barycentric in the plane of the face, seen from the center (Renka, ACM TOMS 23, 1997): three
  /// sites. Continuous. Four cocircular sites: depends on which diagonal the triangulation has.
  linear,
  /// Natural neighbors by the edges of the cell that u would have (Christ, Friedberg, Lee, Nucl. Phys.
  /// B 210, 1982), in the gnomonic picture at u. Continuous, smooth off the Delaunay circles.
  laplace,
  /// Natural neighbors by the areas that this cell takes from others (Sibson 1981; Boissonnat,
  /// Floetotto, INRIA RR-4530, 2002), in the gnomonic picture at u. Smooth off the sites.
  sibson,
  /// Natural neighbors with gradients, in the stereographic plane of u. Smooth off the sites.
  hermite,
  /// Clough-Tocher on the sphere (Alfeld, Neamtu, Schumaker, J. Comput. Appl. Math. 73, 1996) over
  /// its image of the constant 1. Its derivatives are continuous; needs gradients.
  cubic,
};

/// What becomes of a target that has no value by the method (Interpolator, 5).
enum class Outside : std::uint8_t {
  missing,  ///< none: an empty row, NaN
  nearest,  ///< that of the nearest site
  error,    ///< InvalidInput names the first one
};

/// What the value of several sites in one place is.
enum class SharedPlace : std::uint8_t {
  first,  ///< that of the lowest index
  mean,   ///< the mean of all
  error,  ///< InvalidInput names the first duplicate
};

/// What the weights of a target sum up to.
enum class Normalization : std::uint8_t {
  unity,  ///< 1: constants come back
  /// what makes their sum times sites u: x, y, z come back, and so do rotations; of linear, laplace and sibson
  homogeneous,
};

/// The gradient along directions in which the neighbors of a site do not determine it: across a track, a meridian, a circle
/// (docs/theory/cubic.md).
enum class Undetermined : std::uint8_t {
  zero,     ///< 0 across; along the track it is estimated
  missing,  ///< there is no gradient: hermite is sibson there, and cubic linear
};

/// The names of these values in the tool, in files of weights and in Python: "sibson", "nan", "first", "unity", "zero" ...; empty for
/// what is none of them.
RONDEL_API std::string_view name_of(Method method) noexcept;
RONDEL_API std::string_view name_of(Outside outside) noexcept;
RONDEL_API std::string_view name_of(SharedPlace shared_place) noexcept;
RONDEL_API std::string_view name_of(Normalization normalization) noexcept;
RONDEL_API std::string_view name_of(Undetermined undetermined) noexcept;

/// The method of a name; nothing if there is none.
RONDEL_API std::optional<Method> method_of(std::string_view name) noexcept;

/// How gradients are estimated.
struct GradientOptions {
  /// The neighbors of a site up to so many edges away count.
  unsigned rings = 2;
  Undetermined undetermined = Undetermined::zero;
  friend bool operator==(const GradientOptions&, const GradientOptions&) = default;
};

struct InterpolationOptions {
  Method method = Method::sibson;
  Outside outside = Outside::missing;
  SharedPlace shared_place = SharedPlace::first;
  Normalization normalization = Normalization::unity;  ///< nearest does not heed it
  GradientOptions gradient{};                          ///< of Method::hermite and Method::cubic
  /// Whether Interpolator::weights() computes the hashes of sites and targets, about 30 ns a point.
  bool hashes = true;
};

/// Interpolates on a triangulation. A target stands for the ray from the center of the sphere through
/// it. For the weights w of a target, x_i being the unit vectors of the sites and u that of the target:
///
/// 1. Unity: the sum of w is 1 to 4 ulp of the sum of |w| (Normalization::unity).
/// 2. Direction: the sum of w_i x_i is r u with r <= 1, to 1e-14 (linear, laplace, sibson); r is
///    positive if all sites of the row are within 90 degrees, or the method is linear. So
///    a + g.x comes back as a + r g.u, where 1 - r grows with the squared distance of the sites. With
///    Normalization::homogeneous, w/r instead of w, it comes back as a/r + g.u.
/// 3. Range: no weight of nearest, linear, laplace and sibson is negative. hermite and cubic may
///    overshoot.
/// 4. At a site: its value, exactly, by one weight. On an edge linear has two weights.
/// 5. Outside of all solid faces (Locator) there is no value but as Outside says. Natural neighbors have
///    none either where the new cell is larger than a hemisphere, homogeneous weights where r is
///    below 2^-20. nearest always has one if there is a site. In dimension 1 all methods but nearest
///    are linear within solid arcs; in dimension 0 they have a value at the site alone.
/// 6. Model::weighted has Method::nearest only, by the power distance.
/// 7. The same bytes on every machine, for any number of threads, and for every order of the sites
///    that keeps the order of those in one place.
/// 8. Any number of threads may use one Interpolator at once. One that was moved from can only be
///    assigned to or destroyed.
///
/// Values are in any unit, gradients in that unit a radian. Arrays of several fields have the shape
/// (num_fields, n), n being the number of sites or of targets.
/// Expected time: O(1) a target in a large range. Memory: 150 bytes a vertex.
class RONDEL_API Interpolator {
 public:
  /// Keeps the sites of the triangulation. O(n).
  /// \throws InvalidInput as a Locator does.
  explicit Interpolator(const Triangulation& triangulation);
  ~Interpolator();
  Interpolator(Interpolator&& other) noexcept;
  Interpolator& operator=(Interpolator&& other) noexcept;

  /// One row a target, one column a site.
  /// \throws InvalidInput, like all functions that take targets, with the first bad index and before
  ///         any work, if one is not finite or the center of the sphere, or because of 6 or
  ///         SharedPlace::error; after it because of Outside::error. Also for Normalization::homogeneous of hermite and
  ///         cubic: their weights do not point to u, so that no factor makes them bring x, y, z back.
  [[nodiscard]] Weights weights(std::span<const Point> targets,
                                const InterpolationOptions& options = {},
                                const Execution& execution = {}) const;

  /// The values of fields at the targets, shape (num_fields, targets): for nearest, linear, laplace and
  /// sibson those of apply(weights(targets)), bit by bit but for SharedPlace::mean; for hermite and
  /// cubic to rounding. NaN where there is none, and where it depends on a NaN. Weights are not stored.
  /// \throws InvalidInput also if the length of `field` is not a positive multiple of n.
  [[nodiscard]] std::vector<double> values(std::span<const double> field,
                                           std::span<const Point> targets,
                                           const InterpolationOptions& options = {},
                                           const Execution& execution = {}) const;

  /// The same with gradients instead of estimated ones, for hermite and cubic: one tangent vector a
  /// value. \throws InvalidInput also for other methods, or if there are not as many.
  [[nodiscard]] std::vector<double> values(std::span<const double> field,
                                           std::span<const Point> gradients,
                                           std::span<const Point> targets,
                                           const InterpolationOptions& options = {},
                                           const Execution& execution = {}) const;

  /// What makes tangent gradients of a field: rows 3i, 3i + 1, 3i + 2 for x, y, z at site i, three empty
  /// ones where none can be had: in dimensions below 2, and as GradientOptions::undetermined says. Sites in one place have the same
  /// rows, of the value of the first.
  /// \throws InvalidInput in Model::weighted.
  [[nodiscard]] Weights gradient(const GradientOptions& options = {},
                                 const Execution& execution = {}) const;

  /// Tangent vectors (winds) at the sites, Cartesian, carried to tangent vectors at the targets by
  /// homogeneous weights: by linear, laplace and sibson a rigid rotation w x x comes back as w x u,
  /// across the poles too; by hermite and cubic to the order of the method. Shape (num_fields, targets).
  [[nodiscard]] std::vector<Point> vectors(std::span<const Point> field,
                                           std::span<const Point> targets,
                                           const InterpolationOptions& options = {},
                                           const Execution& execution = {}) const;

  class Impl;

 private:
  std::unique_ptr<const Impl> impl_;
};

}  // namespace rondel
