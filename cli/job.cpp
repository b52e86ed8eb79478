// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "job.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "progress_line.h"
#include "report.h"
#include "rondel/contours.h"
#include "rondel/delaunay.h"
#include "rondel/hull.h"
#include "rondel/read_cells.h"

namespace rondel::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// True if sites that were read as x, y, z look like longitudes, latitudes and heights: x and y are in
// the ranges of degrees, and the sites are neither near a sphere nor all around the center.
bool are_degrees_and_heights(const SiteTable& table) {
  if (table.is_lonlat() || table.sites.empty()) return false;
  constexpr double small = 10;  // clouds of points are often smaller than a map in degrees
  double largest = 0;
  double lowest = table.sites.front().z;
  double highest = lowest;
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  for (const Point& p : table.sites) {
    if (p.x < -180 || p.x > 360 || std::abs(p.y) > 90) return false;
    largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    lowest = std::min(lowest, p.z);
    highest = std::max(highest, p.z);
    shortest = std::min(shortest, std::hypot(p.x, p.y, p.z));
    longest = std::max(longest, std::hypot(p.x, p.y, p.z));
  }
  const bool is_near_sphere = longest <= 1.1 * shortest;
  const bool is_around_center = lowest < 0 && highest > 0 && std::max(-lowest, highest) <= 180;
  return largest > small && !is_near_sphere && !is_around_center;
}

// Tells that columns x, y and z look like longitude, latitude and height, and how to say so, unless
// options name them or the center of the sphere.
void tell_of_heights(const SiteTable& table, const FileName& file, const ReadOptions& read,
                     const Sphere& sphere) {
  if (!read.x.empty() || sphere.center != Point{} || !are_degrees_and_heights(table)) return;
  const std::string format = format_of(file);
  const bool has_names = format == "csv" || format == "tsv" || (format.empty() && file.path == "-");
  const std::string way_out =
      has_names ? "--lon x --lat y takes degrees" : ".csv with the columns lon and lat has degrees";
  tell(table.name, {"x, y and z look like longitude, latitude and height, but are taken as places "
                    "in space; " +
                    way_out});
}

}  // namespace

// A job remembers this between its stages.
struct Job::State {
  explicit State(const CommonOptions& common) : options(common), line(common.quiet) {}

  CommonOptions options;
  ProgressLine line;
  FilesTogether files;  // what the command writes
  // Returns the sum of the seconds of a stage.
  double& clock(Stage stage) {
    switch (stage) {
      case Stage::read:
        return seconds.read;
      case Stage::dual:
        return seconds.dual;
      case Stage::locator:
        return seconds.locator;
      case Stage::query:
        return seconds.query;
      case Stage::write:
        break;
    }
    return seconds.write;
  }

  Seconds seconds{};
  std::uint64_t num_unlocated = 0;  // number of features read without a geometry
  std::optional<std::size_t> num_without_value;
  // What is told with the report: a file and a remark on it.
  std::vector<std::pair<std::string, std::string>> remarks;
  Clock::time_point start = Clock::now();
};

Job::Job(const CommonOptions& options) : state_(std::make_unique<State>(options)) {}
Job::~Job() = default;

SiteTable Job::read() {
  SiteTable table = read(state_->options.source(), state_->options.read);
  const SiteTable* const tables[] = {&table};
  require_angles(state_->options.read, tables);
  return table;
}

SiteTable Job::read(const FileName& file, const ReadOptions& read,
                    std::span<const std::string> names) {
  NetcdfSites grid = read_grid(file, read, names);
  if (grid.mask.empty()) return std::move(grid.table);
  const std::vector<bool> is_kept = grid.unmasked();
  const auto num_masked = static_cast<std::size_t>(std::ranges::count(is_kept, false));
  if (num_masked == 0) return std::move(grid.table);
  tell(grid.table.name, {"left out " + count(num_masked, "masked site", "masked sites")});
  return grid.table.selection(is_kept);
}

void tell_of_columns(const std::string& netcdf, const ReadOptions& read) {
  if (read.lon.empty() && read.x.empty()) return;
  tell(netcdf, {"names of columns are for tables; " + netcdf +
                ":NAME chooses one of several coordinates of netCDF"});
}

NetcdfSites Job::read_on_mesh(const FileName& file, const FileName& mesh, const ReadOptions& read,
                              std::span<const std::string> names) {
  if (mesh.path.empty()) return read_grid(file, read, names);
  const auto part = file_and_variable(file);
  if (!part.second.empty()) names = {&part.second, 1};
  NetcdfSites sites;
  time(Stage::read,
       [&] { sites = read_sites_on_mesh(part.first, mesh, names, read.keep_columns); });
  // Where a column is missing, the error that follows says why.
  if (!read.keep_columns || !sites.table.columns.empty()) {
    tell(file_and_variable(mesh).first.path, sites.remarks);
  }
  return sites;
}

