// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What is done when a scope is left by an exception, said where the scope begins.
#pragma once

#include <exception>
#include <utility>

namespace rondel::system {

// Calls undo(), which must not throw, if an exception ends its life.
template <class Undo>
class OnFailure {
 public:
  explicit OnFailure(Undo undo) : undo_(std::move(undo)) {}
  OnFailure(const OnFailure&) = delete;
  OnFailure& operator=(const OnFailure&) = delete;
  ~OnFailure() {
    if (std::uncaught_exceptions() > before_) undo_();
  }

 private:
  Undo undo_;
  int before_ = std::uncaught_exceptions();
};

}  // namespace rondel::system
