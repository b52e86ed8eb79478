// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The rasters on which spacings are kept: both are seen from the center of the sphere.
//
// CubeRaster   on the faces of the cube around the sphere. Face 2k + s has the axis k and its
//              coordinate +1 (s = 0) or -1 (s = 1); node (i, j) has -1 + 2 i / steps along axis k + 1
//              and -1 + 2 j / steps along axis k + 2, where axes are counted modulo 3. Nodes on the
//              border of a face are nodes of the next face, too, with the same coordinates.
// PlaneRaster  on a rectangle of one tangent plane, which is its only face: a SizeRegion.
//
//        north                    A place p is at x = p.east / p.center, y = p.north / p.center;
//     +----+----+  y = +height    beyond the border x and y are clamped.
//     |    |    |
//     +----c----+ east
//     |    |    |
//     +----+----+  x = +width
//
// in    points, any vectors but the origin
// out   nodes as unit vectors; for a point its square, and where it is there
// index nodes: i fastest, then j, then the face
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "exact/vector.h"
#include "rondel/mesh_size.h"
#include "rondel/types.h"

namespace rondel::mesh {

// The position of a point: a face, a square of it, and a position in the square.
struct RasterPlace {
  std::size_t face;
  std::size_t i;
  std::size_t j;
  double s;  // 0 to 1 from node i to i + 1
  // 0 to 1 from node j to j + 1
  double t;
};

// Returns a point in the same direction of which no product over- or underflows; nearly all points
// are that already.
inline Point moderate(const Point& p) {
  const double largest = largest_coordinate(p);
  return largest > 0x1p-400 && largest < 0x1p400 ? p : scaled(p);
}

// A raster with `steps` squares along each edge of the cube.
struct CubeRaster {
  std::size_t steps;

  [[nodiscard]] std::size_t side() const { return steps + 1; }
  [[nodiscard]] std::size_t num_faces() const { return 6; }
  // Return the numbers of nodes along both sides of a face.
  [[nodiscard]] std::size_t columns() const { return side(); }
  [[nodiscard]] std::size_t rows() const { return side(); }
  [[nodiscard]] std::size_t num_nodes() const { return 6 * side() * side(); }
  // Returns the index of a node in arrays.
  [[nodiscard]] std::size_t node(std::size_t face, std::size_t i, std::size_t j) const {
    return (face * side() + j) * side() + i;
  }

  // Returns the coordinate on the cube of a node's row or column.
  [[nodiscard]] double coordinate(std::size_t i) const {
    return -1 + 2 * static_cast<double>(i) / static_cast<double>(steps);
  }

  [[nodiscard]] double x(std::size_t i) const { return coordinate(i); }
  [[nodiscard]] double y(std::size_t j) const { return coordinate(j); }

  // Returns the coordinates of a node on the cube; place() returns its direction as a unit vector.
  [[nodiscard]] std::array<double, 3> on_cube(std::size_t face, std::size_t i,
                                              std::size_t j) const {
    const std::size_t axis = face / 2;
    std::array<double, 3> p{};
    p[axis] = face % 2 == 0 ? 1 : -1;
    p[(axis + 1) % 3] = coordinate(i);
    p[(axis + 2) % 3] = coordinate(j);
    return p;
  }

  [[nodiscard]] Point place(std::size_t face, std::size_t i, std::size_t j) const {
    const auto p = on_cube(face, i, j);
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return {p[0] / length, p[1] / length, p[2] / length};
  }

  // Returns the position of a point that is not the origin.
  [[nodiscard]] RasterPlace spot(const Point& place) const {
    const Point p = moderate(place);
    const double ax = std::abs(p.x);
    const double ay = std::abs(p.y);
    const double az = std::abs(p.z);
    std::size_t axis = 2;
    double along = p.z;
    double a = p.x;
    double b = p.y;
    if (ax >= ay && ax >= az) {
      axis = 0;
      along = p.x;
      a = p.y;
      b = p.z;
    } else if (ay >= az) {
      axis = 1;
      along = p.y;
      a = p.z;
      b = p.x;
    }
    const double scale = 0.5 * static_cast<double>(steps);
    const double per_length = scale / std::abs(along);
    const double x = a * per_length + scale;
    const double y = b * per_length + scale;
    const std::size_t i = cell_of(x);
    const std::size_t j = cell_of(y);
    return {2 * axis + (along < 0 ? 1 : 0), i, j, x - static_cast<double>(i),
            y - static_cast<double>(j)};
  }

