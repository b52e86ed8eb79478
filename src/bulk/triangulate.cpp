// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/triangulate.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "bulk/block.h"
#include "bulk/sphere.h"
#include "bulk/stitch.h"
#include "models/with_model.h"
#include "predicates/rung.h"
#include "system/mutex.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::bulk {
namespace {

using kernel::Triangulated;

// The whole sphere at once from so many sites on, or its parts would be too small to pay, and up to
// so many, or its mesh would not fit into the second cache, more or less.
constexpr std::size_t least_sphere_sites = 128;
constexpr std::size_t sphere_sites = std::size_t{1} << 16;

// With fewer sites most would be in the seam.
constexpr std::size_t least_block_sites = std::size_t{1} << 13;

// The mesh of a block lies in the second cache, and its seam is a small part of it. A fixed number,
// so that the work does not depend on the threads.
constexpr std::size_t block_sites = 3 << 14;

// What the threads that work on blocks share.
template <models::SphereModel T>
class Work {
 public:
  Work(const Progress& progress, std::span<const Block> blocks)
      : progress_(progress, "triangulate", blocks.size() + 1) {  // the seam is one more step
    for (const Block& b : blocks) most_sites_ = std::max<std::size_t>(most_sites_, b.end - b.begin);
  }

  // There are as many workspaces as threads at work.
  std::unique_ptr<Workspace<T>> begin_block() {
    const std::lock_guard guard(mutex_);
    if (free_.empty()) {
      auto workspace = std::make_unique<Workspace<T>>();
      workspace->reserve(most_sites_);
      return workspace;
    }
    auto workspace = std::move(free_.back());
    free_.pop_back();
    return workspace;
  }

  void end_block(std::unique_ptr<Workspace<T>> workspace) {
    {
      const std::lock_guard guard(mutex_);
      free_.push_back(std::move(workspace));
    }
    progress_.step();
  }

