// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Measures the rungs of the conflict test (predicates/conflict.h), each on the calls that verifying
// a triangulation makes: a face and the corner across one of its edges. The sites of "patch" are
// about 1e-8 apart.

#include <array>

#include "exact/unit_vector.h"
#include "parts.h"
#include "predicates/conflict.h"
#include "predicates/perturbation.h"
#include "predicates/side_of_circle.h"
#include "predicates/side_of_plane.h"
#include "rondel/predicates.h"

namespace rondel::bench {
namespace {

using predicates::Vector;
using Four = std::array<Point, 4>;

constexpr std::size_t num_calls = 4096;

Index corner_across(std::span<const Triple> faces, Index f, Index g) {
  for (const Index corner : faces[g]) {
    if (corner != faces[f][0] && corner != faces[f][1] && corner != faces[f][2]) return corner;
  }
  return faces[g][0];
}

std::vector<Four> calls_of(const std::string& kind) {
  const Case& of = case_of(kind, small_size);
  const auto faces = of.triangulation.faces();
  std::vector<Four> calls;
  for (Index f = 0; f < faces.size() && calls.size() < num_calls; ++f) {
    const Index p = corner_across(faces, f, of.triangulation.neighbors()[f][0]);
    calls.push_back(
        {of.sites[faces[f][0]], of.sites[faces[f][1]], of.sites[faces[f][2]], of.sites[p]});
  }
  return calls;
}

// Returns squares of an integer grid in a plane that is not parallel to an axis, so that every test
// is a tie.
std::vector<Four> coplanar_calls() {
  std::vector<Four> calls;
  for (std::size_t i = 0; i < num_calls; ++i) {
    constexpr std::size_t side = 64;
    const std::size_t row = i / side;
    const auto u = static_cast<double>(i % side);
    const auto v = static_cast<double>(row);
    const auto at = [](double x, double y) { return Point{x, y, 200 - x - y}; };
    calls.push_back({at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)});
  }
  return calls;
}

// The forms in which rungs take points.
Point as_given(const Point& p) { return p; }
exact::SplitPoint as_split(const Point& p) { return exact::unit_vector(p, {}); }
Vector as_vector(const Point& p) { return exact::to_vector(p); }
Vector as_direction(const Point& p) { return exact::to_vector(as_split(p).hi); }

// Measures a rung that decides all calls; their points are converted before the clock starts.
template <class Convert, class Rung>
void measure_rung(benchmark::State& state, const std::vector<Four>& calls, Convert convert,
                  Rung rung) {
  using Converted = decltype(convert(Point{}));
  std::vector<std::array<Converted, 4>> converted;
  converted.reserve(calls.size());
  for (const auto& [a, b, c, p] : calls) {
    converted.push_back({convert(a), convert(b), convert(c), convert(p)});
  }
  for (auto _ : state) {
    for (const auto& [a, b, c, p] : converted) benchmark::DoNotOptimize(rung(a, b, c, p));
  }
  report_each(state, converted.size());
}

void circle_filter(benchmark::State& state, const std::string& kind) {
  measure_rung(state, calls_of(kind), as_direction, predicates::side_of_circle_filter);
}

void circle_double_double(benchmark::State& state, const std::string& kind) {
  measure_rung(state, calls_of(kind), as_split, predicates::side_of_circle_double_double);
}

void circle_exact(benchmark::State& state, const std::string& kind) {
  measure_rung(state, calls_of(kind), as_given,
               [](const auto& a, const auto& b, const auto& c, const auto& p) {
                 return predicates::side_of_circle_exact({a, b, c, p}, {});
               });
}

void plane_filter(benchmark::State& state, const std::string& kind) {
  measure_rung(state, calls_of(kind), as_vector, predicates::side_of_plane_filter);
}

void plane_ladder_of_ties(benchmark::State& state) {
  measure_rung(state, coplanar_calls(), as_given,
               [](const auto& a, const auto& b, const auto& c, const auto& p) {
                 const predicates::FourPoints<Model::weighted> points{{a, b, c, p}};
                 return predicates::side(points, 0, 1, 2, 3).sign;
               });
}

void plane_perturbation(benchmark::State& state) {
  measure_rung(state, coplanar_calls(), as_given,
               [](const auto& a, const auto& b, const auto& c, const auto& p) {
                 return predicates::is_in_conflict_perturbed(a, b, c, p, Model::weighted, {});
               });
}

// Measures the whole ladder behind the public interface.
void conflict_test(benchmark::State& state, const std::string& kind, Model model) {
  measure_rung(state, calls_of(kind), as_given,
               [model](const auto& a, const auto& b, const auto& c, const auto& p) {
                 return is_in_conflict(a, b, c, p, model);
               });
}

BENCHMARK_CAPTURE(circle_filter, uniform, "uniform");
BENCHMARK_CAPTURE(circle_filter, patch, "patch");
BENCHMARK_CAPTURE(circle_filter, grid, "grid");
BENCHMARK_CAPTURE(circle_double_double, uniform, "uniform");
BENCHMARK_CAPTURE(circle_exact, uniform, "uniform");
BENCHMARK_CAPTURE(circle_exact, grid, "grid");
BENCHMARK_CAPTURE(plane_filter, uniform, "uniform");
BENCHMARK(plane_ladder_of_ties);
BENCHMARK(plane_perturbation);
BENCHMARK_CAPTURE(conflict_test, uniform_projected, "uniform", Model::projected);
BENCHMARK_CAPTURE(conflict_test, uniform_weighted, "uniform", Model::weighted);
BENCHMARK_CAPTURE(conflict_test, grid_projected, "grid", Model::projected);

}  // namespace
}  // namespace rondel::bench
