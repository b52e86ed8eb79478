// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that all measuring programs share: seconds, memory, and one JSON object on standard output.
//
// 1. Rondel and its peers are all measured warm. The first build in a process waits for memory from
//    the system, which a virtual machine may provide at 1 GB/s or less when it is first used; its
//    time is reported separately. Afterwards the heap keeps freed memory, as it always does for
//    small builds. The second build fills the heap, and the result is the median of the following
//    builds: of `enough_runs`, or of more if they and their inputs take less than `enough_seconds`,
//    or of fewer if they take `long_seconds`. Each build has an input with its own seed, since a
//    processor learns the branches of a small input that is repeated.
// 2. Memory is the growth of the peak of resident memory during the first build, beyond what the
//    process held before; an input in memory does not count.
// 3. Making an input and releasing a result are not measured.
// 4. Counts of a result are taken after the first build, whose input is the same for every program.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace rondel::bench {

inline constexpr std::size_t enough_runs = 3;
inline constexpr double enough_seconds = 0.25;
inline constexpr double long_seconds = 8;

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

template <class Work>
double seconds_of(Work work) {
  const Stopwatch watch;
  work();
  return watch.seconds();
}

// Measures the growth of the peak of resident memory since its construction, which returns unused
// memory of the heap to the system and resets the peak. If the system cannot reset it, the growth
// may be too small.
class MemoryMeter {
 public:
  MemoryMeter();
  [[nodiscard]] double growth_bytes() const;

 private:
  double before_ = 0;
};

// Makes the heap keep freed memory. glibc would otherwise return the memory of large arrays to the
// system at once.
void keep_freed_memory();

inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

struct Counts {
  std::size_t sites = 0;
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

template <class Input, class Result>
struct Measured {
  std::optional<Input> input;  // input of the last run
  std::optional<Result> result;
  Counts counts;       // counts of the first run
  double seconds = 0;  // median
  double first_seconds = 0;
  double memory_bytes = 0;
};

// Measures builds: make() returns an Input, build(Input&) a Result, count(Input&, Result&) Counts.
template <class Make, class Build, class Count>
auto measure(Make make, Build build, Count count) {
  using Input = std::invoke_result_t<Make>;
  Measured<Input, std::invoke_result_t<Build, Input&>> measured;
  const auto prepare = [&] {
    measured.result.reset();
    measured.input.reset();
    measured.input.emplace(make());
  };
  const auto run = [&] {
    return seconds_of([&] { measured.result.emplace(build(*measured.input)); });
  };
  prepare();
  const MemoryMeter memory;
  measured.first_seconds = run();
  measured.memory_bytes = memory.growth_bytes();
  measured.counts = count(*measured.input, *measured.result);
  keep_freed_memory();
  prepare();
  run();
  std::vector<double> seconds;
  double sum = 0;
  const Stopwatch watch;
  while (watch.seconds() < enough_seconds || (seconds.size() < enough_runs && sum < long_seconds)) {
    prepare();
    seconds.push_back(run());
    sum += seconds.back();
  }
  measured.seconds = median(std::move(seconds));
  return measured;
}

template <class Make, class Build>
auto measure(Make make, Build build) {
  return measure(make, build, [](const auto&, const auto&) { return Counts{}; });
}

struct Field {
  const char* name;
  double value;
};

// Prints {"name": value, ...} and a newline; whole numbers are printed without a point.
void print_json(std::initializer_list<Field> fields);

// Prints the report of a build by a peer.
template <class Input, class Result>
void print_build(const Measured<Input, Result>& measured) {
  const auto n = static_cast<double>(measured.counts.sites);
  print_json({{"sites", n},
              {"vertices", static_cast<double>(measured.counts.vertices)},
              {"faces", static_cast<double>(measured.counts.faces)},
              {"seconds", measured.seconds},
              {"first_seconds", measured.first_seconds},
              {"bytes_per_site", measured.memory_bytes / n}});
}

}  // namespace rondel::bench
