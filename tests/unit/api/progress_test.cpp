// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Who calls a Progress function, and what it may do.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "support/generators.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel {
namespace {

TEST(progress, is_told_by_one_thread_at_a_time_and_grows) {
  std::atomic<int> callers = 0;
  std::vector<double> fractions;
  const Progress progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(++callers, 1);
    EXPECT_EQ(stage, "stage");
    fractions.push_back(fraction);
    --callers;
  };
  constexpr std::size_t num_steps = 5000;
  system::StageProgress stage(progress, "stage", num_steps);
  system::parallel_for(8, num_steps, 1, [&](std::size_t, std::size_t) { stage.step(); });
  ASSERT_FALSE(fractions.empty());
  for (std::size_t i = 1; i < fractions.size(); ++i) EXPECT_LT(fractions[i - 1], fractions[i]);
  EXPECT_EQ(fractions.back(), 1);
}

// As it does when its function waits for parallel work.
TEST(progress, may_come_to_the_end_of_another_step_while_it_is_told) {
  system::StageProgress* now = nullptr;
  std::vector<double> fractions;
  const Progress progress = [&](std::string_view, double fraction) {
    fractions.push_back(fraction);
    if (fractions.size() == 1) now->step();
  };
  system::StageProgress stage(progress, "stage", 4);
  now = &stage;
  stage.step();
  stage.step();
  EXPECT_EQ(fractions, (std::vector{0.25, 0.5, 0.75}));
}

TEST(progress, that_threw_is_not_told_again) {
  int calls = 0;
  const Progress progress = [&](std::string_view, double) {
    ++calls;
    throw std::runtime_error("enough");
  };
  system::StageProgress stage(progress, "stage", 2);
  EXPECT_THROW(stage.step(), std::runtime_error);
  stage.step();
  EXPECT_EQ(calls, 1);
}

TEST(progress, may_triangulate_itself) {
  const std::vector<Point> sites = test::generator("uniform").make(400000, 1).sites;
  const std::vector<Point> few = test::generator("uniform").make(100000, 2).sites;
  const std::size_t num_faces = delaunay(sites).num_faces();
  std::atomic<int> callers = 0;
  double last = 0;
  const Progress progress = [&](std::string_view stage, double fraction) {
    if (stage != "triangulate") return;
    EXPECT_EQ(++callers, 1);
    EXPECT_LE(last, fraction);
    last = fraction;
    EXPECT_EQ(delaunay(few, {}, {.threads = 4}).num_sites(), few.size());
    --callers;
  };
  EXPECT_EQ(delaunay(sites, {}, {.threads = 4, .progress = progress}).num_faces(), num_faces);
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace rondel
