// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/triangulate.h"

#include <optional>
#include <utility>

#include "bulk/blocks.h"
#include "bulk/sphere.h"

namespace rondel::bulk {
namespace {

// With fewer the parts of a sphere would be too small to pay, and most sites of blocks in the seam.
constexpr std::size_t min_sphere_sites = 128;
constexpr std::size_t min_block_sites = std::size_t{1} << 13;

// Between neighbors on a sphere the squared distance is 4 pi / n on average, and weights must differ
// by as much if one is to hide another.
bool are_weights_close(const Input& input) {
  const Extent& extent = input.extent;
  const auto num_sites = static_cast<double>(input.order.size());
  return num_sites * (extent.max_size - extent.min_size) < 4 * extent.min_size;
}

}  // namespace

kernel::Triangulated triangulate(std::span<const Point> sites, std::vector<Index> order,
                                 std::span<const order::Renamed> renamed,
                                 const system::Job& options, LargeVector<Triple> copies,
                                 std::size_t max_sphere_sites) {
  const Input input = make_input(sites, order, options, system::SiteCopies(std::span(copies)));
  const std::size_t num_sites = order.size();
  std::optional<bool> trial;  // it takes time, and may not be needed
  const auto have_blocks = [&] {
    if (!trial) trial = num_sites >= min_block_sites && has_short_seams(input);
    return *trial;
  };
  const bool is_sphere = num_sites >= min_sphere_sites && num_sites <= max_sphere_sites &&
                         surround_center(sites, options.sphere.center);
  std::optional<kernel::Triangulated> result;
  if (is_sphere && (are_weights_close(input) || have_blocks())) {
    result = triangulate_sphere(input, renamed);
  }
  if (!result && have_blocks()) {
    result = triangulate_by_blocks(input, renamed, default_max_block_sites, std::move(copies));
  }
  if (result) return *std::move(result);
  copies = {};
  return kernel::triangulate(sites, std::move(order), renamed, options);
}

}  // namespace rondel::bulk