NetcdfSites Job::read_grid(const FileName& file, const ReadOptions& read,
                           std::span<const std::string> names) {
  const Clock::time_point start = Clock::now();
  const auto part = file_and_variable(file);
  const bool is_netcdf = is_netcdf_file(part.first);
  const std::span<const std::string> columns = part.second.empty() ? names : decltype(names)();
  if (!part.second.empty()) names = {&part.second, 1};
  NetcdfSites sites;
  if (is_netcdf) {
    sites = read_netcdf_sites(part.first, names, read.keep_columns);
    // Where a command needs such a column, the error that follows says so.
    std::erase_if(sites.remarks, [&](const std::string& remark) {
      return std::ranges::any_of(columns, [&](const std::string& name) {
        return remark.starts_with('"' + name + "\" has several fields");
      });
    });
    tell(part.first.path, sites.remarks);
    tell_of_columns(part.first.path, read);
  } else {
    sites.table = read_sites(file, read, execution());
    tell_of_heights(sites.table, file, read, sphere());
  }
  const SiteTable& table = sites.table;
  state_->seconds.read += seconds_since(start);
  state_->num_unlocated += table.num_unlocated;
  if (table.sites.empty()) remark(table.name, no_points);
  if (table.num_unlocated > 0 && !state_->options.quiet) {
    state_->line.clear();
    const bool is_table = !is_geojson(file);
    std::fprintf(
        stderr, "rondel: %s: left out %s without a place; sites are numbered without %s\n",
        table.name.c_str(),
        count(table.num_unlocated, is_table ? "row" : "feature", is_table ? "rows" : "features")
            .c_str(),
        table.num_unlocated > 1 ? "them" : "it");
  }
  return sites;
}

std::vector<LonLat> lonlats_of(const SiteTable& table, const Point& center) {
  if (table.is_lonlat()) return table.positions;
  std::vector<Point> seen = table.sites;
  for (Point& point : seen) {
    point = {point.x - center.x, point.y - center.y, point.z - center.z};
  }
  return lonlats(seen);
}

void move_to(const Point& center, SiteTable& table) {
  if (!table.is_lonlat() || center == Point{}) return;
  for (Point& point : table.sites) {
    point = {point.x + center.x, point.y + center.y, point.z + center.z};
  }
  table.positions.clear();
}

// The triangulation has a view of the table's sites, not a copy.
Triangulation Job::triangulate(const SiteTable& table) {
  if (table.is_lonlat() && sphere().center != Point{}) {
    throw FileError(table.name +
                    ": --center is for sites that are x, y, z: longitudes and latitudes are seen "
                    "from the center of the sphere already");
  }
  return with_places(table, [&] {
    return delaunay(Sites::view(table.sites), state_->options.build, execution());
  });
}

Triangulation Job::hull(const SiteTable& table) {
  return with_places(table, [&] { return convex_hull(Sites::view(table.sites), execution()); });
}

std::vector<double> Job::shown_values(const Triangulation& triangulation,
                                      const std::vector<double>& values, const std::string& name,
                                      const std::string& consequence) {
  std::vector<double> shown = first_values(triangulation, values);
  std::size_t num_other = 0;
  // Duplicates show what their representative shows; other values of theirs are counted.
  for (const auto& [site, representative] : triangulation.duplicates()) {
    const bool is_shown = std::isnan(values[site]) || values[site] == shown[representative];
    if (!is_shown) ++num_other;
    shown[site] = shown[representative];
  }
  std::size_t num_without = 0;
  const std::vector<bool> is_vertex = are_vertices(triangulation);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (is_vertex[i] && std::isnan(shown[i])) ++num_without;
  }
  state_->num_without_value = num_without;
  const std::string input = state_->options.input == "-" ? "<stdin>" : state_->options.input;
  const std::string of_all = " of " + count(triangulation.num_sites(), "site", "sites");
  if (num_without > 0) {
    remark(input, std::to_string(num_without) + of_all + (num_without == 1 ? " has" : " have") +
                      " no value of '" + name + "': " + consequence);
  }
  if (num_other > 0) {
    remark(input, std::to_string(num_other) + of_all + (num_other == 1 ? " is" : " are") +
                      " at the place of another one with another value of '" + name +
                      "': of each place the first value counts");
  }
  return shown;
}

std::vector<bool> are_vertices(const Triangulation& triangulation) {
  std::vector<bool> is_vertex(triangulation.num_sites(), true);
  for (const Duplicate& duplicate : triangulation.duplicates()) is_vertex[duplicate.site] = false;
  for (const Hidden& hidden : triangulation.hidden()) is_vertex[hidden.site] = false;
  return is_vertex;
}

void Job::remark(const std::string& file, const std::string& text) {
  state_->remarks.emplace_back(file, text);
}

void Job::time(Stage stage, const std::function<void()>& work) {
  const Clock::time_point start = Clock::now();
  work();
  state_->clock(stage) += seconds_since(start);
}

Execution Job::execution() const {
  return {.threads = state_->options.threads, .progress = state_->line.callback()};
}

const Sphere& Job::sphere() const { return state_->options.build.sphere; }

Seconds Job::seconds() const {
  Seconds seconds = state_->seconds;
  seconds.total = seconds_since(state_->start);
  return seconds;
}

void Job::report(const Triangulation& triangulation, const std::string& what) {
  const CommonOptions& options = state_->options;
  report(options.json ? json_report(triangulation, seconds(), state_->num_unlocated,
                                    state_->num_without_value)
                      : std::string(),
         summary(triangulation, seconds(), what, options.output));
}

void Job::report(const std::string& json, const std::string& summary) {
  state_->line.clear();
  state_->files.commit();
  for (const auto& [file, text] : state_->remarks) tell(file, {text});
  if (state_->options.output == "-") return;
  if (state_->options.json) {
    print(json);
  } else if (!state_->options.quiet) {
    print(summary);
  }
}

// A full disk or a closed pipe shows only when the buffer is flushed.
void print(const std::string& text) {
  errno = 0;
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (is_written && std::fflush(stdout) == 0) return;
  throw FileError("<stdout>: " + std::string(std::strerror(errno)));
}

}  // namespace rondel::cli
