// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What every measuring program shares: seconds, memory, and one JSON object on standard output.
//
// 1. A build that takes less than `enough_seconds` is repeated in the process until that much time
//    has passed, and its median counts: Rondel and its peers alike are measured warm when small.
// 2. Memory is the growth of the peak of resident memory during the first build, above what the
//    process held before: input that is in memory does not count.
// 3. Releasing a result is not measured.
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

inline constexpr double enough_seconds = 0.25;

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

// The growth of the peak of resident memory since its construction, which returns unused memory of
// the heap to the system and resets the peak. Where the system cannot, the peak so far counts, and
// the growth may be too small.
class MemoryMeter {
 public:
  MemoryMeter();
  [[nodiscard]] double growth_bytes() const;

 private:
  double before_ = 0;
};

inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

template <class Result>
struct Measured {
  std::optional<Result> result;  // of the last run
  double seconds = 0;            // the median
  double memory_bytes = 0;
};

template <class Build>
auto measure(Build build) {
  Measured<std::invoke_result_t<Build>> measured;
  std::vector<double> seconds;
  double sum = 0;
  const MemoryMeter memory;
  do {
    measured.result.reset();
    const Stopwatch watch;
    measured.result.emplace(build());
    seconds.push_back(watch.seconds());
    sum += seconds.back();
    if (seconds.size() == 1) measured.memory_bytes = memory.growth_bytes();
  } while (sum < enough_seconds);
  measured.seconds = median(std::move(seconds));
  return measured;
}

struct Field {
  const char* name;
  double value;
};

// {"name": value, ...} and a newline; whole numbers are printed as such.
void print_json(std::initializer_list<Field> fields);

// What the peers report.
template <class Result>
void print_build(std::size_t sites, std::size_t vertices, std::size_t faces,
                 const Measured<Result>& measured) {
  const auto n = static_cast<double>(sites);
  print_json({{"sites", n},
              {"vertices", static_cast<double>(vertices)},
              {"faces", static_cast<double>(faces)},
              {"seconds", measured.seconds},
              {"bytes_per_site", measured.memory_bytes / n}});
}

}  // namespace rondel::bench
