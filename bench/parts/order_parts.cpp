// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Measures the spatial order and its parts.

#include "order/place_keys.h"
#include "order/sorts.h"
#include "order/spatial_order.h"
#include "parts.h"

namespace rondel::bench {
namespace {

std::vector<std::uint64_t> keys_of(const std::vector<Point>& sites) {
  std::vector<std::uint64_t> keys(sites.size());
  order::place_keys(sites, Model::projected, {}, keys);
  return keys;
}

void order_keys(benchmark::State& state, Model model) {
  const auto& sites = case_of("uniform", small_size).sites;
  std::vector<std::uint64_t> keys(sites.size());
  for (auto _ : state) {
    order::place_keys(sites, model, {}, keys);
    benchmark::DoNotOptimize(keys.data());
  }
  report_each(state, sites.size());
}

// Sorts one leaf of the key tree.
void order_sort_words(benchmark::State& state) {
  const auto unsorted = keys_of(case_of("uniform", state.range(0)).sites);
  std::vector<std::uint64_t> words(unsorted.size());
  std::vector<std::uint64_t> sorted(unsorted.size());
  for (auto _ : state) {
    words = unsorted;
    order::sort_words(words, sorted);
    benchmark::DoNotOptimize(sorted.data());
  }
  report_each(state, unsorted.size());
}

// Sorts keys as queries do.
void order_radix_sort(benchmark::State& state) {
  order::KeyedIndices unsorted;
  unsorted.keys = keys_of(case_of("uniform", state.range(0)).sites);
  for (Index i = 0; i < unsorted.keys.size(); ++i) unsorted.indices.push_back(i);
  order::KeyedIndices data;
  for (auto _ : state) {
    data = unsorted;
    order::radix_sort(data, order::high_key_bits);
    benchmark::DoNotOptimize(data.indices.data());
  }
  report_each(state, unsorted.keys.size());
}

void order_whole(benchmark::State& state, const std::string& kind) {
  const auto& sites = case_of(kind, state.range(0)).sites;
  for (auto _ : state) {
    benchmark::DoNotOptimize(order::spatial_order(sites, Model::projected, {}, 1));
  }
  report_each(state, sites.size());
}

BENCHMARK_CAPTURE(order_keys, projected, Model::projected);
BENCHMARK_CAPTURE(order_keys, weighted, Model::weighted);
BENCHMARK(order_sort_words)->Arg(small_size);
BENCHMARK(order_radix_sort)->Arg(small_size)->Arg(large_size);
BENCHMARK_CAPTURE(order_whole, uniform, "uniform")->Arg(small_size)->Arg(large_size);
BENCHMARK_CAPTURE(order_whole, patch, "patch")->Arg(large_size);

}  // namespace
}  // namespace rondel::bench
