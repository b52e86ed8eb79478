// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faults of one kind in a file of weights: their number, and the first of them in words.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "rondel/weight_check.h"
#include "system/message_text.h"

namespace rondel::interpolation {

class FaultCounter {
 public:
  // `one` and `many` are what follows the number 1, and other numbers.
  FaultCounter(std::string kind, std::string one, std::string many)
      : kind_(std::move(kind)), one_(std::move(one)), many_(std::move(many)) {}

  // Counts a fault at a place, "target 3, source 5", that has this value.
  void add(const std::string& place, double value) {
    if (count_++ == 0) first_ = place + ": " + system::shortest_text(value);
  }
  // Counts a fault at a place that has another value than the right one.
  void add(const std::string& place, double given, double right) {
    if (count_++ == 0) {
      first_ = place + ": " + system::shortest_text(given) + " instead of " +
               system::shortest_text(right);
    }
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  // Appends what was found, if anything was.
  void move_to(std::vector<WeightFault>& faults) const {
    if (count_ == 0) return;
    const std::string text = std::to_string(count_) + ' ' + (count_ == 1 ? one_ : many_);
    faults.push_back({kind_, count_, text + " (" + (count_ == 1 ? "" : "first ") + first_ + ")"});
  }

 private:
  std::string kind_, one_, many_;
  std::size_t count_ = 0;
  std::string first_;
};

}  // namespace rondel::interpolation
