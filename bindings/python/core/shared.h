// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// An object that threads of Python share: one changes it, or several ask it.
#pragma once

#include <nanobind/nanobind.h>

#include <mutex>
#include <shared_mutex>
#include <utility>

namespace rondel::python {

template <class T>
class Shared {
 public:
  template <class... Arguments>
  explicit Shared(std::in_place_t /*tag*/, Arguments&&... arguments)
      : value_(std::forward<Arguments>(arguments)...) {}

  template <class Change>
  auto change(const Change& change) {
    const nanobind::gil_scoped_release released;
    const std::unique_lock lock(mutex_);
    return change(value_);
  }
  template <class Question>
  auto ask(const Question& question) const {
    const nanobind::gil_scoped_release released;
    const std::shared_lock lock(mutex_);
    return question(value_);
  }

 protected:
  mutable std::shared_mutex mutex_;
  T value_;
};

}  // namespace rondel::python
