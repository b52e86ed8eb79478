// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// overlay_bench N M [THREADS] [--seed S] [--kind KIND] [--pair PAIR] [--order 1]: measures
// conservative weights from the Voronoi cells of N sites of the kind to other cells. Prints one
// JSON object: nanoseconds a cell for preparing the sets of cells from triangulations, and nanoseconds a
// piece and a cell for the overlay with its weights, of order 1 and 2, or only 1, since narrow
// cells have many pieces, and order 2 many more weights than pieces. Every repetition has its own
// sites, and medians are printed. PAIR says what the other cells are:
//
//   other       the cells of M other sites of the kind (default)
//   uniform     the cells of M uniform sites
//   hemisphere  the same, with all sites of both sides in the northern hemisphere
//   same        the same cells
//   turned      the cells of the same sites, turned by 1e-15 about the z axis
//   half        every second one of the same cells: polygons that touch in corners and along edges
//   grid        the cells between 501 parallels and 1001 meridians
//   grids       the same grid, overlaid with itself instead of cells of sites
//   checkers    the black fields of that grid with great circles as sides, overlaid with themselves: polygons
//               that touch in corners
//
// For the last repetition of order 1 it also prints the greatest difference of a row's sum from the
// covered share of its target, and the relative difference of the area of all pieces from that of
// the smaller set of cells.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/delaunay.h"
#include "rondel/remap.h"

