// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The tree of squares by its definition, also where threads split squares at the same time.
#include "bulk/squares.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bulk/input.h"
#include "gtest/gtest.h"
#include "order/spatial_order.h"
#include "rondel/types.h"
#include "support/random.h"

namespace rondel {
namespace {

// The squares of a tree, the lower ones first, from the one with this number on.
void expect_tree(const std::vector<bulk::TreeSquare>& squares, Index number, std::size_t most,
                 const bulk::Input& input, std::vector<Index>& next) {
  const bulk::TreeSquare& square = squares[number];
  const bulk::Block& block = square.block;
  ASSERT_LT(block.begin, block.end);
  EXPECT_EQ(square.num_sites, static_cast<double>(block.end - block.begin));
  const auto num_quarters = 4 - std::ranges::count(square.quarters, no_index);
  EXPECT_EQ(num_quarters == 0, block.end - block.begin <= most);
  Index begin = block.begin;
  unsigned height = 0;
  for (unsigned rank = 0; rank < 4; ++rank) {
    const Index quarter = square.quarters[rank];
    if (quarter == no_index) continue;
    expect_tree(squares, quarter, most, input, next);
    EXPECT_EQ(squares[quarter].block.begin, begin);
    EXPECT_EQ(squares[quarter].block.square.corner.u, quadrant(block.square, rank).corner.u);
    EXPECT_EQ(squares[quarter].block.square.corner.v, quadrant(block.square, rank).corner.v);
    begin = squares[quarter].block.end;
    height = std::max(height, squares[quarter].height + 1);
  }
  EXPECT_EQ(square.height, height);
  EXPECT_EQ(begin, num_quarters == 0 ? block.begin : block.end);
  for (Index i = block.begin; num_quarters == 0 && i < block.end; ++i)
    EXPECT_TRUE(bulk::has(block.square, input.position(i)));
  EXPECT_EQ(number, next.size());  // after its quarters, in their order
  next.push_back(number);
}

TEST(bulk_squares, are_those_of_their_definition) {
  test::Random random(5);
  for (const double size : {2.0, 1e-3}) {
    std::vector<Point> sites;
    // The second of these fills a corner of one face.
    for (std::size_t i = 0; i < 150000; ++i) {
      sites.push_back({1 + size * random.signed_unit(), size * random.signed_unit(),
                       0.5 + size * random.signed_unit()});
    }
    const auto order = order::spatial_order(sites, Model::projected, {}, 1);
    for (const unsigned threads : {1U, 2U, 5U}) {
      SCOPED_TRACE(testing::Message() << size << ' ' << threads);
      const system::Job options{{}, {.threads = threads}};
      const bulk::Input input = bulk::make_input(sites, order.order, options);
      constexpr std::size_t most = 700;
      const auto squares = bulk::make_squares(input, most);
      Index begin = 0;
      std::vector<Index> seen;
      for (const bulk::Block& face : bulk::cube_faces(input)) {
        EXPECT_EQ(face.begin, begin);
        begin = face.end;
        if (face.begin == face.end) continue;
        // The square of a face comes after all others in it.
        const auto root = std::ranges::find_if(squares, [&](const bulk::TreeSquare& square) {
          return square.block.begin == face.begin && square.block.end == face.end &&
                 square.block.square.bits == face.square.bits;
        });
        ASSERT_NE(root, squares.end());
        expect_tree(squares, static_cast<Index>(root - squares.begin()), most, input, seen);
      }
      EXPECT_EQ(begin, sites.size());
      EXPECT_EQ(seen.size(), squares.size());
    }
  }
}

}  // namespace
}  // namespace rondel
