// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/slopes_of_cells.h"

#include <algorithm>
#include <cmath>

#include "exact/vector.h"
#include "system/parallel.h"

namespace rondel::overlay {
namespace {

// Of the determinant of the normal equations, relative to the square of their trace.
constexpr double least_determinant = 1e-9;

struct Sample {
  Index neighbor;
  double x;
  double y;
  double weight;
};

// Two directions at right angles to n and to each other.
std::pair<Point, Point> tangents(const Point& n) {
  const Point axis = std::abs(n.x) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point u = normalized(cross(n, axis));
  return {u, cross(n, u)};
}

// The cells that share an edge with others, by name.
class NeighborLists {
 public:
  NeighborLists(const PartitionData& cells, std::span<const std::int32_t> mask)
      : cells_(cells), mask_(mask) {}

  // Of cells in spatial order, where there is one.
  [[nodiscard]] Index name(std::size_t c) const {
    return cells_.grid() != nullptr ? static_cast<Index>(c) : cells_.subdivision().names[c];
  }
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
  const PartitionData& cells_;
  std::span<const std::int32_t> mask_;
};

}  // namespace

CellGradients cell_gradients(const PartitionData& cells, std::span<const Point> centers,
                             std::span<const std::int32_t> mask, unsigned threads) {
  const NeighborLists neighbors_of(cells, mask);
  const std::size_t n = centers.size();
  CellGradients result;
  result.offsets.assign(n + 1, 0);
  system::parallel_for(threads, n, cells_per_piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      result.offsets[neighbors_of.name(c) + std::size_t{1}] =
          neighbors_of(static_cast<Index>(c)).size();
    }
  });
  for (std::size_t i = 0; i < n; ++i) result.offsets[i + 1] += result.offsets[i];
  result.neighbors.resize(result.offsets[n]);
  result.slopes.resize(result.offsets[n]);
  const auto fit = [&](Index c) {
    const Index name = neighbors_of.name(c);
    const Point& center = centers[name];
    const auto [u, v] = tangents(normalized(center));
    std::vector<Sample> samples;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const Index neighbor : neighbors_of(c)) {
      const Point step = centers[neighbor] - center;
      const Sample sample{neighbor, dot(u, step), dot(v, step), 1 / dot(step, step)};
      samples.push_back(sample);
      xx += sample.weight * sample.x * sample.x;
      xy += sample.weight * sample.x * sample.y;
      yy += sample.weight * sample.y * sample.y;
    }
    const double determinant = xx * yy - xy * xy;
    const bool is_determined = determinant > least_determinant * (xx + yy) * (xx + yy);
    std::uint64_t k = result.offsets[name];
    for (const Sample& s : samples) {
      result.neighbors[k] = s.neighbor;
      if (is_determined) {
        const double along_u = s.weight * (yy * s.x - xy * s.y) / determinant;
        const double along_v = s.weight * (xx * s.y - xy * s.x) / determinant;
        result.slopes[k] = along_u * u + along_v * v;
      }
      ++k;
    }
  };
  system::parallel_for(threads, n, cells_per_piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) fit(static_cast<Index>(c));
  });
  return result;
}

}  // namespace rondel::overlay
