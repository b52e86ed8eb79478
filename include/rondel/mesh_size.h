// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// How far apart the sites of a mesh shall be, place by place.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The wanted spacing of a mesh: the distance of neighbors, in radians, as a function on the sphere.
///
/// 1. It is kept as values on a raster on the six faces of a cube, and bilinear in between in 1/spacing:
///    what it was made from is asked once for each node of the raster.
/// 2. It is immutable; copies are cheap.
/// 3. The density of a centroidal tessellation with these spacings is (smallest() / spacing)^4, from 0 to 1
///    (Ringler, Ju and Gunzburger, Ocean Dynamics 58, 2008).
class RONDEL_API SizeFunction {
 public:
  /// Spacings in radians at places, in blocks: out[i] belongs to places[i].
  using Block = std::function<void(std::span<const Point> places, std::span<double> out)>;

  /// The sides of a face of the cube in steps of the raster, if nothing is said: steps of 6 to 12 km on the Earth.
  static constexpr std::size_t usual_steps = 1024;

  /// The same everywhere.
  /// \throws InvalidInput if the spacing is not between 0 and pi.
  static SizeFunction constant(double spacing, std::size_t steps = usual_steps);
  /// From a function, which is called by one thread at a time.
  /// \throws InvalidInput if the steps are no power of two from 1 to 4096; (number of the node) if a
  ///         spacing is not between 0 and pi.
  static SizeFunction from_function(const Block& spacings, std::size_t steps = usual_steps);
  /// From values on a grid of longitudes and latitudes (degrees, each increasing or decreasing), the
  /// longitudes changing fastest, bilinear in between; beyond the first and last latitude as there.
  /// \throws InvalidInput as from_function(), and if lengths or axes are not so.
  static SizeFunction from_grid(std::span<const double> lon_deg, std::span<const double> lat_deg,
                                std::span<const double> spacings, std::size_t steps = usual_steps);

  /// `near` at the points, and from there growing by `slope` for each radian of distance, where that is less.
  /// A line is given by points that are closer than `near` to each other (densified()).
  /// \throws InvalidInput if there are no points, `near` is not a spacing or the slope is negative.
  [[nodiscard]] SizeFunction refined(std::span<const Point> points, double near, double slope,
                                     const Execution& execution = {}) const;
  /// As little less as needed that it grows by no more than `slope` for each radian: each node is held
  /// against the sixteen around it, so that along some directions it is 3 % more.
  /// \throws InvalidInput if the slope is negative.
  [[nodiscard]] SizeFunction limited(double slope) const;

  /// In radians, at a point that is not the center.
  [[nodiscard]] double spacing(const Point& place) const;
  /// (smallest() / spacing)^4.
  [[nodiscard]] double density(const Point& place) const;
  [[nodiscard]] double smallest() const noexcept;
  [[nodiscard]] double largest() const noexcept;
  /// How many sites have these spacings: the integral of 1 / (sqrt(3)/2 spacing^2).
  [[nodiscard]] double count() const;
  /// All spacings times this.
  [[nodiscard]] SizeFunction scaled(double factor) const;

 private:
  struct Raster;
  friend class DensityNodes;
  explicit SizeFunction(std::shared_ptr<const Raster> raster) : raster_(std::move(raster)) {}
  static SizeFunction of(std::vector<double> spacings, std::size_t steps);
  [[nodiscard]] double relative(const Point& place) const;  // smallest / spacing
  std::shared_ptr<const Raster> raster_;
};

/// The points of arcs of great circles from each point to the next, closer than `distance` radians.
/// \throws InvalidInput if the distance is not positive, or two neighbors are antipodes (the index of the second one).
RONDEL_API std::vector<Point> densified(std::span<const Point> line, double distance);

}  // namespace rondel::mesh
