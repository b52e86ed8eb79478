// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/blocks.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "bulk/builder_pool.h"
#include "bulk/emit.h"
#include "bulk/square_piece.h"
#include "bulk/stitch.h"
#include "models/with_model.h"
#include "predicates/rung.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::bulk {
namespace {

// One thread gains nothing from squares that triangulate the seam, and a small module need not have
// them.
#if defined(RONDEL_HAS_TBB) || defined(RONDEL_HAS_THREADS)
constexpr bool has_threads = true;
#else
constexpr bool has_threads = false;
#endif

// The most sites of a block where larger ones would be too few.
constexpr std::size_t small_block_sites = default_max_block_sites / 4;

using kernel::Triangulated;
using Edge = PlaneGraph::Edge;

template <models::SphereModel T>
class BlockBuilder {
 public:
  explicit BlockBuilder(std::size_t max_num_sites) {
    piece_.reserve(max_num_sites);
    emission_.owned.reserve(max_num_sites);
    emission_.owners.reserve(max_num_sites);
  }

  BlockResult build(const Input& input, const Block& block, const FaceStore& store) {
    BlockResult result;
    const Input of_block = input.piece(block.begin, block.end);
    const bool has_faces = piece_.triangulate(of_block, block.square);
    result.tally = piece_.tally();
    if (has_faces) {
      emit_faces(piece_.graph(), {block.begin, piece_.num_sites(), {}},
                 piece_.find_open(block.square), piece_.hidden(), emission_, store, result);
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
    const Input of_block = input.piece(block.begin, block.end);
    if (!piece_.triangulate(of_block, block.square)) return block.end - block.begin;
    std::vector<Index> sites = piece_.hidden();
    for (const Edge e : piece_.find_open(block.square)) sites.push_back(piece_.graph().origin(e));
    std::ranges::sort(sites);
    return static_cast<std::size_t>(std::unique(sites.begin(), sites.end()) - sites.begin());
  }

 private:
  SquarePiece<T> piece_;
  EmissionSpace emission_;
};

template <models::SphereModel T>
std::vector<BlockResult> build_blocks(const Input& input, const std::vector<Block>& blocks,
                                      const FaceStore& store) {
  std::vector<BlockResult> results(blocks.size());
  Index max_num_sites = 0;
  for (const Block& b : blocks) max_num_sites = std::max(max_num_sites, b.end - b.begin);
  BuilderPool<BlockBuilder<T>> pool;
  const auto make = [&] { return std::make_unique<BlockBuilder<T>>(max_num_sites); };
  // The seam is one more step.
  system::StageProgress progress(input.options.progress, "triangulate", blocks.size() + 1);
  system::parallel_for(input.options.threads, blocks.size(), 1,
                       [&](std::size_t i, std::size_t /*end*/) {
                         pool.with_builder(make, [&](BlockBuilder<T>& builder) {
                           results[i] = builder.build(input, blocks[i], store);
                         });
                         progress.step();
                       });
  return results;
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

std::vector<BlockResult> triangulate_blocks(const Input& input, const std::vector<Block>& blocks,
                                            TriangulationArrays& arrays) {
  arrays.faces.resize(2 * input.order.size());
  arrays.neighbors.resize(2 * input.order.size());
  const FaceStore store = {arrays.faces, arrays.neighbors};
  return models::with_model(input.options.model,
                            [&]<class T> { return build_blocks<T>(input, blocks, store); });
}

std::optional<Triangulated> triangulate_by_blocks(const Input& input,
                                                  std::span<const order::Renamed> renamed,
                                                  std::size_t max_block_sites,
                                                  LargeVector<Triple> copies,
                                                  const SeamRule& rule) {
  const unsigned threads = system::num_threads(input.options.threads);
  auto squares = make_squares(input, max_block_sites);
  auto blocks = blocks_of(squares);
  // Threads that wait for others lose more than a longer seam takes.
  if (blocks.size() < 2 * std::size_t{threads} && max_block_sites > small_block_sites) {
    squares = make_squares(input, small_block_sites);
    blocks = blocks_of(squares);
  }
  Triangulated result;
  result.builder = Builder::blocks;
  result.arrays.faces = std::move(copies);
  const auto results = triangulate_blocks(input, blocks, result.arrays);
  for (const BlockResult& block : results) predicates::add(result.tally, block.tally);
  SeamFaces seam(results, {result.arrays.faces, result.arrays.neighbors}, threads);
  const bool is_filled = has_threads ? fill_seam(input, squares, results, rule, seam, result.tally)
                                     : fill_seam_at_once(input, results, seam, result.tally);
  if (!is_filled) return std::nullopt;
  std::vector<Index> space;
  const auto names = order::names_of(input.order, renamed, space);
  if (!stitch(results, seam, names, threads, result.arrays)) return std::nullopt;
  return result;
}

}  // namespace rondel::bulk
