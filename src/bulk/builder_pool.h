// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Workspaces for parallel loops: as many as pieces of the loop are at work at once.
//
// in    how to make one
// out   one that nobody else has
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "system/mutex.h"

namespace rondel::bulk {

template <class Builder>
class BuilderPool {
 public:
  // Calls work(builder) with a builder that nobody else uses meanwhile; makes one if there is none.
  template <class Make, class Work>
  void with_builder(Make make, Work work) {
    std::unique_ptr<Builder> builder = take();
    if (builder == nullptr) builder = make();
    work(*builder);
    const std::lock_guard guard(mutex_);
    free_.push_back(std::move(builder));
  }

 private:
  std::unique_ptr<Builder> take() {
    const std::lock_guard guard(mutex_);
    if (free_.empty()) return nullptr;
    auto builder = std::move(free_.back());
    free_.pop_back();
    return builder;
  }

  system::Mutex mutex_;
  std::vector<std::unique_ptr<Builder>> free_;
};

}  // namespace rondel::bulk
