// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What every measuring program shares: seconds, memory, and one JSON object on standard output.
//
// 1. Rondel and its peers alike are measured warm. The first build in a process waits for memory
//    from the system, which a virtual machine may provide at 1 GB/s or less when it is touched; its
//    time is reported apart. From then on the heap keeps what is freed, as it does in any case for
//    small builds. The second build fills it, and the median of the next counts: of `enough_runs`,
//    or of more if they take less than `enough_seconds`, or of fewer if they take `long_seconds`.
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

// Where the C library is glibc. It returns the memory of large arrays to the system at once else.
void keep_freed_memory();

inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

template <class Result>
struct Measured {
  std::optional<Result> result;  // of the last run
  double seconds = 0;            // the median
  double first_seconds = 0;
  double memory_bytes = 0;
};

template <class Build>
auto measure(Build build) {
  Measured<std::invoke_result_t<Build>> measured;
  const auto run = [&] {
    measured.result.reset();
    return seconds_of([&] { measured.result.emplace(build()); });
  };
  const MemoryMeter memory;
  measured.first_seconds = run();
  measured.memory_bytes = memory.growth_bytes();
  keep_freed_memory();
  run();
  std::vector<double> seconds;
  double sum = 0;
  while (sum < enough_seconds || (seconds.size() < enough_runs && sum < long_seconds)) {
    seconds.push_back(run());
    sum += seconds.back();
  }
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
              {"first_seconds", measured.first_seconds},
              {"bytes_per_site", measured.memory_bytes / n}});
}

}  // namespace rondel::bench
