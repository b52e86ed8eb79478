// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Long work that Python can watch and interrupt.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <type_traits>

#include "rondel/types.h"

namespace rondel::python {

// Runs the work on `size` items without the lock of the interpreter. If there are many items or a listener,
// another thread does it, and this one wakes some times a second
// 1. to run the handlers of signals: Ctrl-C ends the work at its next piece, and raises
//    KeyboardInterrupt;
// 2. to tell the listener the stage and the fraction done. An exception of the listener ends the work too.
// `progress` is the listener, True for a rondel.ProgressBar that is removed at the end, or None or False for none.
// The work passes the Execution that it is given to the library. Call this with the lock of the interpreter.
void run_watched(std::size_t size, unsigned threads, const nanobind::object& progress,
                 const std::function<void(const Execution&)>& work);

// Work that asks once, at its end, whether a signal handler or the listener has raised. They are
// called a last time before the answer and not again, so that the work can tell others, and nothing
// is raised afterwards.
using WatchedWork =
    std::function<void(const Execution& execution, const std::function<bool()>& ask)>;

// Does the same for work that asks, always in another thread.
void run_watched_until_asked(unsigned threads, const nanobind::object& progress,
                             const WatchedWork& work);

// Returns the result of work that run_watched() runs.
template <class Work>
auto watched(std::size_t size, unsigned threads, const nanobind::object& progress,
             const Work& work) {
  std::optional<std::invoke_result_t<Work, const Execution&>> result;
  run_watched(size, threads, progress,
              [&](const Execution& execution) { result.emplace(work(execution)); });
  return std::move(*result);
}

// Does the same without a listener.
template <class Work>
auto watched_quietly(std::size_t size, unsigned threads, const Work& work) {
  return watched(size, threads, nanobind::none(), work);
}

// Runs work that is not watched, without the lock of the interpreter.
template <class Work>
auto unlocked(const Work& work) {
  const nanobind::gil_scoped_release released;
  return work();
}

}  // namespace rondel::python