 private:
  [[nodiscard]] std::size_t cell_of(double x) const {
    const auto i = static_cast<std::size_t>(x > 0 ? x : 0);
    return i < steps ? i : steps - 1;
  }
};

// A raster of a region.
class PlaneRaster {
 public:
  // Throws InvalidInput if the region or the number of steps along its longer side is not as
  // rondel/mesh_region.h describes.
  PlaneRaster(const SizeRegion& region, std::size_t steps);

  [[nodiscard]] const SizeRegion& region() const { return region_; }
  // Returns the number of steps along the longer side.
  [[nodiscard]] std::size_t steps() const { return std::max(squares_[0], squares_[1]); }
  [[nodiscard]] std::size_t num_faces() const { return 1; }
  [[nodiscard]] std::size_t columns() const { return squares_[0] + 1; }
  [[nodiscard]] std::size_t rows() const { return squares_[1] + 1; }
  [[nodiscard]] std::size_t num_nodes() const { return columns() * rows(); }
  [[nodiscard]] std::size_t node(std::size_t /*face*/, std::size_t i, std::size_t j) const {
    return j * columns() + i;
  }

  [[nodiscard]] double x(std::size_t i) const { return coordinate(0, i); }
  [[nodiscard]] double y(std::size_t j) const { return coordinate(1, j); }
  [[nodiscard]] Point place(std::size_t /*face*/, std::size_t i, std::size_t j) const {
    return at(x(i), y(j));
  }
  // Returns the direction of a place on the plane.
  [[nodiscard]] Point at(double x, double y) const {
    return exact::to_point(normalized(center_ + x * east_ + y * north_));
  }

  [[nodiscard]] RasterPlace spot(const Point& p) const;

  // Returns the area of the region in steradians.
  [[nodiscard]] double solid_angle() const;
  // Half of the width and of the height on the plane.
  [[nodiscard]] double half(std::size_t axis) const { return halves_[axis]; }
  // Returns the coordinates of a point on the plane, not clamped; those of points on the far
  // hemisphere are infinite.
  [[nodiscard]] std::array<double, 2> on_plane(const Point& p) const;
  // Returns true for points in the region and on its border.
  [[nodiscard]] bool contains(const Point& p) const {
    const auto [x, y] = on_plane(p);
    return std::abs(x) <= halves_[0] && std::abs(y) <= halves_[1];
  }

 private:
  [[nodiscard]] double coordinate(std::size_t axis, std::size_t i) const {
    return halves_[axis] * (-1 + 2 * static_cast<double>(i) / static_cast<double>(squares_[axis]));
  }

  SizeRegion region_;
  exact::Vector3<double> center_, east_, north_;
  std::array<double, 2> halves_;
  std::array<std::size_t, 2> squares_;  // eastward, northward
};

using AnyRaster = std::variant<CubeRaster, PlaneRaster>;

// Returns the raster that is meant. Throws InvalidInput if it is not as described.
AnyRaster raster_of(const SizeRaster& wanted);

// The data of a SizeFunction.
struct SizeFunction::Raster {
  AnyRaster places;
  std::vector<float> relative;  // by node: smallest / spacing
  // smallest and largest spacing of all nodes
  double smallest;
  double largest;
};

// Limits how fast spacings grow: lowers the values at the nodes until none exceeds that of a node a
// few steps away by more than the slope times their distance.
void limit_slope(const AnyRaster& raster, double slope, std::vector<double>& values);

}  // namespace rondel::mesh