namespace {

using rondel::CellSet;
using rondel::bench::seconds_of;

constexpr std::uint64_t repetitions = 3;

struct What {
  std::string kind;
  std::string pair;
  std::size_t n = 0;
  std::size_t m = 0;
  std::uint64_t seed = 0;
  bool is_first_alone = false;
};

struct Measured {
  std::vector<double> partition_seconds;
  std::vector<double> first_seconds;
  std::vector<double> second_seconds;
  rondel::Remap last;  // of order 1
  double sum_error = 0;
};

// Removes an option from the arguments and returns its value.
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

// Returns the cells for which is_in() is true.
template <class IsIn>
CellSet some_of(const CellSet& cells, const IsIn& is_in, const rondel::Execution& execution) {
  const rondel::CellRings all = cells.rings();
  rondel::CellRings some;
  some.points = all.points;
  for (std::size_t i = 0; i < all.num_cells(); ++i) {
    if (!is_in(i)) continue;
    for (std::uint64_t ring = all.cells[i]; ring < all.cells[i + 1]; ++ring) {
      const auto first = all.corners.begin();
      some.corners.insert(some.corners.end(), first + static_cast<std::ptrdiff_t>(all.rings[ring]),
                          first + static_cast<std::ptrdiff_t>(all.rings[ring + 1]));
      some.rings.push_back(some.corners.size());
    }
    some.cells.push_back(some.rings.size() - 1);
  }
  return CellSet::polygons(some, execution);
}

constexpr std::size_t grid_rows = 500;
constexpr std::size_t grid_columns = 1000;

CellSet make_grid(rondel::GridSides sides, const rondel::Execution& execution) {
  rondel::LonLatGrid grid;
  for (std::size_t i = 0; i <= grid_columns; ++i) {
    grid.lon_deg.push_back(360.0 * static_cast<double>(i) / grid_columns);
  }
  for (std::size_t i = 0; i <= grid_rows; ++i) {
    grid.lat_deg.push_back(180.0 * static_cast<double>(i) / grid_rows - 90);
  }
  return CellSet::lonlat_grid(grid, sides, execution);
}

// Sums exactly to rounding, so that losses can be seen.
double sum_of(std::span<const double> values) {
  double sum = 0;
  double rest = 0;
  for (const double value : values) {
    const double next = sum + value;
    rest += std::abs(sum) < std::abs(value) ? value - next + sum : sum - next + value;
    sum = next;
  }
  return sum + rest;
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

std::vector<rondel::Point> northern(std::vector<rondel::Point> sites) {
  for (rondel::Point& p : sites) p.z = std::abs(p.z);
  return sites;
}

std::vector<rondel::Point> sites_of_source(const What& what) {
  auto sites = rondel::bench::make_input(what.kind, what.n, what.seed);
  return what.pair == "hemisphere" ? northern(std::move(sites)) : sites;
}

std::vector<rondel::Point> sites_of_target(const What& what,
                                           const std::vector<rondel::Point>& sites) {
  if (what.pair == "other") return rondel::bench::make_input(what.kind, what.m, what.seed + 1);
  if (what.pair == "turned") return turned(sites);
  if (what.pair == "same" || what.pair == "half") return sites;
  auto others = rondel::bench::make_input("uniform", what.m, what.seed + 1);
  return what.pair == "hemisphere" ? northern(std::move(others)) : others;
}

// Returns source and target.
std::vector<CellSet> make_cell_sets(const What& what, const rondel::Execution& execution,
                                    double& seconds) {
  std::vector<CellSet> cell_sets;
  if (what.pair == "grids" || what.pair == "checkers") {
    const bool is_checkers = what.pair == "checkers";
    seconds = seconds_of([&] {
      cell_sets.push_back(
          make_grid(is_checkers ? rondel::GridSides::great_circles : rondel::GridSides::parallels,
                    execution));
      cell_sets.push_back(cell_sets[0]);
    });
    if (!is_checkers) return cell_sets;
    const auto is_black = [](std::size_t i) {
      return (i / grid_columns + i % grid_columns) % 2 == 0;
    };
    for (CellSet& cells : cell_sets) cells = some_of(cells, is_black, execution);
    return cell_sets;
  }
  const auto sites = sites_of_source(what);
  const auto source = rondel::delaunay(sites, {}, execution);
  const auto target = rondel::delaunay(sites_of_target(what, sites), {}, execution);
  seconds = seconds_of([&] {
    cell_sets.push_back(CellSet::voronoi(source, execution));
    cell_sets.push_back(what.pair == "grid" ? make_grid(rondel::GridSides::parallels, execution)
                                            : CellSet::voronoi(target, execution));
  });
  if (what.pair == "half") {
    cell_sets[0] = some_of(
        cell_sets[1], [](std::size_t i) { return i % 2 == 0; }, execution);
  }
  return cell_sets;
}

void repeat(std::uint64_t k, const What& what, const rondel::Execution& execution,
            Measured& measured) {
  double seconds = 0;
  const std::vector<CellSet> cell_sets = make_cell_sets(what, execution, seconds);
  const auto remap = [&](unsigned order) {
    return seconds_of([&] {
      measured.last = rondel::remap(cell_sets[0], cell_sets[1], {.order = order}, execution);
    });
  };
  const double second = what.is_first_alone ? 0 : remap(2);
  const double first = remap(1);
  const double smaller = std::min(sum_of(cell_sets[0].areas()), sum_of(cell_sets[1].areas()));
  measured.sum_error = std::abs(sum_of(measured.last.areas) - smaller) / smaller;
  if (k == 0) return;  // it has waited for memory
  measured.partition_seconds.push_back(seconds);
  measured.first_seconds.push_back(first);
  measured.second_seconds.push_back(second);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  const std::string kind = take_option(argc, argv, "--kind", "uniform");
  const std::string pair = take_option(argc, argv, "--pair", "other");
  const bool is_first_alone = take_option(argc, argv, "--order", "") == "1";
  constexpr std::array<std::string_view, 9> pairs = {
      "other", "uniform", "hemisphere", "same", "turned", "half", "grid", "grids", "checkers"};
  if (argc < 3 || std::ranges::find(pairs, pair) == pairs.end()) {
    std::fprintf(stderr,
                 "usage: overlay_bench N M [THREADS] [--seed S] [--kind KIND] "
                 "[--pair PAIR] [--order 1]\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  const std::size_t m = std::strtoull(argv[2], nullptr, 10);
  const rondel::Execution execution{.threads =
                                        argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1};
  rondel::bench::keep_freed_memory();
  Measured measured;
  for (std::uint64_t k = 0; k <= repetitions; ++k) {
    repeat(k, {kind, pair, n, m, seed + 2 * k, is_first_alone}, execution, measured);
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
       {"overlay_ns_a_cell",
        1e9 * rondel::bench::median(measured.first_seconds) / (sources + targets)},
       {"second_order_ns_a_piece", 1e9 * rondel::bench::median(measured.second_seconds) / pieces},
       {"row_error", row_error(result)},
       {"sum_error", measured.sum_error}});
  return 0;
}
