// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Interpolation of values at the sites of a triangulation to other points of the sphere.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel {

/// The methods of interpolation. u is the unit vector of the target, x that of a site.
enum class Method : std::uint8_t {
  /// The value of the nearest site; of several at one distance the first one in spatial order.
  nearest,
  /// Barycentric interpolation in the plane of the face, seen from the center (Renka, ACM TOMS 23,
  /// 1997), from three sites. It is continuous. For four cocircular sites it depends on which
  /// diagonal the triangulation has.
  linear,
  /// Natural neighbors, weighted by the edges of the cell that u would have (Christ, Friedberg,
  /// Lee, Nucl. Phys. B 210, 1982), in the gnomonic picture at u. It is continuous, and smooth
  /// except on the Delaunay circles.
  laplace,
  /// Natural neighbors, weighted by the areas that this cell takes from others (Sibson 1981;
  /// Boissonnat, Floetotto, INRIA RR-4530, 2002), in the gnomonic picture at u. It is smooth except
  /// at the sites.
  sibson,
  /// Natural neighbors with gradients, in the stereographic plane of u. It is smooth except at the
  /// sites.
  hermite,
  /// Clough-Tocher interpolation on the sphere (Alfeld, Neamtu, Schumaker, J. Comput. Appl. Math.
  /// 73, 1996), divided by its interpolant of the constant 1. Its derivatives are continuous. It
  /// needs gradients.
  cubic,
};

/// The value of a target that has no value by the method (Interpolator, rule 5).
enum class Outside : std::uint8_t {
  missing,  ///< no value: an empty row, NaN
  nearest,  ///< the value of the nearest site
  error,    ///< InvalidInput names the first such target
};

/// The value of several sites in one place.
enum class SharedPlace : std::uint8_t {
  first,  ///< the value of the lowest index
  mean,   ///< the mean of all values
  error,  ///< InvalidInput names the first duplicate
};

/// The rule for the sum of the weights of a target.
enum class Normalization : std::uint8_t {
  unity,  ///< the sum is 1: constants are reproduced
  /// The weighted sum of the sites is u: x, y, z are reproduced, and so are rotations; for linear,
  /// laplace and sibson.
  homogeneous,
};

/// The gradient along directions in which the neighbors of a site do not determine it: across a
/// track, a meridian, a circle (docs/theory/cubic.md).
enum class Undetermined : std::uint8_t {
  zero,     ///< it is 0 across the track; along the track it is estimated
  missing,  ///< the site has no gradient: there hermite is sibson, and cubic is linear
};

/// Return the names of these values in the tool, in files of weights and in Python: "sibson",
/// "nan", "first", "unity", "zero" ...; empty for other numbers.
RONDEL_API std::string_view name_of(Method method) noexcept;
RONDEL_API std::string_view name_of(Outside outside) noexcept;
RONDEL_API std::string_view name_of(SharedPlace shared_place) noexcept;
RONDEL_API std::string_view name_of(Normalization normalization) noexcept;
RONDEL_API std::string_view name_of(Undetermined undetermined) noexcept;

/// Options of the estimate of gradients.
struct GradientOptions {
  /// The neighbors of a site that count are at most this many edges away.
  unsigned rings = 2;
  Undetermined undetermined = Undetermined::zero;
  friend bool operator==(const GradientOptions&, const GradientOptions&) = default;
};

struct InterpolationOptions {
  Method method = Method::sibson;
  Outside outside = Outside::missing;
  SharedPlace shared_place = SharedPlace::first;
  Normalization normalization = Normalization::unity;  ///< has no effect on nearest
  GradientOptions gradient{};                          ///< for Method::hermite and Method::cubic
  /// Whether Interpolator::weights() computes the hashes of sites and targets, which takes about 30
  /// ns for each point.
  bool hashes = true;
};

