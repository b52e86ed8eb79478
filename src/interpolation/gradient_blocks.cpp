// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/gradient_blocks.h"

#include "exact/vector.h"
#include "interpolation/linear.h"

namespace rondel::interpolation {
namespace {

// The square of the chord of 120 degrees. Farther neighbors are left out, since they would lie too
// far out in the stereographic plane.
constexpr double largest_squared_chord = 3;

constexpr std::size_t usual_neighbors = 20;

// Vertices with at least this many neighbors are sorted as one size.
constexpr std::size_t num_sizes = 64;

}  // namespace

GradientBlocks::GradientBlocks(const PreparedTriangulation& prepared, SolidRings& finder,
                               const GradientOptions& options, std::size_t begin, std::size_t end)
    : prepared_(prepared),
      with_lines_(options.undetermined == Undetermined::zero),
      begin_(begin),
      num_near_(end - begin),
      order_(end - begin) {
  neighbors_.reserve(usual_neighbors * (end - begin));
  starts_.reserve(end - begin + 1);
  for (std::size_t v = begin; v < end; ++v) {
    const std::span<const Index> found = finder.find(static_cast<Index>(v), options.rings);
    neighbors_.insert(neighbors_.end(), found.begin(), found.end());
    starts_.push_back(neighbors_.size());
  }
  sort_by_size();
}

void GradientBlocks::sort_by_size() {
  const auto size_of = [this](std::size_t i) { return std::min(max_neighbors(i), num_sizes - 1); };
  std::array<Index, num_sizes + 1> places{};
  for (std::size_t i = 0; i < size(); ++i) ++places[size_of(i) + 1];
  for (std::size_t s = 0; s < num_sizes; ++s) places[s + 1] += places[s];
  for (std::size_t i = 0; i < size(); ++i) order_[places[size_of(i)]++] = static_cast<Index>(i);
}

void GradientBlocks::fit(std::span<const Index> members) {
  std::size_t most = 0;
  for (const Index i : members) most = std::max(most, max_neighbors(i));
  fits_.start(most);
  for (std::size_t lane = 0; lane < members.size(); ++lane) add_neighbors(lane, members[lane]);
  fits_.find(with_lines_);
}

void GradientBlocks::add_neighbors(std::size_t lane, std::size_t i) {
  const auto v = static_cast<Index>(begin_ + i);
  const exact::SplitPoint x = prepared_.unit(v);  // a copy, so that the compiler knows that writing
                                                  // below does not change it
  Index* const neighbors = neighbors_.data() + starts_[i];
  const std::size_t count = max_neighbors(i);
  std::size_t num_near = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Index neighbor = neighbors[k];
    Vec to_neighbor = step(x, prepared_.unit(neighbor));
    if (!is_split_enough(to_neighbor)) {
      to_neighbor = exact_step(prepared_, {prepared_.point(v), x, {}}, neighbor);
    }
    if (dot(to_neighbor, to_neighbor) > largest_squared_chord) continue;
    fits_.set_neighbor(lane, num_near, to_neighbor);
    neighbors[num_near++] = neighbor;
  }
  num_near_[i] = num_near;
  fits_.set_site(lane, exact::to_vector(x.hi), num_near);
}

}  // namespace rondel::interpolation
