// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/delaunay.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "api/validation.h"
#include "blocks/spatial_order.h"
#include "incremental/triangulate.h"
#include "rondel/error.h"

namespace rondel {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void announce(const Options& options, std::string_view stage, double fraction) {
  if (options.progress) options.progress(stage, fraction);
}

unsigned num_threads(const Options& options) {
  return options.threads != 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace

Triangulation delaunay(std::span<const Point> sites, const Options& options) {
  api::validate(sites, options);
  BuildReport report;
  report.threads = num_threads(options);
  const auto start = Clock::now();
  announce(options, "order", 0);
  auto order = blocks::spatial_order(sites, options.model, options.sphere.center);
  report.order_seconds = seconds_since(start);

  const auto order_end = Clock::now();
  auto built = incremental::triangulate(sites, std::move(order.order), order.renamed, options);
  announce(options, "triangulate", 1);
  report.triangulate_seconds = seconds_since(order_end);
  report.rungs = built.tally;
  built.arrays.num_sites = sites.size();
  built.arrays.duplicates = std::move(order.duplicates);
  return {std::move(built.arrays), options, report};
}

Triangulation delaunay(std::span<const double> xyz, const Options& options) {
  if (xyz.size() % 3 != 0) {
    throw InvalidInput("an array of points has length " + std::to_string(xyz.size()) +
                           ", which is not a multiple of 3",
                       xyz.size() - xyz.size() % 3);
  }
  static_assert(sizeof(Point) == 3 * sizeof(double));
  return delaunay({reinterpret_cast<const Point*>(xyz.data()), xyz.size() / 3}, options);
}

}  // namespace rondel
