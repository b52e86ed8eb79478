// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/input.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/vector.h"

namespace rondel::bulk {
namespace {

// The distances of weighted sites from the center, rounded outwards.
void find_sizes(Input& input) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  const auto center = exact::to_vector(input.center());
  for (const Point& p : input.sites) {
    const auto ray = exact::to_vector(p) - center;
    const double size2 = dot(ray, ray);
    least = std::min(least, size2);
    most = std::max(most, size2);
  }
  // Where squares lose bits no bound is finite, and the exact rungs decide.
  constexpr double min_square = 1e-280;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  input.extent.min_size = least > min_square ? std::sqrt(least) * (1 - 0x1p-48) : 0;
  input.extent.max_size = most > min_square ? std::sqrt(most) * (1 + 0x1p-48) : infinity;
}

}  // namespace

Input make_input(std::span<const Point> sites, std::span<const Index> order,
                 const system::Job& options, const system::SiteCopies& copies) {
  Input input = {sites, order, options, copies};
  if (options.model == Model::weighted) find_sizes(input);
  return input;
}

}  // namespace rondel::bulk
