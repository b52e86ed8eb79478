// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// bulk::triangulate_by_blocks: the incremental build's result, whatever the sites, the size of the
// blocks and the threads, and whether squares triangulate the seam; and divide and conquer by itself, which makes the faces that the center
// sees.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bulk/blocks.h"
#include "bulk/sphere.h"
#include "fuzz/block_sites.h"
#include "support/divided_faces.h"

namespace rondel::fuzz {
namespace {

using test::SiteSet;
using test::operator+;
using test::operator*;

void require_same(const TriangulationArrays& built, const TriangulationArrays& expected) {
  require(built.dimension == expected.dimension, "the dimension");
  require(built.faces == expected.faces, "the faces");
  require(built.neighbors == expected.neighbors, "the neighbors");
  require(built.ghost_faces == expected.ghost_faces, "the ghost faces");
  require(built.hidden == expected.hidden, "the hidden sites");
}

void test_blocks(const SiteSet& set, Model model, std::size_t block_sites, unsigned threads,
                 bool has_copies, const bulk::SeamRule& rule) {
  system::Job options{{.model = model, .sphere = set.sphere}, {.threads = 1}};
  LargeVector<Triple> copies(has_copies ? 2 * set.sites.size() : 0);
  const auto order = order::spatial_order(set.sites, model, set.sphere.center, 1, {},
                                          system::SiteCopies(std::span(copies)));
  if (order.order.empty()) return;
  const auto expected = kernel::triangulate(set.sites, order.order, order.renamed, options).arrays;
  options.threads = threads;
  const auto input =
      bulk::make_input(set.sites, order.order, options, system::SiteCopies(std::span(copies)));
  const auto built =
      bulk::triangulate_by_blocks(input, order.renamed, block_sites, std::move(copies), rule);
  require(built.has_value() || expected.dimension < 2, "blocks fit");
  if (built) require_same(built->arrays, expected);
  if (!bulk::surround_center(set.sites, set.sphere.center)) return;
  const auto whole =
      bulk::triangulate_sphere(bulk::make_input(set.sites, order.order, options), order.renamed);
  if (whole) require_same(whole->arrays, expected);
}

// The sites of the cube's face that the first one is on, and their distances from the center.
void test_divide(const SiteSet& set, Model model) {
  SiteSet part;
  part.sphere = set.sphere;
  bulk::Extent extent = {std::numeric_limits<double>::infinity(), 0};
  unsigned face = 6;
  for (const Point& p : set.sites) {
    if (p == set.sphere.center) continue;
    const unsigned own = order::exact_cube_position(p, set.sphere.center).face;
    if (face == 6) face = own;
    if (own != face) continue;
    part.sites.push_back(p);
    const Point d = p + -1.0 * set.sphere.center;
    const double size = std::hypot(d.x, d.y, d.z);
    extent = {std::min(extent.min_size, size * (1 - 0x1p-40)),
              std::max(extent.max_size, size * (1 + 0x1p-40))};
  }
  const bool is_in_range = extent.min_size > 1e-100 && extent.max_size < 1e100;
  if (model == Model::weighted && !is_in_range) return;
  const auto divided = model == Model::weighted
                           ? divide_and_compare<models::WeightedPoints>(part, extent)
                           : divide_and_compare<models::ProjectedPoints>(part, extent);
  require(divided != test::Divided::different, "divide and conquer gives the faces seen");
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  const std::uint8_t mode = source.byte();
  const std::size_t block_sites = 33 + source.byte() % 96;  // of 260 sites at most
  const Model model = mode % 2 == 0 ? Model::weighted : Model::projected;
  const test::SiteSet set = fuzz::block_sites(source, model);
  fuzz::test_divide(set, model);
  const bulk::SeamRule tree = {.min_sites = 0, .is_every_square = true};
  fuzz::test_blocks(set, model, block_sites, mode < 64 ? 2 : 1, mode % 4 < 2,
                    mode % 8 < 4 ? tree : bulk::SeamRule());
  return 0;
}
