// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Runs long random scripts on sites with many ties: the triangulation stays correct, frees all
// memory, and takes no more than its largest set of sites needed.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <map>
#include <memory>
#include <new>

#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "support/generators.h"

namespace {

std::atomic<std::size_t> bytes_in_use = 0;

// The size is kept in front of the memory, which stays aligned.
constexpr std::size_t header = alignof(std::max_align_t);

}  // namespace

void* operator new(std::size_t size) {
  auto* const block = static_cast<std::size_t*>(std::malloc(size + header));
  if (block == nullptr) throw std::bad_alloc();
  *block = size;
  bytes_in_use += size;
  return reinterpret_cast<char*>(block) + header;
}

void operator delete(void* memory) noexcept {
  if (memory == nullptr) return;
  auto* const block = reinterpret_cast<std::size_t*>(static_cast<char*>(memory) - header);
  bytes_in_use -= *block;
  std::free(block);
}

void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }

namespace rondel::test {
namespace {

// Places on a cube's surface grid, on great circles, doubled rays, and inside.
std::vector<Point> tied_pool() {
  std::vector<Point> pool;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        if (x != 0 || y != 0 || z != 0) pool.push_back({x * 1.0, y * 1.0, z * 1.0});
      }
    }
  }
  for (int i = 0; i < 24; ++i) {
    pool.push_back(unit_vector({i * 15.0, 0}));
    pool.push_back(unit_vector({0, i * 15.0}));
    pool.push_back(unit_vector({i * 15.0, 45}));
  }
  return pool;
}

void expect_equal_to_a_build(const DynamicTriangulation& changing, const Options& options) {
  const Snapshot now = changing.snapshot();
  const Triangulation fresh = delaunay(now.triangulation.sites(), options);
  ASSERT_EQ(now.triangulation.dimension(), fresh.dimension());
  ASSERT_TRUE(std::ranges::equal(now.triangulation.faces(), fresh.faces()));
  ASSERT_TRUE(std::ranges::equal(now.triangulation.neighbors(), fresh.neighbors()));
  ASSERT_TRUE(std::ranges::equal(now.triangulation.hidden(), fresh.hidden()));
  ASSERT_TRUE(std::ranges::equal(now.triangulation.duplicates(), fresh.duplicates()));
  ASSERT_TRUE(std::ranges::equal(now.triangulation.ghost_faces(), fresh.ghost_faces()));
}

// Up to `limit` sites at a time.
void run_script(Model model, std::size_t steps, std::size_t limit) {
  const std::vector<Point> pool = tied_pool();
  Options options;
  options.model = model;
  DynamicTriangulation changing(options);
  std::vector<Index> live;
  live.reserve(limit);
  Random random(steps);
  std::size_t most = 0;  // in the first swings, which meet the limit often
  const std::size_t first_swings = std::max(steps / 5, 16 * limit);
  for (std::size_t step = 0; step < steps; ++step) {
    // The number of sites swings between none and the limit.
    const bool is_growing = (step / (2 * limit)) % 2 == 0;
    const std::size_t what = random.below(10);
    const Point& p = pool[random.below(pool.size())];
    const std::size_t i = live.empty() ? 0 : random.below(live.size());
    if (!live.empty() && what < 2) {
      changing.move(live[i], p);
    } else if (live.size() < limit && (live.empty() || (what < 8) == is_growing)) {
      live.push_back(changing.insert(p));
    } else {
      changing.remove(live[i]);
      live[i] = live.back();
      live.pop_back();
    }
    if (step < first_swings) most = std::max<std::size_t>(most, bytes_in_use);
    ASSERT_LE(bytes_in_use, most + most / 8) << "step " << step;
    if (step % 500 != 0) continue;
    ASSERT_EQ(changing.num_sites(), live.size());
    expect_equal_to_a_build(changing, options);
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << "step " << step;
  }
}

void soak(Model model) {
  delaunay(tied_pool());  // what is made once and kept, for threads
  const std::size_t before = bytes_in_use;
  run_script(model, scaled(1'000'000), 150);
  run_script(model, scaled(100'000), 1000);
  EXPECT_EQ(bytes_in_use, before);
}

TEST(dynamic_soak, projected) { soak(Model::projected); }
TEST(dynamic_soak, weighted) { soak(Model::weighted); }

}  // namespace
}  // namespace rondel::test
