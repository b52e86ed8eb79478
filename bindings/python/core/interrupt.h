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

// Runs the work on `size` items without the lock of the interpreter. Where there are many items, or
// somebody listens, another thread does it, and this one wakes some times a second
// 1. to run the handlers of signals: Ctrl-C ends the work at its next piece, and then raises
//    KeyboardInterrupt;
// 2. to tell `listener`, if it is not None, the stage and the fraction done. An exception of the
//    listener ends the work, too.
// The work passes what it is given, with the number of threads, to the library. Called with the lock
// of the interpreter.
void run_watched(std::size_t size, unsigned threads, const nanobind::object& listener,
                 const std::function<void(const Execution&)>& work);

// Work, and how it asks at its end, once, whether one of the two has raised: they are called a last
// time before, and not again, so that it can tell others and nothing is raised behind its back.
using WatchedWork =
    std::function<void(const Execution& execution, const std::function<bool()>& ask)>;

// The same, always by another thread, for work that asks.
void run_watched_until_asked(unsigned threads, const nanobind::object& listener,
                             const WatchedWork& work);

// As run_watched() for work that returns something.
template <class Work>
auto watched(std::size_t size, unsigned threads, const nanobind::object& listener,
             const Work& work) {
  std::optional<std::invoke_result_t<Work, const Execution&>> result;
  run_watched(size, threads, listener,
              [&](const Execution& execution) { result.emplace(work(execution)); });
  return std::move(*result);
}

// Work on many items without progress.
template <class Work>
auto watched_quietly(std::size_t size, unsigned threads, const Work& work) {
  return watched(size, threads, nanobind::none(), work);
}

// Work that is not watched, without the lock of the interpreter.
template <class Work>
auto unlocked(const Work& work) {
  const nanobind::gil_scoped_release released;
  return work();
}

}  // namespace rondel::python
