// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "rondel/diagram.h"
#include "run.h"

namespace rondel::cli {
namespace {

// Returns the numbers in rows of `width` numbers, as a flat array.
template <std::size_t width, class Number, class Row>
std::span<const Number> numbers_of(std::span<const Row> rows) {
  static_assert(sizeof(Row) == width * sizeof(Number) && std::is_standard_layout_v<Row>);
  return {reinterpret_cast<const Number*>(rows.data()), width * rows.size()};
}

template <std::size_t width, class Row>
void write_rows(const std::string& path, std::span<const Row> rows) {
  const std::array<std::uint64_t, 2> shape = {rows.size(), width};
  write_indices(path, numbers_of<width, Index>(rows), shape);
}

void write_points(const std::string& path, std::span<const Point> points) {
  const std::array<std::uint64_t, 2> shape = {points.size(), 3};
  write_numbers(path, numbers_of<3, double>(points), shape);
}

// Throws UsageError for formats of several files, and says what is written instead.
void require_one_file(const CommonOptions& common) {
  const std::string output = "--output: '" + common.output + "': ";
  if (common.format() == "zarr") {
    throw UsageError(output +
                     "Zarr groups are written in Python, by rondel.delaunay(points).to_zarr(path); "
                     "by rondel.out_of_core.delaunay(sites, path, scratch=directory) where sites "
                     "do not fit into memory");
  }
  if (common.format() == "pvtp")
    throw UsageError(output + ".pvtp is not written; .vtp has all triangles in one file");
}

}  // namespace

ExitStatus run_delaunay(const DelaunayOptions& options) {
  require_one_file(options.common);
  if (!options.scratch.empty()) return run_out_of_core(options);
  const CommonOptions& common = options.common;
  require_output(common, can_write_triangles(common.target()),
                 ".npy .off .ply .obj .stl .vtp .geojson");
  require_array("--neighbors", options.neighbors);
  require_array("--areas", options.areas);
  require_array("--circumcenters", options.circumcenters);
  require_array("--duplicates", options.duplicates);
  require_separate_files({{"INPUT", common.input}}, {{"--output", common.output},
                                                     {"--neighbors", options.neighbors},
                                                     {"--areas", options.areas},
                                                     {"--duplicates", options.duplicates},
                                                     {"--circumcenters", options.circumcenters}});
  Job job(common);
  const SiteTable table = job.read();
  const Triangulation triangulation = job.triangulate(table);
  std::vector<double> cell_areas;
  std::vector<Point> centers;
  if (!options.areas.empty())
    job.time(Stage::dual, [&] { cell_areas = areas(triangulation, job.execution()); });
  if (!options.circumcenters.empty())
    job.time(Stage::dual, [&] { centers = circumcenters(triangulation, job.execution()); });
  job.time(Stage::write, [&] {
    if (!options.neighbors.empty()) write_rows<3>(options.neighbors, triangulation.neighbors());
    if (!options.areas.empty()) write_numbers(options.areas, cell_areas);
    if (!options.circumcenters.empty()) write_points(options.circumcenters, centers);
    if (!options.duplicates.empty()) write_rows<2>(options.duplicates, triangulation.duplicates());
    write_triangles(common.target(), table, triangulation, job.execution());
  });
  job.report(triangulation, "the triangulation");
  return done;
}

}  // namespace rondel::cli
