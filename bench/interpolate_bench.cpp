// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// interpolate_bench N TARGETS [THREADS] [--seed S]: measures interpolation from uniform sites to
// other uniform points, from points to values, by each method, in nanoseconds a target (gradients:
// a site). Every repetition has its own points; prints the medians as one JSON object.

#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/delaunay.h"
#include "rondel/interpolate.h"

namespace {

using rondel::Method;
using rondel::Point;
using rondel::bench::seconds_of;

constexpr int repetitions = 5;

// A field whose gradient is (y, x, 1), made tangent.
double field_at(const Point& p) { return p.x * p.y + p.z; }
Point gradient_at(const Point& p) {
  const double up = 2 * p.x * p.y + p.z;
  return {p.y - up * p.x, p.x - up * p.y, 1 - up * p.z};
}

struct Series {
  const char* name;
  std::vector<double> seconds;
};

class Bench {
 public:
  Bench(std::size_t n, std::size_t num_targets, unsigned threads)
      : n_(n), num_targets_(num_targets), execution_{.threads = threads} {}

  void run(std::uint64_t seed) {
    const auto points = rondel::bench::make_input("uniform", n_ + num_targets_, seed);
    const auto sites = std::span(points).first(n_);
    const auto targets = std::span(points).last(num_targets_);
    std::vector<double> field;
    std::vector<Point> gradients;
    for (const Point& p : sites) {
      field.push_back(field_at(p));
      gradients.push_back(gradient_at(p));
    }
    const auto triangulation = rondel::delaunay(sites, {}, execution_);
    std::vector<rondel::Interpolator> made;
    next_ = 0;
    take("prepare", [&] { made.emplace_back(triangulation); });
    const rondel::Interpolator& interpolator = made.front();
    const auto values = [&](const char* name, Method method) {
      take(name,
           [&] { sum_ += interpolator.values(field, targets, {.method = method}, execution_)[0]; });
    };
    values("nearest", Method::nearest);
    values("linear", Method::linear);
    values("laplace", Method::laplace);
    values("sibson", Method::sibson);
    values("cubic_estimated", Method::cubic);
    take("hermite", [&] {
      sum_ += interpolator.values(field, gradients, targets, {.method = Method::hermite},
                                  execution_)[0];
    });
    take("cubic", [&] {
      sum_ +=
          interpolator.values(field, gradients, targets, {.method = Method::cubic}, execution_)[0];
    });
    take("linear_weights", [&] {
      sum_ += interpolator.weights(targets, {.method = Method::linear, .hashes = false}, execution_)
                  .values[0];
    });
    const rondel::Interpolator fresh(triangulation);
    take("gradient", [&] { sum_ += fresh.gradient({}, execution_).values[0]; });
  }

  void print() {
    std::printf(R"({"sites": %zu, "targets": %zu)", n_, num_targets_);
    for (Series& s : series_) {
      s.seconds.erase(s.seconds.begin());  // the first run has waited for memory
      const bool is_of_sites =
          std::string(s.name) == "prepare" || std::string(s.name) == "gradient";
      const auto count = static_cast<double>(is_of_sites ? n_ : num_targets_);
      std::printf(", \"%s\": %.1f", s.name, 1e9 * rondel::bench::median(s.seconds) / count);
    }
    std::printf(", \"sum\": %.6g}\n", sum_);
  }

 private:
  template <class Work>
  void take(const char* name, const Work& work) {
    if (next_ == series_.size()) series_.push_back({name, {}});
    series_[next_++].seconds.push_back(seconds_of(work));
  }

  std::size_t n_;
  std::size_t num_targets_;
  rondel::Execution execution_;
  std::vector<Series> series_;
  std::size_t next_ = 0;
  double sum_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: interpolate_bench N TARGETS [THREADS] [--seed S]\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  const std::size_t num_targets = std::strtoull(argv[2], nullptr, 10);
  const unsigned threads = argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1;
  rondel::bench::keep_freed_memory();
  Bench bench(n, num_targets, threads);
  for (int k = 0; k <= repetitions; ++k) bench.run(seed + static_cast<std::uint64_t>(k));
  bench.print();
}
