// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// laws_bench N [--seed S]: measures how far weights deviate from their laws, for about N sites of
// several kinds and as many targets: random ones, sites, midpoints of edges, points exactly on
// edges, circumcenters. Prints one JSON object a line: the number of rows, and of rows with two
// weights; the largest |sum of weights - 1| over 2^-52, divided by the sum of absolute weights if
// they have signs; and the largest length of u x (sum of weights times sites).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/interpolate.h"

namespace {

using rondel::Method;
using rondel::Point;

struct Kind {
  const char* name;
  bool is_patch;  // 1e-6 radians wide, as are its targets
};
constexpr std::array<Kind, 4> kinds = {
    {{"uniform", false}, {"fibonacci", false}, {"lonlat-grid", false}, {"patch", true}}};

Point scaled_sum(const Point& a, const Point& b) {
  const Point sum = {a.x + b.x, a.y + b.y, a.z + b.z};
  const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
  return {sum.x / length, sum.y / length, sum.z / length};
}

bool is_exact(double a, double b) {
  const double sum = a + b;
  return sum - a == b && sum - b == a;
}

// Appends a + b, whose ray is exactly on the edge, if no coordinate is rounded: for a few edges in
// a hundred.
void append_if_on_edge(const Point& a, const Point& b, std::vector<Point>& targets) {
  if (is_exact(a.x, b.x) && is_exact(a.y, b.y) && is_exact(a.z, b.z)) {
    targets.push_back({a.x + b.x, a.y + b.y, a.z + b.z});
  }
}

std::vector<Point> targets_of(const rondel::Triangulation& triangulation, bool is_patch,
                              std::size_t n, std::uint64_t seed) {
  const auto sites = triangulation.sites().points();
  std::vector<Point> targets = rondel::bench::make_input(is_patch ? "patch" : "uniform", n, seed);
  const std::size_t stride = std::max<std::size_t>(1, sites.size() / n);
  for (std::size_t i = 0; i < sites.size(); i += stride) targets.push_back(sites[i]);
  for (const auto& [a, b] : rondel::edges(triangulation)) {
    if (targets.size() >= 3 * n) break;
    targets.push_back(scaled_sum(sites[a], sites[b]));
  }
  for (const auto& [a, b] : rondel::edges(triangulation)) {
    append_if_on_edge(sites[a], sites[b], targets);
  }
  const std::size_t most = targets.size() + n;
  for (const Point& p : rondel::circumcenters(triangulation)) {
    if (targets.size() >= most) break;
    targets.push_back(p);
  }
  return targets;
}

void print_laws(const rondel::Interpolator& interpolator, const char* kind, Method method,
                const char* name, const std::vector<Point>& sites,
                const std::vector<Point>& targets) {
  const rondel::Weights weights =
      interpolator.weights(targets, {.method = method, .hashes = false});
  double unity = 0;
  double direction = 0;
  std::size_t rows = 0;
  std::size_t rows_of_two = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (weights.offsets[t] == weights.offsets[t + 1]) continue;
    ++rows;
    if (weights.offsets[t + 1] - weights.offsets[t] == 2) ++rows_of_two;
    double sum = 0;
    double absolute = 0;
    std::array<long double, 3> place{};
    for (auto k = weights.offsets[t]; k < weights.offsets[t + 1]; ++k) {
      const double w = weights.values[k];
      const Point& x = sites[weights.columns[k]];
      sum += w;
      absolute += std::abs(w);
      place = {place[0] + static_cast<long double>(w) * x.x,
               place[1] + static_cast<long double>(w) * x.y,
               place[2] + static_cast<long double>(w) * x.z};
    }
    const Point& u = targets[t];
    const std::array<long double, 3> off = {u.y * place[2] - u.z * place[1],
                                            u.z * place[0] - u.x * place[2],
                                            u.x * place[1] - u.y * place[0]};
    const long double square =
        (off[0] * off[0] + off[1] * off[1] + off[2] * off[2]) / (u.x * u.x + u.y * u.y + u.z * u.z);
    unity = std::max(unity, std::abs(sum - 1) / absolute / 0x1p-52);
    direction = std::max(direction, static_cast<double>(std::sqrt(square)));
  }
  std::printf(R"({"kind": "%s", "sites": %zu, "method": "%s", "rows": %zu, "of_two": %zu, )"
              R"("unity_ulp": %.3g)",
              kind, sites.size(), name, rows, rows_of_two, unity);
  // The methods hermite and cubic do not promise this law.
  if (method < Method::hermite) std::printf(R"(, "direction": %.3g)", direction);
  std::printf("}\n");
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 2) {
    std::fprintf(stderr, "usage: laws_bench N [--seed S]\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  for (const auto& [kind, is_patch] : kinds) {
    const auto sites = rondel::bench::make_input(kind, n, seed);
    const rondel::Triangulation triangulation = rondel::delaunay(sites);
    const auto targets = targets_of(triangulation, is_patch, n / 4, seed + 1);
    const rondel::Interpolator interpolator(triangulation);
    for (const auto& [method, name] : {std::pair{Method::linear, "linear"},
                                       {Method::laplace, "laplace"},
                                       {Method::sibson, "sibson"},
                                       {Method::hermite, "hermite"},
                                       {Method::cubic, "cubic"}}) {
      print_laws(interpolator, kind, method, name, sites, targets);
    }
  }
  return 0;
}
