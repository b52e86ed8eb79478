// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// accuracy_bench SITES N TARGETS M [--seed S]: prints, for each method, the root mean square of the
// errors at the targets for Renka's function F0 = 1 + x^8 + exp(2 y^3) + exp(2 z^2) + 10 x y z, as
// one JSON object. SITES and TARGETS are kinds of inputs or files.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "inputs.h"
#include "rondel/delaunay.h"
#include "rondel/interpolate.h"

namespace {

using rondel::Method;
using rondel::Point;

double f0(const Point& p) {
  return 1 + std::pow(p.x, 8) + std::exp(2 * p.y * p.y * p.y) + std::exp(2 * p.z * p.z) +
         10 * p.x * p.y * p.z;
}

Point gradient_of_f0(const Point& p) {
  const double e_y = std::exp(2 * p.y * p.y * p.y);
  const double e_z = std::exp(2 * p.z * p.z);
  const Point g = {8 * std::pow(p.x, 7) + 10 * p.y * p.z, 6 * p.y * p.y * e_y + 10 * p.x * p.z,
                   4 * p.z * e_z + 10 * p.x * p.y};
  const double up = g.x * p.x + g.y * p.y + g.z * p.z;
  return {g.x - up * p.x, g.y - up * p.y, g.z - up * p.z};
}

double root_mean_square(std::span<const double> values, std::span<const Point> targets) {
  double sum = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) sum += std::pow(values[i] - f0(targets[i]), 2);
  return std::sqrt(sum / static_cast<double>(targets.size()));
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc != 5) {
    std::fprintf(stderr, "usage: accuracy_bench SITES N TARGETS M [--seed S]\n");
    return 2;
  }
  const auto sites = rondel::bench::make_input(argv[1], std::strtoull(argv[2], nullptr, 10), seed);
  const auto targets =
      rondel::bench::make_input(argv[3], std::strtoull(argv[4], nullptr, 10), seed + 1000);
  std::vector<double> field;
  std::vector<Point> gradients;
  for (const Point& p : sites) {
    field.push_back(f0(p));
    gradients.push_back(gradient_of_f0(p));
  }
  const rondel::Interpolator interpolator(rondel::delaunay(sites));
  std::printf(R"({"sites": %zu, "targets": %zu)", sites.size(), targets.size());
  const auto print = [&](const char* name, const std::vector<double>& values) {
    std::printf(", \"%s\": %.6e", name, root_mean_square(values, targets));
  };
  print("linear", interpolator.values(field, targets, {.method = Method::linear}));
  print("laplace", interpolator.values(field, targets, {.method = Method::laplace}));
  print("sibson", interpolator.values(field, targets, {.method = Method::sibson}));
  print("hermite", interpolator.values(field, targets, {.method = Method::hermite}));
  print("cubic", interpolator.values(field, targets, {.method = Method::cubic}));
  print("hermite_exact",
        interpolator.values(field, gradients, targets, {.method = Method::hermite}));
  print("cubic_exact", interpolator.values(field, gradients, targets, {.method = Method::cubic}));
  std::printf("}\n");
}
