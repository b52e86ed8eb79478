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

/// Names a site (its position in the input), a face or a point of a diagram.
using Index = std::uint32_t;

/// The value that stands for "none".
inline constexpr Index no_index = 0xffff'ffffU;

/// The largest number of sites of one triangulation: 2n-4 faces have 6n-12
/// halfedges, and a halfedge must fit an Index.
inline constexpr std::size_t max_sites = 715'827'882;

/// What an input point stands for (the paper, sections 4.1 and 4.2).
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

/// The sphere on or near which the sites lie.
struct Sphere {
  Point center{};
  double squared_radius = 1;
};

/// What to triangulate.
struct Options {
  Model model = Model::projected;
  Sphere sphere{};
};

/// Called now and then during long work with the name of the stage ("order",
/// "triangulate", ...) and the fraction of it that is done, from 0 to 1.
/// 1. One thread at a time calls it, any of those that work; the fractions never decrease.
/// 2. No lock of the library is held meanwhile: it may call the library.
/// 3. It may throw: then it is called no more, the work ends, and nothing is left of it.
using Progress = std::function<void(std::string_view stage, double fraction)>;

/// How long work is done, on which its result never depends.
struct Execution {
  unsigned threads = 0;  ///< at most, 0: one for each core; more than 1024 count as 1024
  Progress progress{};
  /// Once it is true, the call throws Interrupted (error.h) soon, at the next piece of a parallel
  /// loop on any of its threads, and nothing is left of its work. Short work goes on to its end.
  const std::atomic<bool>* stop = nullptr;
};

/// How many conflict tests each rung of the exactness ladder decided. Machines and versions may
/// differ in these numbers, but not in a result.
struct Tally {
  std::uint64_t filter = 0;         ///< doubles with an error bound
  std::uint64_t extended = 0;       ///< numbers of 64 bits, where the processor has them
  std::uint64_t double_double = 0;  ///< sums of two doubles
  std::uint64_t close = 0;          ///< doubles again, from differences of the points as given
  std::uint64_t exact = 0;          ///< words without end
  std::uint64_t perturbed = 0;      ///< ties
};

}  // namespace rondel
