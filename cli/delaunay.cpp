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

// True if an array goes into the group that OUTPUT is. Throws UsageError if it is neither that nor
// a .npy file.
bool is_in_group(const char* option, const std::string& path, const CommonOptions& common) {
  const auto without_slashes = [](std::string name) {
    while (name.ends_with('/')) name.pop_back();
    return name;
  };
  const bool is_output = without_slashes(path) == without_slashes(common.output);
  if (common.format() == "zarr" && is_output) return true;
  require_array(option, path);
  CommonOptions array;
  array.output = path;
  if (array.format() != "zarr") return false;
  throw UsageError(std::string(option) + ": '" + path +
                   "' is a Zarr group; it must be that of --output, or a .npy file");
}

}  // namespace

ExitStatus run_delaunay(const DelaunayOptions& options) {
  if (!options.scratch.empty()) return run_out_of_core(options);
  const CommonOptions& common = options.common;
  if ((common.format() == "zarr" || common.format() == "pvtp") && common.output == "-")
    throw UsageError("--output: ." + common.format() +
                     " is written into a folder, which standard output is not");
  const std::string of_one_file = ".npy .off .ply .obj .stl .vtp .geojson";
  require_output(common, can_write_triangles(common.target()),
                 of_one_file + (common.output == "-" ? "" : " .pvtp .zarr"));
  const ZarrContent content = {is_in_group("--neighbors", options.neighbors, common),
                               is_in_group("--areas", options.areas, common),
                               is_in_group("--duplicates", options.duplicates, common)};
  if (is_in_group("--circumcenters", options.circumcenters, common))
    throw UsageError("--circumcenters: a Zarr group has none; they need a .npy file");
  const auto unless_in_group = [](bool is_in, const std::string& path) {
    return is_in ? std::string() : path;
  };
  require_separate_files({{"INPUT", common.input}},
                         {{"--output", common.output},
                          {"--neighbors", unless_in_group(content.neighbors, options.neighbors)},
                          {"--areas", unless_in_group(content.areas, options.areas)},
                          {"--duplicates", unless_in_group(content.duplicates, options.duplicates)},
                          {"--circumcenters", options.circumcenters}});
  Job job(common);
  const SiteTable table = job.read();
  const Triangulation triangulation = job.triangulate(table);
  std::vector<double> cell_areas;
  std::vector<Point> centers;
  if (!options.areas.empty() && !content.areas)
    job.time(Stage::dual, [&] { cell_areas = areas(triangulation, job.execution()); });
  if (!options.circumcenters.empty())
    job.time(Stage::dual, [&] { centers = circumcenters(triangulation, job.execution()); });
  job.time(Stage::write, [&] {
    if (!options.neighbors.empty() && !content.neighbors)
      write_rows<3>(options.neighbors, triangulation.neighbors());
    if (!options.areas.empty() && !content.areas) write_numbers(options.areas, cell_areas);
    if (!options.circumcenters.empty()) write_points(options.circumcenters, centers);
    if (!options.duplicates.empty() && !content.duplicates)
      write_rows<2>(options.duplicates, triangulation.duplicates());
    if (common.format() == "zarr") {
      write_zarr(common.output, table, triangulation, content, job.execution());
    } else {
      write_triangles(common.target(), table, triangulation, job.execution());
    }
  });
  job.report(triangulation, "the triangulation");
  return done;
}

}  // namespace rondel::cli
