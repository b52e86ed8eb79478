// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Where the spacings of a mesh are known, and at which places.
#pragma once

#include <cstddef>
#include <optional>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// A part of the sphere that is a rectangle on the tangent plane at its center, in the projection
/// from the center of the sphere (gnomonic), which takes arcs of great circles to straight lines.
/// Its sides are eastward and northward at its center.
struct RONDEL_API SizeRegion {
  Point center;            ///< a unit vector
  double half_width = 0;   ///< radians from the center to the side in the east; 1e-9 to pi / 4
  double half_height = 0;  ///< radians from the center to the side in the north; 1e-9 to pi / 4

  /// Returns true if a point is in the region or on its border.
  /// \throws InvalidInput if the region is not as described.
  [[nodiscard]] bool contains(const Point& place) const;
};

/// The raster on which a SizeFunction is stored: on the whole sphere, or on a region, where its steps
/// are as much finer as the region is smaller.
struct RONDEL_API SizeRaster {
  /// The raster of the sphere, on the six faces of a cube around it; a number stands for it.
  /// \param number  steps along a face of the cube, a power of two from 1 to 4096
  SizeRaster(std::size_t number) : steps(number) {}
  /// The raster of a region.
  /// \param number  steps along its longer side; the other side has steps of that length or shorter ones.
  ///                From 1 to most_steps().
  SizeRaster(const SizeRegion& part, std::size_t number) : steps(number), region(part) {}

  /// Returns the raster of a region whose steps have at most this length in radians, or else the finest
  /// one.
  /// \throws InvalidInput if the region is not as described, or the length is not positive.
  [[nodiscard]] static SizeRaster with_step(const SizeRegion& region, double step);

  /// Returns the largest number of steps. A raster of a region has at most 2^24 squares, as many as
  /// 4096 steps along both sides give, and 2^16 steps along a side.
  /// \throws InvalidInput if the region is not as described.
  [[nodiscard]] std::size_t most_steps() const;
  /// Returns the length in radians of the longest step, which is at the center of a region or of a
  /// face of the cube.
  /// \throws InvalidInput if the region or the number of steps is not as described.
  [[nodiscard]] double longest_step() const;

  std::size_t steps;
  std::optional<SizeRegion> region{};
};

}  // namespace rondel::mesh
