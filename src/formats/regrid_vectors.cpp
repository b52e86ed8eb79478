// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_vectors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "exact/vector.h"
#include "formats/regrid_fields.h"
#include "io/number.h"
#include "rondel/conventions.h"
#include "rondel/error.h"

namespace rondel::formats {
namespace {

// The number of components of a vector in space: x, y and z.
constexpr std::size_t in_space = 3;

// A place that is missing has no vector, so any direction will do.
exact::SineCosine turn_of(double degrees) {
  return exact::sine_cosine_of_degrees(std::isfinite(degrees) ? degrees : 0);
}

// Returns the array of this name. Throws FileError if the file has none, or it is not carried.
std::size_t array_named(const FieldFile& file, const std::string& name,
                        const std::string& file_name) {
  const std::optional<std::size_t> found = file.find(name);
  if (!found) {
    throw FileError(file_name + ": " + io::in_quotes(name) +
                    ", a component of vectors, is none of the fields that are regridded");
  }
  return *found;
}

// Returns what the file says of a component.
VectorComponent component_of(const FieldArray& array) {
  const auto text = [&](std::string_view attribute) {
    const auto found =
        std::ranges::find(array.attributes, attribute, &std::pair<std::string, std::string>::first);
    return found == array.attributes.end() ? std::string() : found->second;
  };
  return {array.name, text("standard_name"), text("units"), has_flags(array)};
}

}  // namespace

SideDirections::SideDirections(const RegridSide& side) {
  if (const LonLatAxes* const axes = side.axes()) {
    row_ = axes->lon_deg.size();
    for (const double lon : axes->lon_deg) lons_.push_back(turn_of(lon));
    for (const double lat : axes->lat_deg) lats_.push_back(turn_of(lat));
    return;
  }
  for (const LonLat& place : side.places()) {
    lons_.push_back(turn_of(place.lon_deg));
    lats_.push_back(turn_of(place.lat_deg));
  }
}

EastAndNorth SideDirections::at(std::size_t place) const {
  const auto& lon = lons_[row_ == 0 ? place : place % row_];
  const auto& lat = lats_[row_ == 0 ? place : place / row_];
  return {{-lon.sine, lon.cosine, 0}, {-lat.sine * lon.cosine, -lat.sine * lon.sine, lat.cosine}};
}

// An array may be in one pair alone, since its result has one value at each target.
RegridVectors::RegridVectors(const FieldFile& file, const std::string& file_name,
                             std::span<const std::pair<std::string, std::string>> names,
                             const RegridSide& source, const RegridSide& target)
    : file_(file), sources_(source.num_places()), targets_(target.num_places()) {
  const FieldSet& fields = file.fields();
  for (const auto& [east, north] : names) {
    const VectorArrays pair{array_named(file, east, file_name),
                            array_named(file, north, file_name)};
    if (pair.east == pair.north || pair_of(pair.east) != nullptr ||
        pair_of(pair.north) != nullptr) {
      throw FileError(file_name + ": " + io::in_quotes(east) + " and " + io::in_quotes(north) +
                      " are no pair of vectors, as one of them is named twice");
    }
    const FieldArray& of_east = fields.arrays[pair.east];
    const FieldArray& of_north = fields.arrays[pair.north];
    if (of_east.dimensions != of_north.dimensions || of_east.shape != of_north.shape) {
      throw FileError(file_name + ": " + io::in_quotes(east) + " and " + io::in_quotes(north) +
                      ", components of vectors, have different dimensions");
    }
    const std::string lack =
        lack_of_vectors(component_of(of_east), component_of(of_north), source.axes() != nullptr);
    if (!lack.empty()) {
      throw FileError((file_name + ": " + io::in_quotes(east) + " and " + io::in_quotes(north) +
                       " are no eastward and northward components: ")
                          .append(lack));
    }
    pairs_.push_back(pair);
  }
  if (pairs_.empty()) return;
  frames_.emplace_back(source);
  frames_.emplace_back(target);
}

const RegridVectors::VectorArrays* RegridVectors::pair_of(std::size_t array) const {
  const auto found = std::ranges::find_if(pairs_, [array](const VectorArrays& pair) {
    return pair.east == array || pair.north == array;
  });
  return found == pairs_.end() ? nullptr : &*found;
}

std::size_t RegridVectors::components(std::size_t array) const {
  return pair_of(array) == nullptr ? 1 : in_space;
}

// The vector is u times the direction to the east and v times that to the north; where one of both is
// missing, so are all three components.
void RegridVectors::to_space(std::size_t first_point, std::span<double> out) const {
  const std::size_t n = out.size() / in_space;
  for (std::size_t i = 0; i < n; ++i) {
    const double u = out[i];
    const double v = out[n + i];
    const EastAndNorth frame = frames_[0].at(first_point + i);
    const Point vector = u * frame.east + v * frame.north;
    out[i] = vector.x;
    out[n + i] = vector.y;
    out[2 * n + i] = vector.z;
  }
}

// The two components of a field are read into the first two thirds of its room, and turned there.
void RegridVectors::read(std::size_t array, std::size_t first, std::span<double> out,
                         const Execution& execution) const {
  const VectorArrays* const pair = pair_of(array);
  if (pair == nullptr) {
    file_.read(array, first, out, execution);
    return;
  }
  for (; !out.empty(); out = out.subspan(in_space * sources_), ++first) {
    const std::span<double> field = out.first(in_space * sources_);
    file_.read(pair->east, first, field.first(sources_), execution);
    file_.read(pair->north, first, field.subspan(sources_, sources_), execution);
    to_space(0, field);
  }
}

void RegridVectors::read_points(std::size_t array, std::size_t field, std::size_t first_point,
                                std::span<double> out) const {
  const VectorArrays* const pair = pair_of(array);
  if (pair == nullptr) {
    file_.read_points(array, field, first_point, out);
    return;
  }
  const std::size_t n = out.size() / in_space;
  file_.read_points(pair->east, field, first_point, out.first(n));
  file_.read_points(pair->north, field, first_point, out.subspan(n, n));
  to_space(first_point, out);
}

// The part of a vector along the sphere has as components its products with the two directions. What
// is across the sphere, which means of tangent vectors have, is left out.
std::vector<double> RegridVectors::at_targets(std::size_t array, std::vector<double> fields,
                                              std::span<const Index> targets) const {
  const VectorArrays* const pair = pair_of(array);
  if (pair == nullptr) return fields;
  const std::size_t n = targets.empty() ? targets_ : targets.size();
  const std::size_t num_fields = n == 0 ? 0 : fields.size() / (in_space * n);
  std::vector<double> result(num_fields * n);
  for (std::size_t f = 0; f < num_fields; ++f) {
    const auto given = std::span<const double>(fields).subspan(f * in_space * n, in_space * n);
    for (std::size_t i = 0; i < n; ++i) {
      const EastAndNorth frame = frames_[1].at(targets.empty() ? i : targets[i]);
      const Point vector{given[i], given[n + i], given[2 * n + i]};
      result[f * n + i] = dot(vector, array == pair->east ? frame.east : frame.north);
    }
  }
  return result;
}

}  // namespace rondel::formats
