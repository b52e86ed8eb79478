// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The small types that every other header shares.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>

namespace rondel {

/// The index of a site (its position in the input), of a face, or of a point of a diagram.
using Index = std::uint32_t;

/// The value that stands for a missing index.
inline constexpr Index no_index = 0xffff'ffffU;

/// The largest number of sites of one triangulation: 2n-4 faces have 6n-12
/// halfedges, and a halfedge must fit an Index.
inline constexpr std::size_t max_sites = 715'827'882;

/// The meaning of an input point (the paper, sections 4.1 and 4.2).
enum class Model : std::uint8_t {
  projected,  ///< its exact projection on the sphere; every distinct ray is a vertex
  weighted,   ///< the circle whose pole it is; the result is the convex hull
};

/// The exact sign of a predicate.
enum class Sign : std::int8_t { negative = -1, zero = 0, positive = 1 };

/// Cartesian coordinates.
struct Point {
  double x = 0;
  double y = 0;
  double z = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

/// Longitude and latitude in degrees.
struct LonLat {
  double lon_deg = 0;
  double lat_deg = 0;
  friend bool operator==(const LonLat&, const LonLat&) = default;
};

/// The kilometers in a radian of lengths that are given in kilometers, on a sphere of the radius
/// 6371.229 km, which is that of the Earth in MPAS.
inline constexpr double kilometers_per_radian = 6371.229;

/// The sphere on or near which the sites lie.
struct Sphere {
  Point center{};
  double squared_radius = 1;
};

/// The model and the sphere of a triangulation.
struct Options {
  Model model = Model::projected;
  Sphere sphere{};
};

/// A function that is called now and then during long work with the name of the stage ("order",
/// "triangulate", ...) and the fraction of it that is done, from 0 to 1.
/// 1. One of the working threads calls it, one at a time; the fractions never decrease.
/// 2. No lock of the library is held meanwhile: it may call the library.
/// 3. It may throw: then it is not called again, the work ends, and nothing is left of it.
using Progress = std::function<void(std::string_view stage, double fraction)>;

/// How work is executed. Its result never depends on it.
struct Execution {
  /// The largest number of threads; 0: one for each core; more than 1024 count as 1024. Sites on few
  /// circles are inserted by one (docs/guide/scaling.md).
  unsigned threads = 0;
  Progress progress{};
  /// A flag. Once it is true, the call throws Interrupted (error.h) soon, at the next piece of a
  /// parallel loop on any of its threads, and nothing is left of its work. Short work is completed.
  const std::atomic<bool>* stop = nullptr;
};

/// How many conflict tests each rung of the exactness ladder decided. These numbers may differ
/// between machines and versions, but results do not.
struct Tally {
  std::uint64_t filter = 0;         ///< doubles with an error bound
  std::uint64_t extended = 0;       ///< numbers of 64 bits, where the processor has them
  std::uint64_t double_double = 0;  ///< sums of two doubles
  std::uint64_t close = 0;          ///< doubles again, from differences of the points as given
  std::uint64_t exact = 0;          ///< arbitrary precision
  std::uint64_t perturbed = 0;      ///< ties, decided by the symbolic perturbation
};

}  // namespace rondel
