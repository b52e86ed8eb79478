// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// atlas_bench SOURCE TARGET [TURNS]: compares first-order conservative weights by Atlas and by
// Rondel, on one thread, in turns, between the cells of the meshes that Atlas makes of two of its
// grids ("O256", "F180", "N64"). Both have the meshes before the clock starts; Rondel's time is
// that of the overlay with its weights, and that of its two sets of cells is printed too. Prints one
// JSON object: medians of seconds, the number of weights, their largest difference, and the largest
// difference of row sums from 1.

#include <atlas/array.h>
#include <atlas/functionspace/CellColumns.h>
#include <atlas/grid.h>
#include <atlas/interpolation.h>
#include <atlas/interpolation/Cache.h>
#include <atlas/library.h>
#include <atlas/mesh.h>
#include <atlas/meshgenerator.h>
#include <atlas/option.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "measure.h"
#include "rondel/cell_set.h"
#include "rondel/read_cells.h"
#include "rondel/remap.h"

namespace {

// Atlas' cells as rings, where nodes at one place (poles, both sides of the date line) become one.
// Cells of a halo are repetitions of others, whole turns away.
struct AtlasCells {
  rondel::CellRings rings;
  std::vector<std::size_t> names;  // by cell of Atlas, including the halo: its cell in `rings`
};

AtlasCells cells_of(const atlas::Mesh& mesh) {
  const auto lonlat = atlas::array::make_view<double, 2>(mesh.nodes().lonlat());
  const auto halo = atlas::array::make_view<int, 1>(mesh.cells().halo());
  const auto& nodes = mesh.cells().node_connectivity();
  constexpr atlas::idx_t corners_per_cell = 4;
  std::vector<rondel::LonLat> corners;
  const auto place_of = [&](atlas::idx_t cell) {
    double lon = 0;
    double lat = 0;
    for (atlas::idx_t k = 0; k < nodes.cols(cell); ++k) {
      lon += lonlat(nodes(cell, k), 0) / nodes.cols(cell);
      lat += lonlat(nodes(cell, k), 1) / nodes.cols(cell);
    }
    constexpr double steps = 1e6;  // a degree
    const auto turn = std::llround(360 * steps);
    return std::pair((std::llround(lon * steps) % turn + turn) % turn, std::llround(lat * steps));
  };
  std::map<std::pair<long long, long long>, std::size_t> known;
  for (atlas::idx_t i = 0; i < mesh.cells().size(); ++i) {
    if (halo(i) > 0) continue;
    known.try_emplace(place_of(i), known.size());
    for (atlas::idx_t k = 0; k < corners_per_cell; ++k) {
      const atlas::idx_t node = nodes(i, std::min(k, nodes.cols(i) - 1));
      corners.push_back({lonlat(node, 0), lonlat(node, 1)});
    }
  }
  AtlasCells cells{rondel::cells_of_corners(corners, corners_per_cell), {}};
  for (atlas::idx_t i = 0; i < mesh.cells().size(); ++i)
    cells.names.push_back(known.at(place_of(i)));
  return cells;
}

// Returns the largest difference of two weights of one pair; a pair that one of them lacks has
// weight 0 there.
double difference(const rondel::Weights& ours, const atlas::interpolation::MatrixCache& theirs,
                  const std::vector<std::size_t>& source_of) {
  const auto& matrix = theirs.matrix();
  double most = 0;
  std::map<std::size_t, double> row;
  for (std::size_t i = 0; i < ours.num_rows(); ++i) {
    row.clear();
    for (auto k = ours.offsets[i]; k < ours.offsets[i + 1]; ++k)
      row[ours.columns[k]] = ours.values[k];
    for (auto k = matrix.outer()[i]; k < matrix.outer()[i + 1]; ++k) {
      row[source_of[static_cast<std::size_t>(matrix.inner()[k])]] -= matrix.data()[k];
    }
    for (const auto& [column, value] : row) most = std::max(most, std::abs(value));
  }
  return most;
}

// Returns the largest difference of a row's sum from 1.
double row_error(std::span<const double> values, const auto& offsets, std::size_t num_rows) {
  double most = 0;
  for (std::size_t i = 0; i < num_rows; ++i) {
    double sum = 0;
    for (auto k = offsets[i]; k < offsets[i + 1]; ++k) sum += values[static_cast<std::size_t>(k)];
    most = std::max(most, std::abs(sum - 1));
  }
  return most;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: atlas_bench SOURCE TARGET [TURNS]\n");
    return 2;
  }
  using rondel::bench::seconds_of;
  atlas::initialize(argc, argv);
  const int turns = argc > 3 ? std::atoi(argv[3]) : 3;
  const rondel::Execution one_thread{.threads = 1};
  const atlas::MeshGenerator generator("structured");
  const atlas::Mesh source = generator.generate(atlas::Grid(argv[1]));
  const atlas::Mesh target = generator.generate(atlas::Grid(argv[2]));
  const atlas::functionspace::CellColumns source_cells(source, atlas::option::halo(2));
  const atlas::functionspace::CellColumns target_cells(target);
  const atlas::option::type type("conservative-spherical-polygon");
  const AtlasCells sources = cells_of(source);
  const AtlasCells targets = cells_of(target);
  std::vector<double> atlas_seconds;
  std::vector<double> partition_seconds;
  std::vector<double> rondel_seconds;
  double most = 0;
  double of_rondel = 0;
  double of_atlas = 0;
  std::size_t num_weights = 0;
  for (int turn = 0; turn < turns; ++turn) {
    atlas::Interpolation interpolation;
    atlas_seconds.push_back(seconds_of([&] {
      interpolation = atlas::Interpolation(type | atlas::util::Config("order", 1) |
                                               atlas::util::Config("normalise_intersections", 0),
                                           source_cells, target_cells);
    }));
    std::vector<rondel::CellSet> cell_sets;
    partition_seconds.push_back(seconds_of([&] {
      cell_sets.push_back(rondel::CellSet::polygons(sources.rings, one_thread));
      cell_sets.push_back(rondel::CellSet::polygons(targets.rings, one_thread));
    }));
    rondel::Remap remap;
    rondel_seconds.push_back(
        seconds_of([&] { remap = rondel::remap(cell_sets[0], cell_sets[1], {}, one_thread); }));
    const atlas::interpolation::MatrixCache theirs(interpolation);
    const auto& matrix = theirs.matrix();
    most = difference(remap.weights, theirs, sources.names);
    of_rondel = row_error(remap.weights.values, remap.weights.offsets, remap.weights.num_rows());
    of_atlas = row_error({matrix.data(), matrix.nonZeros()}, matrix.outer(), matrix.rows());
    num_weights = remap.weights.values.size();
  }
  rondel::bench::print_json({{"sources", static_cast<double>(sources.rings.num_cells())},
                             {"targets", static_cast<double>(targets.rings.num_cells())},
                             {"weights", static_cast<double>(num_weights)},
                             {"atlas_seconds", rondel::bench::median(atlas_seconds)},
                             {"partition_seconds", rondel::bench::median(partition_seconds)},
                             {"rondel_seconds", rondel::bench::median(rondel_seconds)},
                             {"greatest_difference", most},
                             {"rondel_row_error", of_rondel},
                             {"atlas_row_error", of_atlas}});
  atlas::finalize();
  return 0;
}