 private:
  system::StageProgress progress_;
  std::size_t most_sites_ = 0;  // of a block
  system::Mutex mutex_;
  std::vector<std::unique_ptr<Workspace<T>>> free_;
};

template <models::SphereModel T>
std::vector<BlockResult> triangulate_blocks(const Input& input, const std::vector<Block>& blocks,
                                            const FaceStore& store) {
  std::vector<BlockResult> results(blocks.size());
  Work<T> work(input.options.progress, blocks);
  system::parallel_for(
      input.options.threads, blocks.size(), 1, [&](std::size_t begin, std::size_t /*end*/) {
        auto workspace = work.begin_block();
        results[begin] = BlockTriangulation<T>(input, blocks[begin], *workspace).run(store);
        work.end_block(std::move(workspace));
      });
  return results;
}

// Whether blocks would leave little to the seam, judged by some small ones. They do not where sites
// lie on curves, or are hidden: then all is seam, and blocks are a detour.
template <models::SphereModel T>
bool has_short_seams(const Input& input) {
  constexpr std::size_t trial_sites = 1024;
  constexpr std::size_t share = 32;  // of the sites, for all trials
  const auto num_ranks = static_cast<Index>(input.order.size());
  const auto position = [&](Index rank) { return input.position(rank); };
  const auto num_trials = std::clamp<std::size_t>(num_ranks / (share * trial_sites), 1, 4);
  Workspace<T> workspace;
  std::vector<Triple> corners(2 * trial_sites);
  std::vector<Triple> neighbors(2 * trial_sites);
  std::size_t num_sites = 0;
  std::size_t num_seam_sites = 0;
  for (std::size_t i = 0; i < num_trials; ++i) {
    const auto middle = static_cast<Index>((2 * i + 1) * num_ranks / (2 * num_trials));
    const Block block = block_around(middle, num_ranks, trial_sites, position);
    Input trial = input;
    trial.order = input.order.subspan(block.begin, block.end - block.begin);
    trial.copies = input.copies.from(block.begin);
    const BlockResult result =
        BlockTriangulation<T>(trial, {0, block.end - block.begin, block.square}, workspace)
            .run({corners, neighbors});
    num_sites += trial.order.size();
    num_seam_sites += result.seam_sites.size();
  }
  return 3 * num_seam_sites < 2 * num_sites;
}

bool is_worthwhile(const Input& input) {
  return models::with_model(input.options.model,
                            [&]<class T> { return has_short_seams<T>(input); });
}

// Whether few sites can be hidden, as far as their distances from the center tell: between
// neighbors on a sphere the squared distance is 4 pi / n on average, and weights must differ by as
// much.
bool are_weights_close(const Input& input) {
  const Extent& extent = input.extent;
  const auto num_sites = static_cast<double>(input.order.size());
  return num_sites * (extent.most_size - extent.least_size) < 4 * extent.least_size;
}

// Whether these may be triangulated over the whole sphere at once, which up to `most_sites` may.
bool suit_sphere(const Input& input, std::size_t most_sites) {
  const std::size_t num_sites = input.order.size();
  return num_sites >= least_sphere_sites && num_sites <= most_sites &&
         surround_center(input.sites, input.options.sphere.center);
}

Triangulated triangulate(std::span<const Point> sites, std::vector<Index> order,
                         std::span<const order::Renamed> renamed, const system::Job& options,
                         std::size_t most_sphere_sites, LargeVector<Triple> copies);

// The seam sites in their order. Most of them lie along borders of blocks, so blocks would not
// help; their mesh is small beside the result.
Triangulated triangulate_seam(const Input& input, std::span<const BlockResult> results) {
  const std::size_t num_ranks = input.order.size();
  std::vector<Point> sites;
  for (const BlockResult& block : results) {
    for (const SeamSite& s : block.seam_sites) sites.push_back(input.sites[input.order[s.rank]]);
  }
  std::vector<Index> order(sites.size());
  std::iota(order.begin(), order.end(), Index{0});
  system::Job options = input.options;
  options.progress = {};
  if (2 * sites.size() >= num_ranks)
    return kernel::triangulate(sites, std::move(order), {}, options);
  return triangulate(sites, std::move(order), {}, options, std::max(sphere_sites, num_ranks / 8),
                     {});
}

// Blocks read their sites before they write their faces, so both can share `copies`.
std::optional<Triangulated> by_blocks(const Input& input, std::span<const order::Renamed> renamed,
                                      std::size_t max_block_sites, LargeVector<Triple> copies) {
  const std::size_t num_ranks = input.order.size();
  const unsigned threads = system::num_threads(input.options.threads);
  const auto blocks = make_blocks(static_cast<Index>(num_ranks), max_block_sites,
                                  [&](Index rank) { return input.position(rank); });
  Triangulated result;
  result.builder = Builder::blocks;
  result.arrays.faces = std::move(copies);
  result.arrays.faces.resize(2 * num_ranks);
  result.arrays.neighbors.resize(2 * num_ranks);
  const FaceStore store = {result.arrays.faces, result.arrays.neighbors};
  const auto results = models::with_model(
      input.options.model, [&]<class T> { return triangulate_blocks<T>(input, blocks, store); });

  Triangulated seam = triangulate_seam(input, results);
  if (seam.arrays.dimension < 2) return std::nullopt;
  result.tally = seam.tally;
  for (const BlockResult& block : results) predicates::add(result.tally, block.tally);
  std::vector<Index> names;
  if (!renamed.empty()) {
    names.assign(input.order.begin(), input.order.end());
    order::rename(names, renamed);
  }
  if (!stitch(results, std::move(seam.arrays), names.empty() ? input.order : names, threads,
              result.arrays)) {
    return std::nullopt;
  }
  return result;
}

Triangulated triangulate(std::span<const Point> sites, std::vector<Index> order,
                         std::span<const order::Renamed> renamed, const system::Job& options,
                         std::size_t most_sphere_sites, LargeVector<Triple> copies) {
  const Input input = make_input(sites, order, options, system::SiteCopies(std::span(copies)));
  std::optional<bool> trial;  // it takes time, and may not be needed
  const auto have_blocks = [&] {
    if (!trial) trial = order.size() >= least_block_sites && is_worthwhile(input);
    return *trial;
  };
  std::optional<Triangulated> result;
  // Where many are hidden the incremental algorithm is faster.
  if (suit_sphere(input, most_sphere_sites) && (are_weights_close(input) || have_blocks())) {
    result = triangulate_sphere(input, renamed);
  }
  if (!result && have_blocks()) {
    result = by_blocks(input, renamed, block_sites, std::move(copies));
  }
  copies = {};
  return result ? *std::move(result)
                : kernel::triangulate(sites, std::move(order), renamed, options);
}

}  // namespace

std::optional<Triangulated> triangulate_by_blocks(std::span<const Point> sites,
                                                  std::span<const Index> order,
                                                  std::span<const order::Renamed> renamed,
                                                  const system::Job& options,
                                                  std::size_t max_block_sites,
                                                  LargeVector<Triple> copies) {
  const Input input = make_input(sites, order, options, system::SiteCopies(std::span(copies)));
  return by_blocks(input, renamed, max_block_sites, std::move(copies));
}

Triangulated triangulate(std::span<const Point> sites, std::vector<Index> order,
                         std::span<const order::Renamed> renamed, const system::Job& options,
                         LargeVector<Triple> copies) {
  return triangulate(sites, std::move(order), renamed, options, sphere_sites, std::move(copies));
}

}  // namespace rondel::bulk