/// Interpolates on a triangulation. A target stands for the ray from the center of the sphere
/// through it. Let w be the weights of a target, x_i the unit vectors of the sites, and u that of
/// the target.
///
/// 1. Unity: the sum of w is 1 up to 4 ulp of the sum of |w| (Normalization::unity).
/// 2. Direction: the sum of w_i x_i is r u with r <= 1, up to 1e-14 (linear, laplace, sibson). r is
///    positive if all sites of the row are within 90 degrees, or the method is linear. So a + g.x
///    is reproduced as a + r g.u, where 1 - r grows with the squared distance of the sites. With
///    Normalization::homogeneous, w/r instead of w, it is reproduced as a/r + g.u.
/// 3. Range: no weight of nearest, linear, laplace and sibson is negative. hermite and cubic may
///    overshoot.
/// 4. At a site the value is that of the site, exactly, by one weight. On an edge linear has two
///    weights. Sites of one great circle are rounded, and then triangles on the border join sites
///    that have others within rounding between them: there every method but nearest takes the target
///    to be on the edge between the sites next to it. Such a triangle is at most 2^-49 radians high
///    above its longest side, and its sides are longer than 2^-29.
/// 5. Outside of all solid faces (Locator) a target has no value, except as Outside says. Natural
///    neighbors have no value either where the new cell is larger than a hemisphere, and
///    homogeneous weights where r is below 2^-20. nearest always has a value if there is a site. In
///    dimension 1 all methods but nearest are linear within solid arcs; in dimension 0 they have a
///    value at the site alone.
/// 6. Model::weighted allows Method::nearest only, by the power distance.
/// 7. The bytes are the same on every machine, for any number of threads, and for every order of
///    the sites that keeps the order of sites in one place.
/// 8. Any number of threads may use one Interpolator at once. An Interpolator that was moved from
///    can only be assigned to or destroyed.
///
/// Values are in any unit, gradients in that unit per radian. Arrays of several fields have the
/// shape (num_fields, n), where n is the number of sites or of targets. The expected time is O(1)
/// for each target of a large range. The memory is 150 bytes for each vertex.
class RONDEL_API Interpolator {
 public:
  /// Prepares a triangulation, whose sites are kept, in O(n).
  /// \throws InvalidInput as a Locator does.
  explicit Interpolator(const Triangulation& triangulation);
  ~Interpolator();
  Interpolator(Interpolator&& other) noexcept;
  Interpolator& operator=(Interpolator&& other) noexcept;

  /// Returns the weights: one row for each target, one column for each site.
  /// \throws InvalidInput, like all functions that take targets, with the first bad index and
  ///         before any work, if a target is not finite or is the center of the sphere, or because
  ///         of rule 6 or SharedPlace::error; after the work because of Outside::error. It is also
  ///         thrown for Normalization::homogeneous with hermite and cubic: the weighted sums of
  ///         their sites do not point to u, so no factor makes the weights reproduce x, y, z.
  [[nodiscard]] Weights weights(std::span<const Point> targets,
                                const InterpolationOptions& options = {},
                                const Execution& execution = {}) const;

  /// Returns the values of fields at the targets, shape (num_fields, targets). For nearest, linear,
  /// laplace and sibson they are those of apply(weights(targets)), bit by bit except for
  /// SharedPlace::mean; for hermite and cubic up to rounding. A value is NaN if there is none, or
  /// if it depends on a NaN by more than rounding (ApplyOptions::max_missing). Weights are not stored.
  /// \param field  values at the sites, shape (num_fields, n)
  /// \throws InvalidInput also if the length of `field` is not a positive multiple of n.
  [[nodiscard]] std::vector<double> values(std::span<const double> field,
                                           std::span<const Point> targets,
                                           const InterpolationOptions& options = {},
                                           const Execution& execution = {}) const;

  /// Returns values with given gradients instead of estimated ones, for hermite and cubic.
  /// \param gradients  one tangent vector for each value of `field`
  /// \throws InvalidInput also for other methods, or if the number of gradients is not that of the
  ///         values.
  [[nodiscard]] std::vector<double> values(std::span<const double> field,
                                           std::span<const Point> gradients,
                                           std::span<const Point> targets,
                                           const InterpolationOptions& options = {},
                                           const Execution& execution = {}) const;

  /// Returns the matrix that estimates tangent gradients of a field. Its rows 3i, 3i + 1, 3i + 2
  /// give x, y, z of the gradient at site i. They are empty where no gradient is available: in
  /// dimensions below 2, and as GradientOptions::undetermined says. Sites in one place have the
  /// same rows, of the value of the first one.
  /// \throws InvalidInput in Model::weighted.
  [[nodiscard]] Weights gradient(const GradientOptions& options = {},
                                 const Execution& execution = {}) const;

  /// Interpolates tangent vectors (winds) at the sites, Cartesian, to tangent vectors at the
  /// targets by homogeneous weights. linear, laplace and sibson reproduce a rigid rotation w x x as
  /// w x u, across the poles too; hermite and cubic do so to the order of the method. Shape
  /// (num_fields, targets).
  [[nodiscard]] std::vector<Point> vectors(std::span<const Point> field,
                                           std::span<const Point> targets,
                                           const InterpolationOptions& options = {},
                                           const Execution& execution = {}) const;

  class Impl;

 private:
  std::unique_ptr<const Impl> impl_;
};

}  // namespace rondel
