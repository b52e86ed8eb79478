// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A raster on the faces of the cube around the sphere, seen from its center. Face 2k + s has the
// axis k and its coordinate +1 (s = 0) or -1 (s = 1); node (i, j) has -1 + 2 i / steps along axis k
// + 1 and -1 + 2 j / steps along axis k + 2, where axes are counted modulo 3. Nodes on the border
// of a face are nodes of the next face, too, with the same coordinates.
//
// in    points, any vectors but the origin
// out   nodes as unit vectors; for a point its square, and where it is there
// index nodes: i fastest, then j, then the face
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "exact/vector.h"
#include "rondel/mesh_size.h"
#include "rondel/types.h"

namespace rondel::mesh {

// A raster with `steps` squares along each edge of the cube.
struct CubeRaster {
  std::size_t steps;

  [[nodiscard]] std::size_t side() const { return steps + 1; }
  [[nodiscard]] std::size_t num_nodes() const { return 6 * side() * side(); }
  // Returns the index of a node in arrays.
  [[nodiscard]] std::size_t node(std::size_t face, std::size_t i, std::size_t j) const {
    return (face * side() + j) * side() + i;
  }

  // Returns the coordinate on the cube of a node's row or column.
  [[nodiscard]] double coordinate(std::size_t i) const {
    return -1 + 2 * static_cast<double>(i) / static_cast<double>(steps);
  }

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

  // The position of a point: a face, a square of it, and a position in the square.
  struct RasterPlace {
    std::size_t face;
    std::size_t i;
    std::size_t j;
    double s;  // 0 to 1 from node i to i + 1
    // 0 to 1 from node j to j + 1
    double t;
  };
  // Returns the position of a point that is not the origin.
  [[nodiscard]] RasterPlace spot(const Point& p) const {
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

// The data of a SizeFunction.
struct SizeFunction::Raster {
  CubeRaster cube;
  std::vector<float> relative;  // by node: smallest / spacing
  // smallest and largest spacing of all nodes
  double smallest;
  double largest;
};

// Limits how fast spacings grow: lowers the values at the nodes until none exceeds that of a node a
// few steps away by more than the slope times their distance.
void limit_slope(const CubeRaster& cube, double slope, std::vector<double>& values);

}  // namespace rondel::mesh
