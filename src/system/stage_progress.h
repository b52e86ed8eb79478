// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How much of a stage is done, told to a Progress function by whichever of the threads that work on
// it ends a step.
#pragma once

#include <atomic>
#include <cstddef>
#include <string_view>

#include "rondel/types.h"

namespace rondel::system {

// The function is called by one thread at a time, with growing fractions, and while no lock is
// held: it may do parallel work itself, and while it waits for that its thread may end another step of
// this stage. A thread that finds the function being called leaves its news to the one that calls.
class StageProgress {
 public:
  // `num_steps` make the fraction 1. Keeps a reference to the function.
  StageProgress(const Progress& progress, std::string_view stage, std::size_t num_steps)
      : progress_(progress), stage_(stage), num_steps_(num_steps) {}

  // One step more is done. Throws what the function throws, which is not called again: the flag stays.
  void step() {
    if (!progress_) return;
    ++num_done_;
    while (num_told_ != num_done_ && !is_telling_.exchange(true)) {
      const std::size_t done = num_done_;
      if (num_told_.exchange(done) != done) {
        progress_(stage_, static_cast<double>(done) / static_cast<double>(num_steps_));
      }
      is_telling_ = false;
    }
  }

 private:
  const Progress& progress_;
  std::string_view stage_;
  std::size_t num_steps_;
  std::atomic<std::size_t> num_done_ = 0;
  std::atomic<std::size_t> num_told_ = 0;
  std::atomic<bool> is_telling_ = false;
};

}  // namespace rondel::system
