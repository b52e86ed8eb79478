// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a public function was asked to do, and how, on its way through the layers.
#pragma once

#include <cstddef>
#include <string_view>

#include "rondel/types.h"
#include "system/arithmetic.h"
#include "system/parallel.h"

namespace rondel::system {

// What to triangulate, and with which threads: job.model, job.threads.
struct Job : Options, Execution {};

inline void announce(const Execution& execution, std::string_view stage, double fraction) {
  if (execution.progress) execution.progress(stage, fraction);
}
inline void announce(const Execution& execution, std::string_view stage, std::size_t done,
                     std::size_t total) {
  announce(execution, stage, static_cast<double>(done) / static_cast<double>(total));
}

// While it lives, its thread computes as the proofs suppose, and parallel loops obey the flag that the
// caller gave, or none.
class Call {
 public:
  explicit Call(const Execution& execution) : stop_(execution.stop) {}

 private:
  ArithmeticScope arithmetic_;
  StopScope stop_;
};

}  // namespace rondel::system
