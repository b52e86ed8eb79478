// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Solves L x = b for the Laplacian of a connected graph with positive weights, (L x)_i = sum over the
// neighbors j of w_ij (x_i - x_j): conjugate gradients, preconditioned by a cycle over coarser graphs. A coarse
// vertex is a group of vertices; between coarse vertices the weights add up. Sums have a fixed order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::mesh {

// In compressed rows: the neighbors of i are neighbors[offsets[i]] ... [offsets[i+1]-1]; symmetric.
struct WeightedGraph {
  std::vector<std::uint64_t> offsets;
  std::vector<Index> neighbors;
  std::vector<double> weights;
  std::vector<double> diagonal;  // the sums of the rows

  [[nodiscard]] std::size_t size() const { return diagonal.size(); }
};

class LaplacianSolver {
 public:
  LaplacianSolver(WeightedGraph graph, unsigned threads);

  // The solution with mean 0, to this part of the right-hand side's length, or after the most steps. The mean of
  // the right-hand side is taken off. Returns the number of steps.
  int solve(std::span<const double> right, double tolerance, int most_steps,
            std::vector<double>& solution);

 private:
  struct GraphLevel {
    WeightedGraph graph;
    std::vector<Index> group;  // the coarse vertex of each
    std::vector<double> right;
    std::vector<double> solution;
    std::vector<double> rest;
  };

  void cycle(std::size_t number);
  void smooth(GraphLevel& level) const;
  void multiply(const WeightedGraph& graph, const std::vector<double>& x,
                std::vector<double>& result) const;

  std::vector<GraphLevel> levels_;
  unsigned threads_;
};

}  // namespace rondel::mesh
