// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Long work that somebody may end before its time.
#pragma once

#include <atomic>
#include <exception>
#include <functional>

#include "rondel/export.h"

namespace rondel {

/// What ends the work of call_interruptible().
class RONDEL_API Interrupted : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override;
};

/// Calls `work`. Once `stop` is true, calls of the library within it throw Interrupted soon, at the
/// next piece of a parallel loop: builds, hulls, diagrams, checks and batches of queries do, on any
/// number of threads. Nothing is left of them; but change a DynamicTriangulation outside.
/// 1. It is set for the calling thread alone, and until `work` ends. Calls may be nested: the inner
///    flag counts.
/// 2. Work between two loops goes on to the next one, and short work to its end. A progress
///    function (Options::progress) may throw as well.
RONDEL_API void call_interruptible(const std::atomic<bool>& stop,
                                   const std::function<void()>& work);

}  // namespace rondel
