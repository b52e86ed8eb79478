// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Solves L x = b for the Laplacian of a connected graph with positive weights, (L x)_i = sum over
// the neighbors j of w_ij (x_i - x_j), by conjugate gradients that are preconditioned by a
// multigrid cycle. A coarse vertex is a group of vertices; the weights between groups add up. Sums
// have a fixed order.
//
// in    a symmetric weighted graph, a right-hand side
// out   the solution with mean 0
// index vertices of the graph
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::mesh {

// A graph in compressed rows: the neighbors of vertex i are neighbors[offsets[i]] ...
// [offsets[i+1]-1], each edge is in both rows.
struct WeightedGraph {
  std::vector<std::uint64_t> offsets = {0};
  std::vector<Index> neighbors;
  std::vector<double> weights;
  std::vector<double> diagonal;  // sum of the weights of each row

  [[nodiscard]] std::size_t size() const { return diagonal.size(); }
  void end_row() { offsets.push_back(neighbors.size()); }
};

// Solves equations with one Laplacian; the coarser graphs are made once.
class LaplacianSolver {
 public:
  LaplacianSolver(WeightedGraph graph, unsigned threads);

  // Solves until the residual is `tolerance` times as long as the right-hand side, or for
  // `max_steps` steps, and returns the number of steps. The mean of the right-hand side is
  // subtracted first; the solution has mean 0.
  int solve(std::span<const double> right, double tolerance, int max_steps,
            std::vector<double>& solution);

 private:
  // A graph of the multigrid cycle, the finest first, with the vectors of the cycle on it.
  struct GraphLevel {
    WeightedGraph graph;
    std::vector<Index> group;  // by vertex: its coarse vertex
    std::vector<double> right;
    std::vector<double> solution;
    std::vector<double> rest;
  };

  // Improves the solution on a level by smoothing, a correction from the coarser level, and
  // smoothing.
  void cycle(std::size_t number);
  // Takes one damped Jacobi step.
  void smooth(GraphLevel& level) const;
  // Sets result = L x.
  void multiply(const WeightedGraph& graph, const std::vector<double>& x,
                std::vector<double>& result) const;

  std::vector<GraphLevel> levels_;
  unsigned threads_;
};

}  // namespace rondel::mesh
