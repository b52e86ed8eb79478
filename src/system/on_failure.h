// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What is done when a scope is left by an exception, said where the scope begins.
#pragma once

#include <utility>

namespace rondel::system {

// Calls undo(), which must not throw, when it goes, unless succeed() was called. (To ask whether
// there is an exception would cost a change of one site a fortieth of its time.)
template <class Undo>
class OnFailure {
 public:
  explicit OnFailure(Undo undo) : undo_(std::move(undo)) {}
  OnFailure(const OnFailure&) = delete;
  OnFailure& operator=(const OnFailure&) = delete;
  ~OnFailure() {
    if (!has_succeeded_) undo_();
  }
  void succeed() { has_succeeded_ = true; }

 private:
  Undo undo_;
  bool has_succeeded_ = false;
};

}  // namespace rondel::system
