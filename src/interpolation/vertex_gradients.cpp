// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/vertex_gradients.h"

#include <algorithm>

#include "exact/vector.h"
#include "interpolation/gradient_blocks.h"
#include "interpolation/normalize_weights.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "system/row_assembly.h"

namespace rondel::interpolation {
namespace {

constexpr std::size_t vertices_at_once = 2048;

// Estimates the gradients of all fields at the vertices of a range, which begins at `begin`. The
// gradients of a vertex are adjacent; has_gradient says whether it has any.
void estimate_blocks(GradientBlocks& blocks, const VertexFields& values, std::size_t begin,
                     Point* gradients, std::uint8_t* has_gradient) {
  const std::size_t num_fields = values.num_fields();
  std::vector<LocalFits::Lanes> at_neighbors;
  blocks.for_each_block([&](const LocalFits& fits, std::span<const Index> members) {
    for (std::size_t f = 0; f < num_fields; ++f) {
      LocalFits::Lanes here{};
      at_neighbors.resize(fits.num_places());
      for (std::size_t lane = 0; lane < members.size(); ++lane) {
        here[lane] = values(f, static_cast<Index>(begin + members[lane]));
        const std::span<const Index> neighbors = blocks.neighbors(members[lane]);
        for (std::size_t k = 0; k < neighbors.size(); ++k) {
          at_neighbors[k][lane] = values(f, neighbors[k]);
        }
      }
      const LocalFits::LaneVectors found = fits.gradients(at_neighbors, here);
      for (std::size_t lane = 0; lane < members.size(); ++lane) {
        const Index i = members[lane];
        has_gradient[i] = fits.has_gradient(lane) ? 1 : 0;
        if (!fits.has_gradient(lane)) continue;
        gradients[i * num_fields + f] = {found.x[lane], found.y[lane], found.z[lane]};
      }
    }
  });
}

}  // namespace

std::vector<std::uint8_t> vertices_with(const GradientRows& rows) {
  std::vector<std::uint8_t> result;
  for (std::size_t v = 0; v + 1 < rows.offsets.size(); ++v) {
    if (rows.offsets[v] != rows.offsets[v + 1]) continue;
    if (result.empty()) result.assign(rows.offsets.size() - 1, 1);
    result[v] = 0;
  }
  return result;
}

VertexGradients::VertexGradients(const GradientRows& rows, const VertexFields& values,
                                 unsigned threads)
    : num_fields_(values.num_fields()) {
  const std::size_t n = rows.offsets.size() - 1;
  by_vertex_.resize(num_fields_ * n);
  const auto estimate = [&](std::size_t v, std::size_t f) {
    Point sum{};
    const std::uint64_t first = rows.offsets[v];
    if (first == rows.offsets[v + 1]) return sum;
    const double here = values(f, rows.vertices[first]);
    for (std::uint64_t k = first + 1; k < rows.offsets[v + 1]; ++k) {
      sum = sum + (values(f, rows.vertices[k]) - here) * rows.weights[k];
    }
    return sum;
  };
  system::parallel_for(threads, n, vertices_at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      for (std::size_t f = 0; f < num_fields_; ++f) {
        by_vertex_[v * num_fields_ + f] = estimate(v, f);
      }
    }
  });
}

VertexGradients::VertexGradients(const PreparedTriangulation& prepared,
                                 const GradientOptions& options, const VertexFields& values,
                                 unsigned threads, std::vector<std::uint8_t>& has_gradient)
    : num_fields_(values.num_fields()) {
  const std::size_t n = prepared.num_vertices();
  by_vertex_.assign(num_fields_ * n, Point{});
  has_gradient.assign(n, 0);
  for_each_range_of_blocks(
      prepared, options, threads, [&](GradientBlocks& blocks, std::size_t begin) {
        estimate_blocks(blocks, values, begin, &by_vertex_[begin * num_fields_],
                        &has_gradient[begin]);
      });
  if (std::ranges::find(has_gradient, 0) == has_gradient.end()) has_gradient.clear();
}

