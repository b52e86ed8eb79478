// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// arrangement_bench N [THREADS] [--seed S]: measures the arrangement of N arcs of random places and
// directions, which cross each other about N times, in nanoseconds a crossing; and the union of
// triangles between three such places each, and their relations to each other, in nanoseconds a pair
// of triangles that intersect. Prints one JSON object.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "exact/vector.h"
#include "inputs.h"
#include "measure.h"
#include "rondel/arrangement.h"
#include "rondel/relate.h"
#include "rondel/rondel.h"
#include "rondel/set_operations.h"

namespace {

using rondel::Index;
using rondel::Point;

struct Arcs {
  std::vector<Point> points;
  std::vector<std::array<Index, 2>> ends;
};

// Returns the place at an angle from p, in the direction towards q.
Point at_angle(const Point& p, const Point& q, double angle) {
  const Point side = rondel::normalized(rondel::cross(p, q));
  return rondel::normalized(std::cos(angle) * p + std::sin(angle) * rondel::cross(side, p));
}

// Arcs of length x cross each other n^2 x^2 / (4 pi^2) times.
Arcs make_arcs(std::size_t n, std::uint64_t seed) {
  const double length = 2 * std::numbers::pi / std::sqrt(static_cast<double>(n));
  const std::vector<Point> places = rondel::bench::make_input("uniform", 2 * n, seed);
  Arcs arcs;
  for (std::size_t i = 0; i < n; ++i) {
    const auto first = static_cast<Index>(arcs.points.size());
    arcs.points.push_back(places[2 * i]);
    arcs.points.push_back(at_angle(places[2 * i], places[2 * i + 1], length));
    arcs.ends.push_back({first, first + 1});
  }
  return arcs;
}

// A triangle for each arc, which is one of its sides; each overlaps several others.
rondel::CellRings make_triangles(std::size_t n, std::uint64_t seed) {
  const Arcs arcs = make_arcs(n, seed);
  rondel::CellRings triangles;
  for (const auto& [a, b] : arcs.ends) {
    const Point& p = arcs.points[a];
    const Point& q = arcs.points[b];
    const auto first = static_cast<Index>(triangles.points.size());
    const Point left = rondel::cross(p, q);
    triangles.points.insert(triangles.points.end(), {p, q, rondel::normalized(p + q + left)});
    triangles.append_ring(std::array<Index, 3>{first, first + 1, first + 2});
    triangles.end_cell();
  }
  return triangles;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 2) {
    std::fprintf(stderr, "usage: arrangement_bench N [THREADS] [--seed S]\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  const unsigned threads = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const rondel::Execution execution{.threads = threads};
  const auto arranged = rondel::bench::measure(
      [&] { return make_arcs(n, seed++); },
      [&](const Arcs& arcs) { return rondel::arrange(arcs.points, arcs.ends, execution); });
  const auto united = rondel::bench::measure(
      [&] { return make_triangles(n, seed++); },
      [&](const rondel::CellRings& triangles) { return rondel::unite(triangles, execution); });
  const auto joined = rondel::bench::measure([&] { return make_triangles(n, seed++); },
                                             [&](const rondel::CellRings& triangles) {
                                               return rondel::related_pairs(
                                                   triangles, triangles,
                                                   rondel::SpatialPredicate::intersects, execution);
                                             });
  const auto pairs = static_cast<double>(joined.result->size());
  const auto crossings = static_cast<double>(arranged.result->nodes.size() - 2 * n);
  rondel::bench::print_json({{"arcs", static_cast<double>(n)},
                             {"threads", static_cast<double>(threads)},
                             {"crossings", crossings},
                             {"ns_a_crossing", arranged.seconds / crossings * 1e9},
                             {"union_ns_a_triangle", united.seconds / static_cast<double>(n) * 1e9},
                             {"union_corners", static_cast<double>(united.result->corners.size())},
                             {"related_pairs", pairs},
                             {"relate_ns_a_pair", joined.seconds / pairs * 1e9}});
}
