// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh_spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <utility>

#include "command.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/mesh_lines.h"
#include "rondel/mesh_size_files.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The spacing grows by 5 % of the distance from a refined place, unless --gradient says otherwise.
constexpr double usual_slope = 0.05;

// The fewest cells that mesh::scvt() makes.
constexpr std::size_t fewest_cells = 12;

// Half of the circumference, which is the largest distance of two places.
constexpr double max_kilometers = std::numbers::pi * kilometers_per_radian;

// Returns the number of kilometers, or nothing if the text is the name of a file.
std::optional<double> as_kilometers(const std::string& option, const std::string& text) {
  if (text.empty() || is_file_of_spacings(text)) return std::nullopt;
  const double kilometers = std::strtod(text.c_str(), nullptr);
  if (kilometers > 0 && kilometers < max_kilometers) return kilometers;
  throw UsageError(option + ": '" + text + "' is not a positive number of kilometers below 20015");
}

// Throws if the spacings need more or fewer cells than a mesh can have; without -n they alone
// determine the number of cells.
void require_possible_count(const std::string& what, const mesh::SizeFunction& size) {
  const double cells = size.count();
  const bool are_few = cells + 0.5 < static_cast<double>(fewest_cells);
  if (!are_few && cells < static_cast<double>(max_sites) + 1) return;
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(),
                ": spacings of %.3g to %.3g kilometers are those of %.2g cells, %s than %zu: are "
                "they kilometers?",
                size.smallest() * kilometers_per_radian, size.largest() * kilometers_per_radian,
                cells, are_few ? "fewer" : "more", are_few ? fewest_cells : max_sites);
  throw FileError(what + text.data());
}

// The most steps of a raster of the sphere, of up to 7 km.
constexpr std::size_t most_sphere_steps = 2048;

std::size_t most_steps_of(const mesh::SizeRaster& raster) {
  return raster.region ? raster.most_steps() : most_sphere_steps;
}

// Returns the length of the longest step of the finest raster, in radians.
double least_step_of(mesh::SizeRaster raster) {
  raster.steps = most_steps_of(raster);
  return raster.longest_step();
}

// Chooses the raster such that at the center of the region, or in the middle of a face of the cube, a
// step is half of the smallest spacing that options give. On the sphere spacings of a file have at
// least the usual raster; on a region read_spacings() finds the steps that they need.
mesh::SizeRaster raster_of(const ScvtFiles& options,
                           const std::optional<mesh::SizeRegion>& region) {
  const bool is_file = is_file_of_spacings(options.spacing);
  double least = is_file ? max_kilometers : std::strtod(options.spacing.c_str(), nullptr);
  for (const std::string& refinement : options.refine) {
    const double near = std::strtod(split_at_colon(refinement).second.c_str(), nullptr);
    if (near > 0) least = std::min(least, near);  // other texts are refused where they are used
  }
  if (region) return mesh::SizeRaster::with_step(*region, least / (2 * kilometers_per_radian));
  std::size_t steps = is_file ? mesh::SizeFunction::usual_steps : 64;
  while (steps < most_sphere_steps &&
         static_cast<double>(steps) * least < 4 * kilometers_per_radian) {
    steps *= 2;
  }
  return steps;
}

// Tells of places of --refine whose spacing even the finest raster is too coarse for.
void tell_of_raster(const std::string& file, const std::vector<Point>& places, double near,
                    const mesh::SizeFunction& size) {
  const mesh::SizeRaster raster = size.raster();
  const double step = raster.longest_step();
  if (near >= 2 * step) return;  // as in raster_of()
  double largest = 0;
  for (const Point& place : places) {
    if (raster.region && !raster.region->contains(place)) continue;
    largest = std::max(largest, size.spacing(place));
  }
  if (largest <= 1.2 * near) return;
  const double step_km = step * kilometers_per_radian;
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(),
                "--refine: the spacing there is up to %.3g kilometers, since spacings are kept on "
                "a raster with steps of up to %.3g km",
                largest * kilometers_per_radian, raster.region ? step_km : std::ceil(step_km));
  tell(file, {text.data()});
}

