// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The bulk build and the incremental one, side by side: the result is unique, so all bits agree.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bulk/blocks.h"
#include "bulk/sphere.h"
#include "bulk/triangulate.h"
#include "order/spatial_order.h"
#include "support/generators.h"

namespace rondel::test {

// Sites as the bulk build takes them, and what it must give.
class BulkCase {
 public:
  BulkCase(const SiteSet& set, Model model) : sites_(set.sites) {
    options_.model = model;
    options_.sphere = set.sphere;
    options_.threads = 1;
    order_ = order::spatial_order(sites_, model, set.sphere.center, 1);
    expected_ = kernel::triangulate(sites_, order_.order, order_.renamed, options_).arrays;
  }

  [[nodiscard]] const TriangulationArrays& expected() const { return expected_; }
  [[nodiscard]] std::size_t num_ranks() const { return order_.order.size(); }

  // Returns whether there was no need to fall back. What is returned is compared bit by bit.
  bool run(std::size_t max_block_sites, unsigned threads = 1, const bulk::SeamRule& rule = {}) {
    options_.threads = threads;
    return compare(bulk::triangulate_by_blocks(input(), order_.renamed, max_block_sites, {}, rule));
  }

  // The same with a seam that every square triangulates.
  bool run_tree(std::size_t max_block_sites, unsigned threads = 1) {
    return run(max_block_sites, threads, {.min_sites = 0, .is_every_square = true});
  }

  // The same with copies of the sites.
  bool run_with_copies(std::size_t max_block_sites, unsigned threads = 1) {
    options_.threads = threads;
    LargeVector<Triple> copies(2 * sites_.size());
    const system::SiteCopies site_copies{std::span(copies)};
    order::spatial_order(sites_, options_.model, options_.sphere.center, threads, {}, site_copies);
    return compare(bulk::triangulate_by_blocks(input(site_copies), order_.renamed, max_block_sites,
                                               std::move(copies)));
  }

  // The same for the whole sphere at once, which the sites must surround.
  bool run_whole(unsigned threads = 1) {
    options_.threads = threads;
    return compare(bulk::triangulate_sphere(input(), order_.renamed));
  }

 private:
  [[nodiscard]] bulk::Input input(const system::SiteCopies& copies = {}) const {
    return bulk::make_input(sites_, order_.order, options_, copies);
  }

  bool compare(const std::optional<kernel::Triangulated>& result) {
    if (!result) return false;
    const TriangulationArrays& arrays = result->arrays;
    EXPECT_EQ(arrays.dimension, expected_.dimension);
    EXPECT_TRUE(arrays.faces == expected_.faces);
    EXPECT_TRUE(arrays.neighbors == expected_.neighbors);
    EXPECT_TRUE(arrays.ghost_faces == expected_.ghost_faces);
    EXPECT_TRUE(arrays.hidden == expected_.hidden);
    EXPECT_TRUE(arrays.ring == expected_.ring);
    return true;
  }

  std::vector<Point> sites_;
  system::Job options_;
  order::SpatialOrder order_;
  TriangulationArrays expected_;
};

// These take the exact rungs most of the time.
inline bool is_extreme(const Generator& generator) {
  return std::ranges::find(extreme_generators(), generator.name, &Generator::name) !=
         extreme_generators().end();
}

inline std::string text_of(Model model) {
  return model == Model::projected ? "projected" : "weighted";
}

}  // namespace rondel::test
