// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The code that benchmarks of the parts share. Each uses one thread, and reports the time for one site
// (face, query, call) as the counter "each".
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "inputs.h"
#include "rondel/delaunay.h"

namespace rondel::bench {

inline constexpr std::int64_t small_size = std::int64_t{1} << 12;
inline constexpr std::int64_t large_size = std::int64_t{1} << 20;

// Sites and their triangulation, made when they are first used.
struct Case {
  std::vector<Point> sites;
  Triangulation triangulation;
};

inline const Case& case_of(const std::string& kind, std::int64_t n) {
  static std::map<std::pair<std::string, std::int64_t>, Case> cases;
  const auto [entry, is_new] = cases.try_emplace({kind, n});
  Case& found = entry->second;
  if (is_new) {
    found.sites = make_input(kind, static_cast<std::size_t>(n));
    found.triangulation = delaunay(found.sites, {}, {.threads = 1});
  }
  return found;
}

// A set of so many inputs that a processor cannot learn their branches.
class Inputs {
 public:
  Inputs(const std::string& kind, std::int64_t n) {
    for (std::int64_t sites = 0; sites < large_size; sites += n)
      all_.push_back(make_input(kind, static_cast<std::size_t>(n), all_.size() + 1));
  }
  const std::vector<Point>& next() { return all_[next_++ % all_.size()]; }

 private:
  std::vector<std::vector<Point>> all_;
  std::size_t next_ = 0;
};

inline void report_each(benchmark::State& state, std::size_t count) {
  state.counters["each"] =
      benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

}  // namespace rondel::bench
