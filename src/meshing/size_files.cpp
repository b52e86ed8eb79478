// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "io/geojson_polygons.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/interpolate.h"
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

// Lines, the rings of polygons, and points, which are lines of one position.
std::vector<std::vector<LonLat>> lines_of(const FileName& file) {
  io::PolygonFeatures features = io::read_polygon_features(file, io::FeatureKinds::all);
  std::vector<std::vector<LonLat>> all;
  for (std::size_t i = 0; i < features.rings.size(); ++i) {
    for (std::vector<LonLat>& line : features.lines[i]) all.push_back(std::move(line));
    for (io::LonLatRing& ring : features.rings[i]) {
      const LonLat closing = ring.positions.front();
      ring.positions.push_back(closing);
      all.push_back(std::move(ring.positions));
    }
  }
  return all;
}

struct Spacings {
  std::vector<Point> places;
  std::vector<double> values;
};

Spacings spacings_of(const FileName& file, const std::string& name, const Execution& execution) {
  Spacings result;
  std::vector<std::string> names;
  if (!name.empty()) names.push_back(name);
  const bool is_netcdf =
      file.format == "nc" || (file.format.empty() && ends_with(file.path, ".nc"));
  if (!is_netcdf) {
    SiteTable table = read_sites(file, {}, execution);
    if (names.empty()) throw FileError(table.name + ": which column has the spacings is not said");
    result.places = std::move(table.sites);
  }
  FieldSet fields = read_fields(file, names, result.places.size());
  if (is_netcdf) result.places = std::move(fields.points);
  if (fields.arrays.size() != 1 || fields.arrays.front().num_fields() != 1) {
    throw FileError(file.path + ": it has not one field of spacings" +
                    (name.empty() ? ": name it" : ""));
  }
  if (result.places.size() != fields.num_points) {
    throw FileError(file.path + ": its spacings have no longitudes and latitudes");
  }
  result.values = std::move(fields.arrays.front().values);
  return result;
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
  for (const std::vector<LonLat>& line : lines_of(file)) {
    const std::vector<Point> dense = densified(unit_vectors(line), distance);
    points.insert(points.end(), dense.begin(), dense.end());
  }
  if (points.empty()) throw FileError(file.path + ": it has no points");
  return points;
}

SizeFunction read_spacings(const FileName& file, const std::string& name, double unit,
                           std::size_t steps, const Execution& execution) {
  Spacings spacings = spacings_of(file, name, execution);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < spacings.values.size(); ++i) {
    const double radians = spacings.values[i] * unit;
    if (std::isnan(radians)) continue;  // missing
    if (!(radians > 0 && radians < 3)) {
      throw FileError(file.path + ": spacing " + std::to_string(spacings.values[i]) + " at place " +
                      std::to_string(i) + " is not positive, or too large");
    }
    spacings.places[kept] = spacings.places[i];
    spacings.values[kept++] = radians;
  }
  if (kept == 0) throw FileError(file.path + ": all of its spacings are missing");
  spacings.places.resize(kept);
  spacings.values.resize(kept);
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

}  // namespace rondel::mesh
