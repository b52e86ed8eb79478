// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/gradient.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "exact/vector.h"
#include "interpolation/linear.h"
#include "interpolation/local_fit.h"
#include "interpolation/solid_rings.h"
#include "system/parallel.h"

namespace rondel::interpolation {
namespace {

constexpr std::size_t gradients_per_piece = 1024;

// Neighbors farther than 120 degrees are left out: in the stereographic plane they would be too far.
constexpr double largest_squared_chord = 3;

// Of vertices closer than its reciprocal no gradient can be had: it would not be a number.
constexpr double largest_gradient_weight = 0x1p500;

class GradientFinder {
 public:
  GradientFinder(const Ground& ground, const SolidStars& stars, unsigned rings)
      : ground_(ground), rings_(stars), num_rings_(rings) {}

  // Whether v has a gradient: the sum of weights() times differences of values from v's.
  bool find(Index v) {
    const exact::SplitPoint& x = ground_.unit(v);
    const TargetPlace place{ground_.point(v), x, {}};
    neighbors_.clear();
    steps_.clear();
    for (const Index w : rings_.find(v, num_rings_)) {
      const Vec to_w = careful_step(ground_, place, w);
      if (dot(to_w, to_w) > largest_squared_chord) continue;
      neighbors_.push_back(w);
      steps_.push_back(to_w);
    }
    return fit_.find(exact::to_vector(x.hi), steps_, weights_) &&
           std::ranges::all_of(weights_, [](const Vec& weight) {
             return std::abs(weight.x) <= largest_gradient_weight &&
                    std::abs(weight.y) <= largest_gradient_weight &&
                    std::abs(weight.z) <= largest_gradient_weight;
           });
  }
  [[nodiscard]] const std::vector<Index>& neighbors() const { return neighbors_; }
  [[nodiscard]] const std::vector<Vec>& weights() const { return weights_; }

 private:
  const Ground& ground_;
  SolidRings rings_;
  unsigned num_rings_;
  LocalFit fit_;
  std::vector<Index> neighbors_;
  std::vector<Vec> steps_;
  std::vector<Vec> weights_;
};

void append_row(Index v, const GradientFinder& found, GradientRows& rows) {
  Vec sum{0, 0, 0};
  for (const Vec& weight : found.weights()) sum = sum + weight;
  rows.vertices.push_back(v);
  rows.weights.push_back(exact::to_point(-1 * sum));
  rows.vertices.insert(rows.vertices.end(), found.neighbors().begin(), found.neighbors().end());
  for (const Vec& weight : found.weights()) rows.weights.push_back(exact::to_point(weight));
}

GradientRows joined(const std::vector<GradientRows>& pieces, unsigned threads) {
  GradientRows all;
  std::vector<std::size_t> first_rows;
  std::vector<std::size_t> first_entries;
  std::size_t num_entries = 0;
  std::size_t num_rows = 0;
  for (const GradientRows& piece : pieces) {
    first_rows.push_back(num_rows);
    first_entries.push_back(num_entries);
    num_rows += piece.offsets.size() - 1;
    num_entries += piece.vertices.size();
  }
  all.offsets.resize(num_rows + 1);
  all.vertices.resize(num_entries);
  all.weights.resize(num_entries);
  all.offsets[num_rows] = num_entries;
  system::parallel_for(threads, pieces.size(), 1, [&](std::size_t p, std::size_t /*end*/) {
    const GradientRows& piece = pieces[p];
    const auto entry = static_cast<std::ptrdiff_t>(first_entries[p]);
    for (std::size_t r = 0; r + 1 < piece.offsets.size(); ++r) {
      all.offsets[first_rows[p] + r] = first_entries[p] + piece.offsets[r];
    }
    std::ranges::copy(piece.vertices, all.vertices.begin() + entry);
    std::ranges::copy(piece.weights, all.weights.begin() + entry);
  });
  return all;
}

}  // namespace

GradientRows gradient_rows(const Ground& ground, const GradientOptions& options, unsigned threads) {
  constexpr std::size_t usual_entries = 21;
  const SolidStars stars(ground, threads);
  const std::size_t n = ground.num_vertices();
  std::vector<GradientRows> pieces(system::num_pieces(n, gradients_per_piece));
  system::parallel_for(threads, n, gradients_per_piece, [&](std::size_t begin, std::size_t end) {
    GradientFinder finder(ground, stars, options.rings);
    GradientRows& rows = pieces[begin / gradients_per_piece];
    rows.vertices.reserve(usual_entries * (end - begin));
    rows.weights.reserve(usual_entries * (end - begin));
    for (std::size_t v = begin; v < end; ++v) {
      if (finder.find(static_cast<Index>(v))) append_row(static_cast<Index>(v), finder, rows);
      rows.offsets.push_back(rows.vertices.size());
    }
  });
  return joined(pieces, threads);
}

}  // namespace rondel::interpolation
