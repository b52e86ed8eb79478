// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/graph_laplacian.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "meshing/tangent.h"
#include "rondel/compressed_rows.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::mesh {
namespace {

// A graph of so few vertices is solved by smoothing alone.
constexpr std::size_t coarsest_size = 40;
// The factor of Jacobi's step: L of a triangulation has eigenvalues below twice its diagonal, and
// this factor damps the upper half of them.
constexpr double damping = 0.6;
// Piecewise constant corrections are too small (Braess, Computing 55, 1995), so they are multiplied
// by this.
constexpr double overcorrection = 1.6;
constexpr int coarsest_sweeps = 60;

// Returns the scalar product, summed in a fixed order.
double dot_of(unsigned threads, const std::vector<double>& a, const std::vector<double>& b) {
  return sum_in_order(threads, a.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += a[i] * b[i];
    return sum;
  });
}

// Subtracts the mean.
void take_mean_off(std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value;
  const double mean = sum / static_cast<double>(x.size());
  for (double& value : x) value -= mean;
}

// Groups vertices: a vertex that has no group begins one with its neighbors that have none; if
// these are few, it joins the group of the neighbor with the largest weight.
std::vector<Index> groups_of(const WeightedGraph& graph, Index& num_groups) {
  std::vector<Index> group(graph.size(), no_index);
  num_groups = 0;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (group[i] != no_index) continue;
    bool is_free = true;
    for (auto k = graph.offsets[i]; k < graph.offsets[i + 1]; ++k) {
      is_free = is_free && group[graph.neighbors[k]] == no_index;
    }
    if (!is_free) continue;
    group[i] = num_groups;
    for (auto k = graph.offsets[i]; k < graph.offsets[i + 1]; ++k) {
      group[graph.neighbors[k]] = num_groups;
    }
    ++num_groups;
  }
  const std::vector<Index> roots = group;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (group[i] != no_index) continue;
    double most = 0;
    for (auto k = graph.offsets[i]; k < graph.offsets[i + 1]; ++k) {
      const Index of_neighbor = roots[graph.neighbors[k]];
      if (of_neighbor == no_index || graph.weights[k] <= most) continue;
      most = graph.weights[k];
      group[i] = of_neighbor;
    }
    if (group[i] == no_index) group[i] = num_groups++;
  }
  return group;
}

// Returns the graph of the groups, whose weights are the sums of the weights between their
// vertices.
WeightedGraph coarse_graph(const WeightedGraph& fine, const std::vector<Index>& group,
                           std::size_t num_groups) {
  system::RowPlaces places(num_groups);
  for (const Index g : group) places.count(g);
  CompressedRows<Index> members;
  members.values.resize(places.sum());
  for (std::size_t i = 0; i < group.size(); ++i) {
    members.values[places.place(group[i])] = static_cast<Index>(i);
  }
  members.offsets = std::move(places).offsets();

  WeightedGraph coarse;
  std::vector<std::uint64_t> place(num_groups, 0);  // 1 + the position of this neighbor in the row
  for (std::size_t g = 0; g < num_groups; ++g) {
    const std::size_t begin = coarse.neighbors.size();
    for (const Index i : members[g]) {
      for (auto k = fine.offsets[i]; k < fine.offsets[i + 1]; ++k) {
        const Index h = group[fine.neighbors[k]];
        if (h == g) continue;
        if (place[h] <= begin) {
          coarse.neighbors.push_back(h);
          coarse.weights.push_back(0);
          place[h] = coarse.neighbors.size();
        }
        coarse.weights[place[h] - 1] += fine.weights[k];
      }
    }
    double sum = 0;
    for (std::size_t k = begin; k < coarse.weights.size(); ++k) sum += coarse.weights[k];
    coarse.diagonal.push_back(sum);
    coarse.end_row();
  }
  return coarse;
}

}  // namespace

LaplacianSolver::LaplacianSolver(WeightedGraph graph, unsigned threads) : threads_(threads) {
  levels_.push_back({.graph = std::move(graph), .group{}, .right{}, .solution{}, .rest{}});
  while (levels_.back().graph.size() > coarsest_size) {
    GraphLevel& fine = levels_.back();
    Index num_groups = 0;
    fine.group = groups_of(fine.graph, num_groups);
    if (num_groups == fine.graph.size()) break;
    WeightedGraph coarse = coarse_graph(fine.graph, fine.group, num_groups);
    levels_.push_back({.graph = std::move(coarse), .group{}, .right{}, .solution{}, .rest{}});
  }
  for (GraphLevel& level : levels_) {
    level.right.resize(level.graph.size());
    level.solution.resize(level.graph.size());
    level.rest.resize(level.graph.size());
  }
}

void LaplacianSolver::multiply(const WeightedGraph& graph, const std::vector<double>& x,
                               std::vector<double>& result) const {
  system::parallel_for(threads_, graph.size(), terms_at_a_time,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           double sum = 0;
                           for (auto k = graph.offsets[i]; k < graph.offsets[i + 1]; ++k) {
                             sum += graph.weights[k] * (x[i] - x[graph.neighbors[k]]);
                           }
                           result[i] = sum;
                         }
                       });
}

void LaplacianSolver::smooth(GraphLevel& level) const {
  multiply(level.graph, level.solution, level.rest);
  for (std::size_t i = 0; i < level.graph.size(); ++i) {
    level.solution[i] += damping * (level.right[i] - level.rest[i]) / level.graph.diagonal[i];
  }
}

// Smooths in the same symmetric way before and after the coarse correction, so that the cycle is
// symmetric.
void LaplacianSolver::cycle(std::size_t number) {
  GraphLevel& level = levels_[number];
  std::ranges::fill(level.solution, 0.0);
  if (number + 1 == levels_.size()) {
    for (int sweep = 0; sweep < coarsest_sweeps; ++sweep) smooth(level);
    return;
  }
  smooth(level);
  smooth(level);
  multiply(level.graph, level.solution, level.rest);
  GraphLevel& coarse = levels_[number + 1];
  std::ranges::fill(coarse.right, 0.0);
  for (std::size_t i = 0; i < level.group.size(); ++i) {
    coarse.right[level.group[i]] += level.right[i] - level.rest[i];
  }
  cycle(number + 1);
  for (std::size_t i = 0; i < level.group.size(); ++i) {
    level.solution[i] += overcorrection * coarse.solution[level.group[i]];
  }
  smooth(level);
  smooth(level);
}

int LaplacianSolver::solve(std::span<const double> right, double tolerance, int max_steps,
                           std::vector<double>& solution) {
  GraphLevel& finest = levels_.front();
  std::vector<double> rest(right.begin(), right.end());
  take_mean_off(rest);
  solution.assign(rest.size(), 0);
  std::vector<double> direction(rest.size());
  std::vector<double> image(rest.size());
  const double goal = tolerance * std::sqrt(dot_of(threads_, rest, rest));
  double last = 1;
  for (int step = 0; step < max_steps; ++step) {
    if (std::sqrt(dot_of(threads_, rest, rest)) <= goal) return step;
    finest.right = rest;
    cycle(0);
    take_mean_off(finest.solution);
    const double now = dot_of(threads_, rest, finest.solution);
    const double beta = step == 0 ? 0 : now / last;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      direction[i] = finest.solution[i] + beta * direction[i];
    }
    multiply(finest.graph, direction, image);
    const double alpha = now / dot_of(threads_, direction, image);
    for (std::size_t i = 0; i < rest.size(); ++i) {
      solution[i] += alpha * direction[i];
      rest[i] -= alpha * image[i];
    }
    last = now;
  }
  return max_steps;
}

}  // namespace rondel::mesh
