// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The spacing of the sites of a mesh as a function on the sphere.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/mesh_region.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The wanted spacing of a mesh: the distance of neighboring sites, in radians, as a function on
/// the sphere.
///
/// 1. It is stored as values on a raster of the sphere or of a region, and bilinear in between in
///    1/spacing. The function that it is made from is evaluated once at each node of the raster.
/// 2. It is immutable; copies are cheap.
/// 3. Outside of its region it is the spacing at the place of the border where the coordinates on
///    the plane of the region are clamped; on the far hemisphere that at a corner. Meshes of the
///    whole sphere (scvt(), relax()) refuse a function on a region.
/// 4. The density of a centroidal tessellation with these spacings is (smallest() / spacing)^4,
///    from 0 to 1 (Ringler, Ju and Gunzburger, Ocean Dynamics 58, 2008).
class RONDEL_API SizeFunction {
 public:
  /// A function that computes spacings in radians for a block of places: out[i] belongs to
  /// places[i].
  using Block = std::function<void(std::span<const Point> places, std::span<double> out)>;

  /// The default number of steps of the raster along a face of the cube: steps of 6 to 12 km on the
  /// Earth.
  static constexpr std::size_t usual_steps = 1024;

  /// Makes a spacing that is the same everywhere.
  /// \throws InvalidInput if the spacing is not between 0 and pi.
  static SizeFunction constant(double spacing, const SizeRaster& raster = usual_steps);
  /// Makes the spacing of a mesh of `count` equal cells.
  /// \throws InvalidInput for 0, or so few cells that the spacing is not less than pi.
  static SizeFunction of_count(std::size_t count);
  /// Returns the places of the nodes of a raster: unit vectors, in the order in which from_nodes()
  /// takes their spacings.
  /// \throws InvalidInput if the raster is not as described.
  static std::vector<Point> nodes(const SizeRaster& raster = usual_steps);
  /// Makes spacings of their values in radians at nodes(raster).
  /// \throws InvalidInput as from_function(), and if there is not one spacing for each node.
  static SizeFunction from_nodes(std::vector<double> spacings,
                                 const SizeRaster& raster = usual_steps);
  /// Evaluates a function, which one thread calls at a time.
  /// \throws InvalidInput if the raster is not as described; (number of the node) if a spacing is
  ///         not between 0 and pi.
  static SizeFunction from_function(const Block& spacings, const SizeRaster& raster = usual_steps);
  /// Interpolates values on a grid of longitudes and latitudes bilinearly; beyond the first and the
  /// last latitude the values are those at that latitude.
  /// \param lon_deg  degrees, ascending or descending
  /// \param lat_deg  degrees, ascending or descending
  /// \param spacings  radians; the longitudes change fastest
  /// \throws InvalidInput as from_function(), and if lengths or axes are not as described.
  static SizeFunction from_grid(std::span<const double> lon_deg, std::span<const double> lat_deg,
                                std::span<const double> spacings,
                                const SizeRaster& raster = usual_steps);

  /// Returns the smaller one of this spacing and a spacing that is `near` (radians) at the points
  /// and grows from there by `slope` for each radian of distance. A line is given by points that
  /// are closer than `near` to each other (densified()). Points outside of the region count by
  /// their distance, too.
  /// \throws InvalidInput if there are no points, `near` is not a spacing or the slope is negative.
  [[nodiscard]] SizeFunction refined(std::span<const Point> points, double near, double slope,
                                     const Execution& execution = {}) const;
  /// Returns the largest spacing that is nowhere larger than this one and grows by no more than
  /// `slope` for each radian, in its region. Each node is compared with the 16 nodes around it, so that along some
  /// directions it may grow by 3 % more.
  /// \throws InvalidInput if the slope is negative.
  [[nodiscard]] SizeFunction limited(double slope) const;

  /// Returns the spacing in radians at a point that is not the center.
  [[nodiscard]] double spacing(const Point& place) const;
  /// Returns (smallest() / spacing)^4 at a point.
  [[nodiscard]] double density(const Point& place) const;
  [[nodiscard]] double smallest() const noexcept;
  [[nodiscard]] double largest() const noexcept;
  /// Returns the raster.
  [[nodiscard]] SizeRaster raster() const;
  /// Returns the number of sites with these spacings in the region, or on the sphere: the integral of
  /// 1 / (sqrt(3)/2 spacing^2).
  [[nodiscard]] double count() const;
  /// Returns all spacings multiplied by a factor.
  [[nodiscard]] SizeFunction scaled(double factor) const;
  /// Returns spacings in the same proportions such that count() is `number`, up to rounding.
  /// \throws InvalidInput for 0, or if a spacing is then not less than pi.
  [[nodiscard]] SizeFunction for_count(std::size_t number) const;

 private:
  struct Raster;
  friend class DensityNodes;
  explicit SizeFunction(std::shared_ptr<const Raster> raster) : raster_(std::move(raster)) {}
  static SizeFunction of(std::vector<double> spacings, const SizeRaster& raster);
  [[nodiscard]] double relative(const Point& place) const;  // smallest / spacing
  std::shared_ptr<const Raster> raster_;
};

/// Returns points on the arcs of great circles from each point to the next, closer than `distance`
/// radians. \throws InvalidInput if the distance is not positive, or two neighbors are antipodes
/// (the index of the second one).
RONDEL_API std::vector<Point> densified(std::span<const Point> line, double distance);

}  // namespace rondel::mesh