// Returns spacings for the number of cells that the mesh will have.
mesh::SizeFunction size_along(const mesh::ScvtOptions& scvt, std::size_t num_start) {
  const std::size_t n = num_start > 0 ? num_start : scvt.count;
  if (!scvt.size) return mesh::SizeFunction::of_count(n);
  return n == 0 ? *scvt.size : scvt.size->for_count(n);
}

// The lines that mesh::read_lines() or mesh::read_places() has found in files.
struct LinesOfFiles {
  std::vector<std::vector<Point>> lines;
  std::vector<std::string> files;
  std::vector<std::size_t> ends;  // by file: the end of its lines

  // Returns where a line comes from: "points.csv:5", or "lines.geojson: line 5" where lines are no
  // points of a table. The table is read again for that.
  [[nodiscard]] std::string where(std::size_t line) const {
    const auto end = std::ranges::upper_bound(ends, line);
    const std::string& file = files[static_cast<std::size_t>(end - ends.begin())];
    const std::size_t begin = end == ends.begin() ? 0 : *std::prev(end);
    try {
      const SiteTable table = read_sites({file, {}}, {});
      if (table.sites.size() == *end - begin) return table.where(line - begin);
    } catch (const FileError&) {
      // The table has gone since; what is counted of it still says where.
    }
    return file + ": line " + std::to_string(line - begin);
  }
};

// Throws if two points of --fixed are in one place; places on lines and beside them are apart.
void require_apart(const std::vector<Point>& sites, const LinesOfFiles& from,
                   const Execution& execution) {
  if (sites.size() < 2) return;
  const Triangulation triangulation =
      delaunay(Sites::view(sites), {}, Execution{.threads = execution.threads});
  if (triangulation.duplicates().empty()) return;
  const auto [second, first] = triangulation.duplicates().front();
  const bool are_points = std::ranges::all_of(
      from.lines, [](const std::vector<Point>& line) { return line.size() == 1; });
  // Lines have more sites than one, so that the number of a site is not that of its line.
  throw FileError(are_points
                      ? from.where(second) + ": the place of " + from.where(first) +
                            ", which cannot be two sites"
                      : (from.files.size() == 1 ? from.files.front() : "--fixed") + ": places " +
                            std::to_string(first) + " and " + std::to_string(second) +
                            " are one place, which cannot be two sites");
}

}  // namespace

std::vector<NamedFile> files_read(const ScvtFiles& options) {
  std::vector<NamedFile> files = {
      {"--spacing", options.spacing}, {"--density", options.density}, {"--start", options.start}};
  for (const auto& [option, paths] :
       {std::pair("--refine", &options.refine), std::pair("--fixed", &options.fixed),
        std::pair("--along", &options.along)}) {
    for (const std::string& path : *paths) files.push_back({option, path});
  }
  return files;
}

bool is_file_of_spacings(const std::string& spacing) {
  char* end = nullptr;
  std::strtod(spacing.c_str(), &end);
  return !spacing.empty() && *end != '\0';
}