VertexGradients::VertexGradients(const PreparedTriangulation& prepared,
                                 std::span<const Point> given, SharedPlace shared, unsigned threads)
    : num_fields_(given.size() / prepared.num_sites()) {
  const std::size_t n = prepared.num_vertices();
  const auto names = prepared.names();
  by_vertex_.resize(num_fields_ * n);
  const auto gather = [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = 0; f < num_fields_; ++f) {
      const Point* const field = &given[f * prepared.num_sites()];
      for (std::size_t v = begin; v < end; ++v) {
        const std::size_t ahead = v + system::prefetch_distance;
        if (ahead < end) system::prefetch(&field[names[ahead]]);
        by_vertex_[v * num_fields_ + f] = field[names[v]];
      }
    }
  };
  system::parallel_for(threads, n, vertices_at_once, gather);
  if (shared == SharedPlace::mean) take_means(prepared, given);
}

void VertexGradients::take_means(const PreparedTriangulation& prepared,
                                 std::span<const Point> given) {
  for (const auto& [vertex, sites] : shared_places(prepared)) {
    for (std::size_t f = 0; f < num_fields_; ++f) {
      const Point* const own = &given[f * prepared.num_sites()];
      by_vertex_[vertex * num_fields_ + f] = {mean_of(sites, [&](Index i) { return own[i].x; }),
                                              mean_of(sites, [&](Index i) { return own[i].y; }),
                                              mean_of(sites, [&](Index i) { return own[i].z; })};
    }
  }
}

Weights gradient_weights(const PreparedTriangulation& prepared, const GradientRows& rows,
                         unsigned threads) {
  const std::size_t n = prepared.num_sites();
  Weights weights;
  weights.num_columns = n;
  const auto size_of = [&](Index v) { return rows.offsets[v + std::size_t{1}] - rows.offsets[v]; };
  weights.offsets = system::offsets_of(3 * n, [&](std::size_t row) {
    return size_of(prepared.vertex_of(static_cast<Index>(row / 3)));
  });
  weights.columns.resize(weights.offsets.back());
  weights.values.resize(weights.offsets.back());
  system::parallel_for(threads, n, vertices_at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Index v = prepared.vertex_of(static_cast<Index>(i));
      const std::uint64_t size = size_of(v);
      const std::uint64_t from = rows.offsets[v];
      const std::uint64_t to = weights.offsets[3 * i];
      for (std::uint64_t k = 0; k < size; ++k) {
        const Index column = prepared.name(rows.vertices[from + k]);
        const Point& weight = rows.weights[from + k];
        for (std::size_t c = 0; c < 3; ++c) weights.columns[to + c * size + k] = column;
        weights.values[to + k] = weight.x;
        weights.values[to + size + k] = weight.y;
        weights.values[to + 2 * size + k] = weight.z;
      }
    }
  });
  return weights;
}

// Terms of one vertex are added up in the order of the row.
const Row& GradientJoiner::operator()(const GradientRow& row) {
  shares_.clear();
  for (const auto& [vertex, weight, slope] : row) {
    shares_.push_back({vertex, weight});
    if (slope == Point{}) continue;
    for (std::uint64_t k = gradients_->offsets[vertex];
         k < gradients_->offsets[vertex + std::size_t{1}]; ++k) {
      shares_.push_back({gradients_->vertices[k], dot(slope, gradients_->weights[k])});
    }
  }
  merge();
  if (normalization_ == Normalization::unity && !joined_.empty()) take_up_rounding(joined_);
  return joined_;
}

void GradientJoiner::merge() {
  std::ranges::stable_sort(shares_, {}, &WeightedVertex::vertex);
  joined_.clear();
  for (const WeightedVertex& share : shares_) {
    if (!joined_.empty() && joined_.back().vertex == share.vertex) {
      joined_.back().weight += share.weight;
    } else {
      joined_.push_back(share);
    }
  }
}

}  // namespace rondel::interpolation
