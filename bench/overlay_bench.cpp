// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// overlay_bench N M [THREADS] [--seed S] [--kind KIND] [--pair PAIR]: conservative weights from the Voronoi cells of N
// sites to others, and one JSON object on standard output: nanoseconds a cell for the partitions, made of triangulations
// that are there, and a piece for the overlay with its weights, of order 1 and 2. Every repetition has sites of its own,
// and medians count. PAIR says what the others are:
//
//   other    the cells of M other sites (default)
//   same     the same cells
//   turned   those of the same sites, turned by 1e-15 about the z axis
//   half     every other one of the same cells: polygons that touch in corners, and run along edges
//
// Of the last repetition, order 1, also the greatest difference of a row's sum to the share of its target that is covered,
// and of what all pieces add up to from what the smaller partition does, as a share of it.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/delaunay.h"
#include "rondel/remap.h"

namespace {

using rondel::Partition;
using rondel::bench::seconds_of;

constexpr std::uint64_t repetitions = 3;

struct What {
  std::string kind;
  std::string pair;
  std::size_t n = 0;
  std::size_t m = 0;
  std::uint64_t seed = 0;
};

struct Measured {
  std::vector<double> partition_seconds;
  std::vector<double> first_seconds;
  std::vector<double> second_seconds;
  rondel::Remap last;  // of order 1
  double sum_error = 0;
};

// The value of an option, which it takes out of the arguments.
std::string take_option(int& argc, char** argv, std::string_view name, const char* otherwise) {
  char** const end = argv + argc;
  char** const at = std::find(argv, end, name);
  if (end - at < 2) return otherwise;
  std::string value = at[1];
  std::copy(at + 2, end, at);
  argc -= 2;
  return value;
}

std::vector<rondel::Point> turned(std::vector<rondel::Point> sites) {
  constexpr double angle = 1e-15;
  for (rondel::Point& p : sites) p = {p.x - angle * p.y, p.y + angle * p.x, p.z};
  return sites;
}

Partition every_other(const Partition& partition, const rondel::Execution& execution) {
  const rondel::CellRings all = partition.rings();
  rondel::CellRings half;
  half.points = all.points;
  for (std::size_t i = 0; i < all.num_cells(); i += 2) {
    for (std::uint64_t ring = all.cells[i]; ring < all.cells[i + 1]; ++ring) {
      const auto first = all.corners.begin();
      half.corners.insert(half.corners.end(), first + static_cast<std::ptrdiff_t>(all.rings[ring]),
                          first + static_cast<std::ptrdiff_t>(all.rings[ring + 1]));
      half.rings.push_back(half.corners.size());
    }
    half.cells.push_back(half.rings.size() - 1);
  }
  return Partition(half, execution);
}

double sum_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double row_error(const rondel::Remap& remap) {
  double most = 0;
  const rondel::Weights& weights = remap.weights;
  for (std::size_t r = 0; r < weights.num_rows(); ++r) {
    const std::size_t size = weights.offsets[r + 1] - weights.offsets[r];
    const double sum = sum_of(std::span(weights.values).subspan(weights.offsets[r], size));
    most = std::max(most, std::abs(sum - remap.target_fractions[r]));
  }
  return most;
}

void repeat(std::uint64_t k, const What& what, const rondel::Execution& execution,
            Measured& measured) {
  const auto sites = rondel::bench::make_input(what.kind, what.n, what.seed);
  const auto other_sites = what.pair == "other"
                               ? rondel::bench::make_input(what.kind, what.m, what.seed + 1)
                           : what.pair == "turned" ? turned(sites)
                                                   : sites;
  const auto source = rondel::delaunay(sites, {}, execution);
  const auto target = rondel::delaunay(other_sites, {}, execution);
  std::vector<Partition> partitions;
  const double seconds = seconds_of([&] {
    partitions.push_back(Partition::voronoi(source, execution));
    partitions.push_back(Partition::voronoi(target, execution));
  });
  if (what.pair == "half") partitions[0] = every_other(partitions[1], execution);
  const auto remap = [&](unsigned order) {
    return seconds_of([&] {
      measured.last = rondel::remap(partitions[0], partitions[1], {.order = order}, execution);
    });
  };
  const double second = remap(2);
  const double first = remap(1);
  const double smaller = std::min(sum_of(partitions[0].areas()), sum_of(partitions[1].areas()));
  measured.sum_error = std::abs(sum_of(measured.last.areas) - smaller) / smaller;
  if (k == 0) return;  // has waited for memory
  measured.partition_seconds.push_back(seconds);
  measured.first_seconds.push_back(first);
  measured.second_seconds.push_back(second);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  const std::string kind = take_option(argc, argv, "--kind", "uniform");
  const std::string pair = take_option(argc, argv, "--pair", "other");
  const bool is_pair = pair == "other" || pair == "same" || pair == "turned" || pair == "half";
  if (argc < 3 || !is_pair) {
    std::fprintf(stderr,
                 "usage: overlay_bench N M [THREADS] [--seed S] [--kind KIND] "
                 "[--pair other|same|turned|half]\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  const std::size_t m = std::strtoull(argv[2], nullptr, 10);
  const rondel::Execution execution{.threads =
                                        argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1};
  rondel::bench::keep_freed_memory();
  Measured measured;
  for (std::uint64_t k = 0; k <= repetitions; ++k) {
    repeat(k, {kind, pair, n, m, seed + 2 * k}, execution, measured);
  }
  const rondel::Remap& result = measured.last;
  const auto sources = static_cast<double>(result.weights.num_columns);
  const auto targets = static_cast<double>(result.weights.num_rows());
  const auto pieces = static_cast<double>(result.areas.size());
  rondel::bench::print_json(
      {{"sources", sources},
       {"targets", targets},
       {"pieces", pieces},
       {"partition_ns_a_cell",
        1e9 * rondel::bench::median(measured.partition_seconds) / (sources + targets)},
       {"overlay_ns_a_piece", 1e9 * rondel::bench::median(measured.first_seconds) / pieces},
       {"second_order_ns_a_piece", 1e9 * rondel::bench::median(measured.second_seconds) / pieces},
       {"row_error", row_error(result)},
       {"sum_error", measured.sum_error}});
  return 0;
}