std::optional<mesh::SizeFunction> spacings_of(const ScvtFiles& options, const Execution& execution,
                                              const std::optional<mesh::SizeRegion>& region,
                                              std::span<const Point> corners) {
  if (!options.density.empty()) {
    const auto [file, name] = split_at_colon(options.density);
    std::vector<std::string> remarks;
    mesh::SizeFunction density =
        mesh::read_density({file, {}}, name, mesh::SizeFunction::usual_steps, execution, &remarks,
                           {.most_steps = most_sphere_steps});
    tell(file, remarks);
    return density;
  }
  if (options.spacing.empty()) return std::nullopt;
  std::optional<mesh::SizeFunction> size;
  const auto constant = as_kilometers("--spacing", options.spacing);
  const mesh::SizeRaster raster = raster_of(options, region);
  if (constant) {
    size = mesh::SizeFunction::constant(*constant / kilometers_per_radian, raster);
  } else {
    const auto [file, name] = split_at_colon(options.spacing);
    std::vector<std::string> remarks;
    size = mesh::read_spacings({file, {}}, name, 1 / kilometers_per_radian, raster, execution,
                               &remarks, {.most_steps = most_steps_of(raster), .corners = corners});
    tell(file, remarks);
  }
  for (const std::string& refinement : options.refine) {
    const auto [file, text] = split_at_colon(refinement);
    const auto kilometers = as_kilometers("--refine", text);
    if (!kilometers) throw UsageError("--refine: '" + refinement + "' is not FILE:KM");
    const double near = *kilometers / kilometers_per_radian;
    // Points that are much closer than the steps of the raster change nothing.
    const double distance = std::max(0.5 * near, 0.05 * least_step_of(raster));
    const std::vector<Point> places =
        mesh::read_refinement({file, {}}, distance, options.polygons, execution, region);
    if (std::ranges::none_of(places, [&](const Point& p) { return size->spacing(p) > near; })) {
      tell(file, {"--refine: the spacing there is " + text +
                  " kilometers or less without it, which it does not change"});
    }
    size = size->refined(places, near, options.slope.value_or(usual_slope), execution);
    tell_of_raster(file, places, near, *size);
  }
  if (options.slope || !options.refine.empty()) {
    size = size->limited(options.slope.value_or(usual_slope));
  }
  return size;
}

std::optional<mesh::SizeFunction> size_of(const ScvtFiles& options, std::size_t count,
                                          const Execution& execution) {
  std::optional<mesh::SizeFunction> size = spacings_of(options, execution);
  if (count == 0 && options.start.empty() && options.density.empty() && size) {
    require_possible_count(
        (is_file_of_spacings(options.spacing) ? "" : "--spacing ") + options.spacing, *size);
  }
  return size;
}

FixedSites fixed_sites(const ScvtFiles& options, const mesh::ScvtOptions& scvt,
                       std::size_t num_start, const Execution& execution) {
  FixedSites fixed;
  if (options.fixed.empty() && options.along.empty()) return fixed;
  const mesh::SizeFunction size = size_along(scvt, num_start);
  const auto add = [&](const std::vector<std::string>& files, auto read, auto sites_of) {
    // The library takes the lines of all files at once, so that sites of one file keep their
    // distance from those of another.
    LinesOfFiles from{{}, files, {}};
    for (const std::string& file : files) {
      std::vector<std::vector<Point>> more = read({file, {}}, options.polygons, execution);
      std::ranges::move(more, std::back_inserter(from.lines));
      from.ends.push_back(from.lines.size());
    }
    try {
      const mesh::LineSites found = sites_of(from.lines, size, execution);
      fixed.sites.insert(fixed.sites.end(), found.sites.begin(), found.sites.end());
      fixed.num_left_out += found.num_left_out;
    } catch (const InvalidInput& error) {
      if (error.index() >= from.lines.size()) throw;
      std::string what = error.what();
      // "a point of line 3 is ..." and "neighbors in line 3 are ..." without the number, which is
      // that of a line of all files.
      const std::string number = "line " + std::to_string(error.index()) + ' ';
      if (const std::size_t at = what.find(number); at != std::string::npos) {
        what.erase(at - 3, number.size() + 3);
      }
      throw FileError(from.where(error.index()) + ": " + what);
    }
    return from;
  };
  const LinesOfFiles from = add(options.fixed, mesh::read_places, mesh::sites_on);
  if (!options.fixed.empty()) require_apart(fixed.sites, from, execution);
  add(options.along, mesh::read_lines, mesh::sites_along);
  return fixed;
}

}  // namespace rondel::cli
