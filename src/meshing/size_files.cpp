// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "meshing/line_files.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/interpolate.h"
#include "rondel/mesh_files.h"
#include "rondel/mesh_size_files.h"

namespace rondel::mesh {
namespace {

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() && text.substr(text.size() - ending.size()) == ending;
}

bool is_geojson(const FileName& file) {
  if (!file.format.empty()) return file.format == "geojson" || file.format == "json";
  return ends_with(file.path, ".geojson") || ends_with(file.path, ".json");
}

struct Spacings {
  std::vector<Point> places;
  std::vector<double> values;
  std::vector<std::size_t> numbers;  // in the file
};

// Far more than any mesh's; roots of quotients are numbers.
constexpr double least_density = 1e-100;
constexpr double largest_density = 1e100;

// Its values are those of cells, whose places no attribute names.
bool is_mpas(const FileName& file) {
  io::FileBytes bytes(file.path, true);
  return io::in_file(bytes.name(), [&] {
    const io::NetcdfReader reader(bytes);
    return reader.find("cellsOnEdge") != nullptr && reader.find("verticesOnCell") != nullptr;
  });
}

Spacings spacings_of(const FileName& file, const std::string& name, const Execution& execution) {
  Spacings result;
  std::vector<std::string> names;
  if (!name.empty()) names.push_back(name);
  const bool is_netcdf =
      file.format == "nc" || (file.format.empty() && ends_with(file.path, ".nc"));
  if (!is_netcdf) {
    SiteTable table = read_sites(file, {}, execution);
    if (names.empty()) throw FileError(table.name + ": which column is meant is not said");
    result.places = std::move(table.sites);
  }
  const bool is_mesh = is_netcdf && is_mpas(file);
  if (is_mesh) result.places = unit_vectors(read_cells(file).centers);
  FieldSet fields = read_fields(file, names, result.places.size());
  if (is_netcdf && !is_mesh) result.places = std::move(fields.points);
  if (fields.arrays.size() != 1 || fields.arrays.front().num_fields() != 1) {
    throw FileError(file.path + ": it has not one field of numbers" +
                    (name.empty() ? ": name it" : ""));
  }
  if (result.places.size() != fields.num_points) {
    throw FileError(file.path + ": its values have no longitudes and latitudes");
  }
  result.values = std::move(fields.arrays.front().values);
  return result;
}

// With the numbers of the places that are left.
void drop_missing(const FileName& file, Spacings& spacings) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < spacings.values.size(); ++i) {
    if (std::isnan(spacings.values[i])) continue;
    spacings.places[kept] = spacings.places[i];
    spacings.values[kept++] = spacings.values[i];
    spacings.numbers.push_back(i);
  }
  if (kept == 0) throw FileError(file.path + ": all of its values are missing");
  spacings.places.resize(kept);
  spacings.values.resize(kept);
}

// Linear on the triangulation of the places.
SizeFunction function_of(const Spacings& spacings, std::size_t steps, const Execution& execution) {
  const Interpolator interpolator(delaunay(Sites::view(spacings.places), {}, execution));
  const InterpolationOptions options{.method = Method::linear, .outside = Outside::nearest};
  return SizeFunction::from_function(
      [&](std::span<const Point> places, std::span<double> out) {
        const std::vector<double> values =
            interpolator.values(spacings.values, places, options, execution);
        std::ranges::copy(values, out.begin());
      },
      steps);
}

}  // namespace

std::vector<Point> read_refinement(const FileName& file, double distance,
                                   const Execution& execution) {
  if (!is_geojson(file)) {
    std::vector<Point> points = read_sites(file, {}, execution).sites;
    if (points.empty()) throw FileError(file.path + ": it has no points");
    return points;
  }
  std::vector<Point> points;
  for (const std::vector<LonLat>& line : meshing::lines_of(file)) {
    const std::vector<Point> dense = densified(unit_vectors(line), distance);
    points.insert(points.end(), dense.begin(), dense.end());
  }
  if (points.empty()) throw FileError(file.path + ": it has no points");
  return points;
}

SizeFunction read_spacings(const FileName& file, const std::string& name, double unit,
                           std::size_t steps, const Execution& execution) {
  Spacings spacings = spacings_of(file, name, execution);
  drop_missing(file, spacings);
  for (std::size_t i = 0; i < spacings.values.size(); ++i) {
    double& value = spacings.values[i];
    if (!(value * unit > 0 && value * unit < 3)) {
      throw FileError(file.path + ": spacing " + std::to_string(value) + " at place " +
                      std::to_string(spacings.numbers[i]) + " is not positive, or too large");
    }
    value *= unit;
  }
  return function_of(spacings, steps, execution);
}

SizeFunction read_density(const FileName& file, const std::string& name, std::size_t steps,
                          const Execution& execution) {
  Spacings densities = spacings_of(file, name, execution);
  drop_missing(file, densities);
  for (std::size_t i = 0; i < densities.values.size(); ++i) {
    const double value = densities.values[i];
    if (value >= least_density && value <= largest_density) continue;
    throw FileError(file.path + ": density " + std::to_string(value) + " at place " +
                    std::to_string(densities.numbers[i]) +
                    " is not positive, or of no size that a mesh can have");
  }
  const double least = *std::ranges::min_element(densities.values);
  for (double& value : densities.values) value = std::sqrt(std::sqrt(least / value));
  return function_of(densities, steps, execution);
}

}  // namespace rondel::mesh
