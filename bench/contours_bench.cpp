// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// contours_bench N [THREADS] [--seed S]: measures isolines and bands at 10 levels of a smooth and
// of a rough field at uniform sites, in nanoseconds a face; prints one JSON object.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/contours.h"
#include "rondel/rondel.h"

namespace {

constexpr std::array<double, 10> levels = {-0.9, -0.7, -0.5, -0.3, -0.1, 0.1, 0.3, 0.5, 0.7, 0.9};

struct Field {
  rondel::Triangulation triangulation;
  std::vector<double> values;
};

// Makes polynomials of degree 6; for the rough field, adds a random step of up to the distance of
// levels at each site.
Field make_field(std::size_t n, std::uint64_t seed, bool is_rough) {
  const auto sites = rondel::bench::make_input("uniform", n, seed);
  Field field{rondel::delaunay(sites), {}};
  for (std::size_t i = 0; i < n; ++i) {
    const rondel::Point& p = field.triangulation.sites()[i];
    const double wave = 16 * p.x * p.y * p.z * (p.x * p.x - p.y * p.y) + 0.4 * p.z;
    const double step = static_cast<double>(i * 2'654'435'761U % 1000) / 1000;
    field.values.push_back(is_rough ? 2 * step - 1 : wave);
  }
  return field;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 2) {
    std::fprintf(stderr, "usage: contours_bench N [THREADS] [--seed S]\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  const unsigned threads = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const rondel::Execution execution{.threads = threads};
  std::size_t num_points = 0;
  const auto lines_of = [&](bool is_rough) {
    return rondel::bench::measure([&] { return make_field(n, seed++, is_rough); },
                                  [&](const Field& field) {
                                    return rondel::isolines(field.triangulation, field.values,
                                                            levels, execution);
                                  });
  };
  const auto bands_of = [&](bool is_rough) {
    return rondel::bench::measure([&] { return make_field(n, seed++, is_rough); },
                                  [&](const Field& field) {
                                    return rondel::bands(field.triangulation, field.values, levels,
                                                         execution);
                                  });
  };
  const auto smooth_lines = lines_of(false);
  num_points = smooth_lines.result->lines.rows.values.size();
  const auto smooth_bands = bands_of(false);
  const auto rough_lines = lines_of(true);
  const auto rough_bands = bands_of(true);
  const double faces = 2 * static_cast<double>(n) - 4;
  const auto rough_points = static_cast<double>(rough_lines.result->lines.rows.values.size());
  rondel::bench::print_json(
      {{"sites", static_cast<double>(n)},
       {"threads", static_cast<double>(threads)},
       {"points", static_cast<double>(num_points)},
       {"isolines_ns_a_face", smooth_lines.seconds / faces * 1e9},
       {"bands_ns_a_face", smooth_bands.seconds / faces * 1e9},
       {"rough_points", rough_points},
       {"rough_isolines_ns_a_point", rough_lines.seconds / rough_points * 1e9},
       {"rough_bands_ns_a_point", rough_bands.seconds / rough_points * 1e9}});
}
