// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Measures queries to a triangulation, in batches and one by one.

#include <span>

#include "parts.h"
#include "rondel/query.h"

namespace rondel::bench {
namespace {

constexpr std::size_t num_queries = std::size_t{1} << 16;

std::span<const Point> queries() {
  static const auto points =
      make_input("uniform", static_cast<std::size_t>(large_size) + num_queries);
  return std::span(points).last(num_queries);
}

// Measures work(locator), which does all queries.
template <class Work>
void measure_queries(benchmark::State& state, Work work) {
  const Case& uniform = case_of("uniform", state.range(0));
  const Locator locator(uniform.triangulation);
  for (auto _ : state) benchmark::DoNotOptimize(work(locator));
  report_each(state, num_queries);
}

void query_prepare(benchmark::State& state) {
  const Case& uniform = case_of("uniform", state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(Locator(uniform.triangulation));
  report_each(state, uniform.sites.size());
}

void query_locate(benchmark::State& state) {
  measure_queries(state,
                  [](const Locator& locator) { return locator.locate(queries(), {.threads = 1}); });
}

void query_nearest(benchmark::State& state) {
  measure_queries(
      state, [](const Locator& locator) { return locator.nearest(queries(), {.threads = 1}); });
}

void query_nearest_one_by_one(benchmark::State& state) {
  measure_queries(state, [](const Locator& locator) {
    std::uint64_t sum = 0;
    for (const Point& p : queries()) sum += locator.nearest(p);
    return sum;
  });
}

void query_8_nearest(benchmark::State& state) {
  constexpr std::size_t k = 8;
  measure_queries(state, [](const Locator& locator) {
    return locator.k_nearest(queries(), k, {.threads = 1});
  });
}

BENCHMARK(query_prepare)->Arg(small_size)->Arg(large_size);
BENCHMARK(query_locate)->Arg(small_size)->Arg(large_size);
BENCHMARK(query_nearest)->Arg(small_size)->Arg(large_size);
BENCHMARK(query_nearest_one_by_one)->Arg(small_size)->Arg(large_size);
BENCHMARK(query_8_nearest)->Arg(large_size);

}  // namespace
}  // namespace rondel::bench
