// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// seam_bench KIND N [--seed S]: measures the parts of a build in memory and each square of the tree
// that fills the seam, in processor time of one thread. The figures show which parts threads can
// share and which they wait for. Prints JSON for scripts/bench --scale-model. Uses the library's own
// headers.

#include <cstdint>
#include <cstdio>
#include <ctime>
#include <span>
#include <utility>
#include <vector>

#include "bulk/blocks.h"
#include "bulk/seam_tree.h"
#include "bulk/stitch.h"
#include "inputs.h"
#include "measure.h"
#include "order/spatial_order.h"

namespace rondel::bench {
namespace {

struct Ledger {
  double order = 0;
  double blocks = 0;
  double stitch = 0;
  double seam = 0;  // the whole seam
  std::size_t num_blocks = 0;
  std::size_t num_seam_sites = 0;
  bulk::SeamLedger tree;
};

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Builds as the library does, and reads the clock between the parts.
bool build(std::span<const Point> sites, Ledger& ledger) {
  const system::Job options{{}, {.threads = 1}};
  double start = processor_seconds();
  const auto take = [&start] {
    const double end = processor_seconds();
    return end - std::exchange(start, end);
  };
  TriangulationArrays arrays;
  arrays.faces.resize(2 * sites.size());
  const system::SiteCopies copies{std::span(arrays.faces)};
  const auto order = order::spatial_order(sites, options.model, {}, 1, {}, copies);
  ledger.order = take();
  const bulk::Input input = bulk::make_input(sites, order.order, options, copies);
  const auto squares = bulk::make_squares(input, bulk::default_max_block_sites);
  const auto blocks = bulk::blocks_of(squares);
  const auto results = bulk::triangulate_blocks(input, blocks, arrays);
  ledger.blocks = take();
  bulk::SeamFaces seam(results, {arrays.faces, arrays.neighbors}, 1);
  Tally tally{};
  bulk::SeamRule rule;
  rule.ledger = &ledger.tree;
  if (!bulk::fill_seam(input, squares, results, rule, seam, tally)) return false;
  ledger.seam = take();
  std::vector<Index> space;
  const auto names = order::names_of(input.order, order.renamed, space);
  if (!bulk::stitch(results, seam, names, 1, arrays)) return false;
  ledger.stitch = take();
  ledger.num_blocks = blocks.size();
  ledger.num_seam_sites = seam.sites().size();
  return true;
}

void print(std::size_t num_sites, const Ledger& ledger) {
  std::printf(
      "{\"sites\": %zu, \"order_seconds\": %.6g, \"blocks\": %zu, \"blocks_seconds\": %.6g,\n",
      num_sites, ledger.order, ledger.num_blocks, ledger.blocks);
  std::printf(" \"seam_sites\": %zu, \"seam_seconds\": %.6g, \"stitch_seconds\": %.6g,\n",
              ledger.num_seam_sites, ledger.seam, ledger.stitch);
  std::printf(" \"sphere_sites\": %zu, \"sphere_seconds\": %.6g,\n \"squares\": [",
              ledger.tree.num_sphere_sites, ledger.tree.sphere_seconds);
  const char* separator = "\n";
  for (const auto& square : ledger.tree.squares) {
    if (square.num_seam_sites == 0) continue;
    std::printf(R"(%s  {"height": %u, "seam_sites": %zu, "open_sites": %zu, "seconds": %.6g})",
                separator, square.height, square.num_seam_sites, square.num_open, square.seconds);
    separator = ",\n";
  }
  std::printf("\n ]}\n");
}

int run(int argc, char** argv) {
  const std::uint64_t seed = take_seed(argc, argv);
  if (argc != 3) {
    std::fprintf(stderr, "usage: seam_bench KIND N [--seed S]\n");
    return 2;
  }
  Source source(argv[1], argv[2], seed);
  const std::vector<Point> sites = source.next();
  keep_freed_memory();
  Ledger ledger{.tree = {.clock = processor_seconds}};
  if (!build(sites, ledger)) return 1;  // fills the heap
  ledger = {.tree = {.clock = processor_seconds}};
  if (!build(sites, ledger)) return 1;
  print(sites.size(), ledger);
  return 0;
}

}  // namespace
}  // namespace rondel::bench

int main(int argc, char** argv) { return rondel::bench::run(argc, argv); }
