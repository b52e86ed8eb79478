// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>

#include "exact/vector.h"
#include "overlay/linear_weights.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::overlay {
namespace {

// The normal equations determine a direction if their eigenvalue for it is at least this share of
// the largest one. Two neighbors on a line that bends by the angle b have a share of tan^2(b / 2).
// Along a parallel b is about the width of the cells in radians; the curvature of a field, divided
// by b, would be taken for a gradient across the line.
constexpr double min_share = 1.0 / 16;

// The least squared distance between centers that counts, relative to the area of the cell. A cell
// inside of a ring may have the same center as the ring; the difference of their means is no
// gradient. If only one direction is determined, its neighbors must be beside the cell, so the
// bound is larger.
constexpr double min_square = 0x1p-16;
constexpr double min_square_on_line = 0x1p-6;

// A neighbor in the tangent plane: the coordinates of its center, and its weight.
struct Sample {
  Index neighbor;
  double x;
  double y;
  double weight;
};

// Returns two unit vectors orthogonal to n and to each other.
std::pair<Point, Point> tangents(const Point& n) {
  const Point axis = std::abs(n.x) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point u = normalized(cross(n, axis));
  return {u, cross(n, u)};
}

// A vector of the tangent plane.
struct Slope {
  double along_u;
  double along_v;
};

// The normal equations of the least squares gradient and their inverse. Along directions that they
// do not determine, gradients are 0.
class SlopeEquations {
 public:
  explicit SlopeEquations(double area) : area_(area) {}

  // Adds a neighbor. Returns false if it takes no part: it is too near, or its center is nearly
  // opposite, so that it is in no direction.
  bool add(const Sample& s) {
    const bool is_in_plane = s.weight * (s.x * s.x + s.y * s.y) >= min_share;
    if (!is_in_plane || !(s.weight * min_square * area_ <= 1)) return false;
    largest_weight_ = std::max(largest_weight_, s.weight);
    xx_ += s.weight * s.x * s.x;
    xy_ += s.weight * s.x * s.y;
    yy_ += s.weight * s.y * s.y;
    return true;
  }
  // Computes the inverse, or, if only one direction is determined, that direction.
  void solve() {
    const double trace = xx_ + yy_;
    determinant_ = xx_ * yy_ - xy_ * xy_;
    if (determinant_ > min_share / ((1 + min_share) * (1 + min_share)) * trace * trace) return;
    determinant_ = 0;
    if (!(largest_weight_ * min_square_on_line * area_ <= 1)) return;
    const double difference = xx_ - yy_;
    largest_ = (trace + std::sqrt(difference * difference + 4 * xy_ * xy_)) / 2;
    const double x = difference > 0 ? largest_ - yy_ : xy_;
    const double y = difference > 0 ? xy_ : largest_ - xx_;
    const double square = x * x + y * y;
    if (!(square > 0 && largest_ > 0)) return;
    x_ = x / std::sqrt(square);
    y_ = y / std::sqrt(square);
  }
  // Returns the vector that the difference of the neighbor's mean is multiplied by.
  [[nodiscard]] Slope slope_of(const Sample& s) const {
    if (determinant_ > 0) {
      return {s.weight * (yy_ * s.x - xy_ * s.y) / determinant_,
              s.weight * (xx_ * s.y - xy_ * s.x) / determinant_};
    }
    if (!(largest_ > 0)) return {};
    const double along = s.weight * (x_ * s.x + y_ * s.y) / largest_;
    return {along * x_, along * y_};
  }

 private:
  double area_;
  double largest_weight_ = 0;
  double xx_ = 0;
  double xy_ = 0;
  double yy_ = 0;
  double determinant_ = 0;  // 0 if a direction is not determined
  double largest_ = 0;      // the largest eigenvalue; (x_, y_) is its direction
  double x_ = 0;
  double y_ = 0;
};

// Finds the neighbors of cells: those that share an edge and are not masked.
class NeighborLists {
 public:
  NeighborLists(const CellSetData& cells, std::span<const std::int32_t> mask)
      : cells_(cells), mask_(mask) {}

  // Returns the index in the input of the cell at place c of the spatial order; a grid is in its
  // own order.
  [[nodiscard]] Index name(std::size_t c) const {
    return cells_.grid() != nullptr ? static_cast<Index>(c) : cells_.subdivision().names[c];
  }
  // Returns the neighbors of the cell at place c, as indices in the input, ascending.
  [[nodiscard]] std::vector<Index> operator()(Index c) const {
    std::vector<Index> neighbors;
    if (cells_.grid() != nullptr) {
      cells_.grid()->append_neighbors(c, neighbors);
    } else {
      const Subdivision& cells = cells_.subdivision();
      for (Halfedge h = cells.begin_of(c); h < cells.end_of(c); ++h) {
        const Halfedge twin = cells.twins[h];
        if (twin != no_index) neighbors.push_back(cells.names[cells.cell_of[twin]]);
      }
    }
    std::ranges::sort(neighbors);
    neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
    std::erase_if(neighbors, [&](Index neighbor) {
      return neighbor == name(c) || (!mask_.empty() && mask_[neighbor] == 0);
    });
    return neighbors;
  }

 private:
  const CellSetData& cells_;
  std::span<const std::int32_t> mask_;
};

}  // namespace

CellGradients cell_gradients(const CellSetData& cells, std::span<const Point> centers,
                             std::span<const std::int32_t> mask, unsigned threads) {
  const NeighborLists neighbors_of(cells, mask);
  const std::size_t n = centers.size();
  CellGradients result;
  result.offsets.assign(n + 1, 0);
  system::parallel_for(threads, n, cells_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      result.offsets[neighbors_of.name(c) + std::size_t{1}] =
          neighbors_of(static_cast<Index>(c)).size();
    }
  });
  system::sum_counts(result.offsets);
  result.neighbors.resize(result.offsets[n]);
  result.slopes.resize(result.offsets[n]);
  const auto fit = [&](Index c) {
    const Index name = neighbors_of.name(c);
    const Point& center = centers[name];
    const auto [u, v] = tangents(normalized(center));
    std::vector<Sample> samples;
    SlopeEquations equations(cells.areas()[name]);
    for (const Index neighbor : neighbors_of(c)) {
      const Point step = centers[neighbor] - center;
      Sample sample{neighbor, dot(u, step), dot(v, step), 1 / dot(step, step)};
      if (!equations.add(sample)) sample.weight = 0;
      samples.push_back(sample);
    }
    equations.solve();
    std::uint64_t k = result.offsets[name];
    for (const Sample& s : samples) {
      result.neighbors[k] = s.neighbor;
      const auto [along_u, along_v] = equations.slope_of(s);
      result.slopes[k] = along_u * u + along_v * v;
      ++k;
    }
  };
  system::parallel_for(threads, n, cells_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) fit(static_cast<Index>(c));
  });
  return result;
}

}  // namespace rondel::overlay
