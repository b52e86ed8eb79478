// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/blocks.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include "bulk/emit.h"
#include "bulk/open_faces.h"
#include "bulk/piece.h"
#include "bulk/stitch.h"
#include "bulk/triangulate.h"
#include "models/with_model.h"
#include "predicates/rung.h"
#include "system/mutex.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::bulk {
namespace {

using kernel::Triangulated;
using Edge = PlaneGraph::Edge;

// One block after the other, in the same memory: arrays that grow from block to block leave gaps.
template <models::SphereModel T>
class BlockBuilder {
 public:
  explicit BlockBuilder(std::size_t most_sites) {
    memory_.reserve(most_sites);
    emission_.owned.reserve(most_sites);
    emission_.owners.reserve(most_sites);
  }

  BlockResult build(const Input& input, const Block& block, const FaceStore& store) {
    BlockResult result;
    const bool has_faces = triangulate(input, block);
    result.tally = piece_.tally();
    if (has_faces) {
      emit_faces(piece_.graph(), {block.begin, piece_.num_sites(), {}}, open_, piece_.hidden(),
                 emission_, store, result);
    } else {
      const Index face = 2 * block.begin;
      result.faces_begin = result.faces_end = face;
      for (Index rank = block.begin; rank < block.end; ++rank)
        result.seam_sites.push_back({rank, face, face});
    }
    return result;
  }

  // How many sites the block leaves to the seam.
  std::size_t count_seam_sites(const Input& input, const Block& block) {
    if (!triangulate(input, block)) return block.end - block.begin;
    std::vector<Index> sites = piece_.hidden();
    for (const Edge e : open_) sites.push_back(piece_.graph().origin(e));
    std::ranges::sort(sites);
    return static_cast<std::size_t>(std::unique(sites.begin(), sites.end()) - sites.begin());
  }

 private:
  // With fewer sites nothing would be final.
  static constexpr Index least_sites = 32;

  // Returns false if this does not work, so that all is left to the seam.
  bool triangulate(const Input& input, const Block& block) {
    const Index num_sites = block.end - block.begin;
    const Input of_block = input.piece(block.begin, block.end);
    memory_.reserve(num_sites);  // sites of one position are one block, however many are wanted
    piece_.assign(of_block, 0, num_sites, memory_);
    const Block all = {0, num_sites, block.square};
    if (num_sites < least_sites || !piece_.solve({&all, 1}) || !piece_.find_hidden()) return false;
    const auto& sites = piece_.sites();
    const Certificate certificate(block.square, sites.hand(), T::hides_sites);
    find_open_faces(piece_.graph(), piece_.boundary(), open_, [&](Index a, Index b, Index c) {
      return certificate.is_final(sites.ray(a), sites.ray(b), sites.ray(c));
    });
    return true;
  }

  PieceMemory memory_;
  Piece<T> piece_;
  std::vector<Edge> open_;  // halfedges with an open face on the left
  EmissionSpace emission_;
};

// As many builders as threads are at work.
template <models::SphereModel T>
class BuilderPool {
 public:
  explicit BuilderPool(std::size_t most_sites) : most_sites_(most_sites) {}

  std::unique_ptr<BlockBuilder<T>> take() {
    const std::lock_guard guard(mutex_);
    if (free_.empty()) return std::make_unique<BlockBuilder<T>>(most_sites_);
    auto builder = std::move(free_.back());
    free_.pop_back();
    return builder;
  }
  void put(std::unique_ptr<BlockBuilder<T>> builder) {
    const std::lock_guard guard(mutex_);
    free_.push_back(std::move(builder));
  }

 private:
  std::size_t most_sites_;
  system::Mutex mutex_;
  std::vector<std::unique_ptr<BlockBuilder<T>>> free_;
};

template <models::SphereModel T>
std::vector<BlockResult> triangulate_blocks(const Input& input, const std::vector<Block>& blocks,
                                            const FaceStore& store) {
  std::vector<BlockResult> results(blocks.size());
  Index most_sites = 0;
  for (const Block& b : blocks) most_sites = std::max(most_sites, b.end - b.begin);
  BuilderPool<T> pool(most_sites);
  // The seam is one more step.
  system::StageProgress progress(input.options.progress, "triangulate", blocks.size() + 1);
  system::parallel_for(input.options.threads, blocks.size(), 1,
                       [&](std::size_t i, std::size_t /*end*/) {
                         auto builder = pool.take();
                         results[i] = builder->build(input, blocks[i], store);
                         pool.put(std::move(builder));
                         progress.step();
                       });
  return results;
}

// The seam sites in their order. Most of them lie along borders of blocks, so blocks would not
// help; their mesh is small beside the result.
Triangulated triangulate_seam(const Input& input, std::span<const BlockResult> results) {
  const std::size_t num_ranks = input.order.size();
  std::vector<Point> sites;
  for (const BlockResult& block : results) {
    for (const SeamSite& s : block.seam_sites) sites.push_back(input.point(s.rank));
  }
  std::vector<Index> order(sites.size());
  std::iota(order.begin(), order.end(), Index{0});
  system::Job options = input.options;
  options.progress = {};
  if (2 * sites.size() >= num_ranks)
    return kernel::triangulate(sites, std::move(order), {}, options);
  return triangulate(sites, std::move(order), {}, options, {},
                     std::max(most_sphere_sites, num_ranks / 8));
}

}  // namespace

bool has_short_seams(const Input& input) {
  constexpr std::size_t trial_sites = 1024;
  constexpr std::size_t share = 32;  // of the sites, for all trials
  const std::size_t num_ranks = input.order.size();
  const auto num_trials = std::clamp<std::size_t>(num_ranks / (share * trial_sites), 1, 4);
  return models::with_model(input.options.model, [&]<class T> {
    BlockBuilder<T> builder(trial_sites);
    std::size_t num_sites = 0;
    std::size_t num_seam_sites = 0;
    for (std::size_t i = 0; i < num_trials; ++i) {
      const auto middle = static_cast<Index>((2 * i + 1) * num_ranks / (2 * num_trials));
      const Block block = block_around(middle, input, trial_sites);
      num_sites += block.end - block.begin;
      num_seam_sites += builder.count_seam_sites(input, block);
    }
    return 3 * num_seam_sites < 2 * num_sites;
  });
}

std::optional<Triangulated> triangulate_by_blocks(const Input& input,
                                                  std::span<const order::Renamed> renamed,
                                                  std::size_t max_block_sites,
                                                  LargeVector<Triple> copies) {
  const std::size_t num_ranks = input.order.size();
  const auto blocks = make_blocks(input, max_block_sites);
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
  std::vector<Index> space;
  const auto names = order::names_of(input.order, renamed, space);
  const unsigned threads = system::num_threads(input.options.threads);
  if (!stitch(results, std::move(seam.arrays), names, threads, result.arrays)) return std::nullopt;
  return result;
}

}  // namespace rondel::bulk
