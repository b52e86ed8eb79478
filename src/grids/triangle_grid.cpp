// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "exact/vector.h"
#include "grids/grid_formula.h"
#include "grids/icosahedron_faces.h"
#include "meshing/scvt_levels.h"
#include "rondel/delaunay.h"

namespace rondel::grids {
namespace {

using Corners = std::array<Point, 3>;

// The number of cells fits an Index.
constexpr unsigned max_bisections = 16;

// Returns the middle of an arc; the same for both directions.
Point middle_of(const Point& a, const Point& b) { return normalized(a + b); }

class TriangleGrid : public GridFormula {
 public:
  TriangleGrid(Index root, unsigned bisections)
      : root_(root),
        bisections_(bisections),
        corners_(mesh::icosahedron()),
        faces_(icosahedron_faces(corners_)) {}

  [[nodiscard]] Index num_cells() const override {
    return static_cast<Index>(faces_.size()) * root_ * root_ << (2 * bisections_);
  }

  [[nodiscard]] LonLat center(Index cell) const override {
    const Corners corners = corners_of(cell);
    return lonlats(std::vector<Point>{normalized(corners[0] + corners[1] + corners[2])})[0];
  }

  void append_ring(Index cell, std::vector<Point>& ring) const override {
    const Corners corners = corners_of(cell);
    ring.insert(ring.end(), corners.begin(), corners.end());
  }

 private:
  // The triangle that each level of bisection leads to, for the cell that a thread asked for last.
  // Cells are mostly asked for in their order, so that the next one differs in the last levels.
  struct PathOfCell {
    Index root = 0;  // of the grid; 0 for no cell
    unsigned bisections = 0;
    Index cell = 0;
    std::array<Corners, max_bisections + 1> triangles{};
  };

  [[nodiscard]] Corners corners_of(Index cell) const {
    thread_local PathOfCell path;
    unsigned known = 0;  // triangles of the path that are those of this cell, too
    if (path.root == root_ && path.bisections == bisections_) {
      const auto differing = static_cast<unsigned>(std::bit_width(path.cell ^ cell));
      const unsigned levels = (differing + 1) / 2;
      known = levels > bisections_ ? 0 : bisections_ - levels + 1;
    }
    if (known == 0) path.triangles[0] = root_triangle(cell >> (2 * bisections_));
    for (unsigned level = std::max(known, 1U); level <= bisections_; ++level) {
      const Index part = cell >> (2 * (bisections_ - level)) & 3U;
      path.triangles[level] = part_of(path.triangles[level - 1], part);
    }
    path.root = root_;
    path.bisections = bisections_;
    path.cell = cell;
    return path.triangles[bisections_];
  }

  // Returns one of the four triangles that the middles of the sides divide a triangle into.
  static Corners part_of(const Corners& triangle, Index part) {
    const auto& [a, b, c] = triangle;
    switch (part) {
      case 0:
        return {middle_of(b, c), middle_of(c, a), middle_of(a, b)};
      case 1:
        return {a, middle_of(a, b), middle_of(c, a)};
      case 2:
        return {b, middle_of(b, c), middle_of(a, b)};
      default:
        return {c, middle_of(c, a), middle_of(b, c)};
    }
  }

  // Returns one of the root^2 triangles of each face: strips along the side between its first two
  // corners, each with triangles that point to the third one and others between them.
  [[nodiscard]] Corners root_triangle(Index triangle) const {
    const IcosahedronFace& face = faces_[triangle / (root_ * root_)];
    Index rest = triangle % (root_ * root_);
    Index row = 0;
    while (rest >= 2 * (root_ - row) - 1) rest -= 2 * (root_ - row++) - 1;
    const Index i = rest / 2;
    if (rest % 2 == 0) {
      return {root_point(face, i, row), root_point(face, i + 1, row), root_point(face, i, row + 1)};
    }
    return {root_point(face, i + 1, row), root_point(face, i + 1, row + 1),
            root_point(face, i, row + 1)};
  }
  // Returns the point i steps toward the second corner of a face and j steps toward the third one.
  // Terms of 0 leave the sums as they are, so that two faces agree on their common side.
  [[nodiscard]] Point root_point(const IcosahedronFace& face, Index i, Index j) const {
    const auto part = [&](Index steps, Index corner) {
      return static_cast<double>(steps) * corners_[face[corner]];
    };
    return normalized(part(root_ - i - j, 0) + part(i, 1) + part(j, 2));
  }

  Index root_;
  unsigned bisections_;
  std::vector<Point> corners_;
  std::vector<IcosahedronFace> faces_;
};

}  // namespace

std::unique_ptr<GridFormula> triangle_grid(unsigned root, unsigned bisections) {
  return std::make_unique<TriangleGrid>(root, bisections);
}

}  // namespace rondel::grids
