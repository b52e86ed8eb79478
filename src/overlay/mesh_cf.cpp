// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Grids as the Climate and Forecast conventions hold them (CF 1.11, sections 4.1, 4.2, 5.2, 7.1).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "io/bad_value.h"
#include "io/number.h"
#include "overlay/mesh_formats.h"
#include "rondel/error.h"
#include "rondel/mesh_files.h"
#include "system/arithmetic.h"

namespace rondel::overlay {
namespace {

using io::BadValue;
using io::NetcdfReader;

// As shares of a cell's width: what rounding to single precision may have moved.
constexpr double rounding_share = 1e-3;

struct CoordinatePair {
  const MeshVariable* lon = nullptr;
  const MeshVariable* lat = nullptr;
  const MeshVariable* lon_bounds = nullptr;
  const MeshVariable* lat_bounds = nullptr;

  [[nodiscard]] bool is_along_lines() const {
    return lon->shape.size() == 1 && lat->shape.size() == 1 && lon->dimensions != lat->dimensions;
  }
};

const MeshVariable* bounds_of(const NetcdfReader& file, const MeshVariable& variable) {
  const std::string name = io::netcdf_text(variable.attributes, "bounds");
  return name.empty() ? nullptr : &file.require(name);
}

// The first pair with bounds, or else the first along lines.
CoordinatePair coordinates_of(const NetcdfReader& file) {
  CoordinatePair along_lines;
  bool has_any = false;
  for (const MeshVariable& lon : file.variables()) {
    if (!is_longitude(lon) || lon.shape.empty()) continue;
    for (const MeshVariable& lat : file.variables()) {
      if (!is_latitude(lat) || lat.shape.empty()) continue;
      const CoordinatePair pair = {&lon, &lat, bounds_of(file, lon), bounds_of(file, lat)};
      const bool has_bounds = pair.lon_bounds != nullptr && pair.lat_bounds != nullptr;
      if (!pair.is_along_lines() && lon.dimensions != lat.dimensions) continue;
      if (has_bounds) return pair;
      has_any = true;
      if (pair.is_along_lines() && along_lines.lon == nullptr) along_lines = pair;
    }
  }
  if (along_lines.lon == nullptr && has_any) {
    throw BadValue("its longitudes and latitudes have no bounds, so no cells");
  }
  return along_lines;
}

// Lines half way between the coordinates.
std::vector<double> lines_between(const std::vector<double>& values) {
  std::vector<double> lines;
  const std::size_t n = values.size();
  lines.push_back(values[0] - (values[1] - values[0]) / 2);
  for (std::size_t i = 0; i + 1 < n; ++i) lines.push_back((values[i] + values[i + 1]) / 2);
  lines.push_back(values[n - 1] + (values[n - 1] - values[n - 2]) / 2);
  return lines;
}

// Lines from the two bounds of each cell. Throws BadValue if neighbors do not share one.
std::vector<double> lines_of_bounds(const MeshVariable& variable, std::vector<double> bounds,
                                    bool is_around) {
  const std::size_t n = bounds.size() / 2;
  const bool is_forward = n < 2 || std::abs(std::remainder(bounds[1] - bounds[2], 360)) <=
                                       std::abs(std::remainder(bounds[0] - bounds[3], 360));
  std::vector<double> lines = {bounds[is_forward ? 0 : 1]};
  for (std::size_t i = 0; i < n; ++i) {
    double low = bounds[2 * i + (is_forward ? 0 : 1)];
    double high = bounds[2 * i + (is_forward ? 1 : 0)];
    const double turns = is_around ? std::round((lines.back() - low) / 360) * 360 : 0;
    low += turns;
    high += turns;
    if (is_around && high < low) high += 360;
    if (!(std::abs(low - lines.back()) <= rounding_share * std::abs(high - low))) {
      throw BadValue("bounds " + io::in_quotes(variable.name) + " leave a gap before cell " +
                     std::to_string(i));
    }
    lines.push_back(high);
  }
  return lines;
}

// So that a grid around the globe has no gap of rounding.
void close(std::vector<double>& meridians) {
  const double gap = 360 - (meridians.back() - meridians.front());
  if (std::abs(gap) <= rounding_share * (meridians[1] - meridians[0])) {
    meridians.back() = meridians.front() + 360;
  }
}

std::vector<double> meridians_between(std::vector<double> values) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    values[i] += std::ceil((values[i - 1] - values[i]) / 360) * 360;
  }
  std::vector<double> lines = lines_between(values);
  close(lines);
  return lines;
}

std::vector<double> parallels_between(const std::vector<double>& values) {
  std::vector<double> lines = lines_between(values);
  const auto to_pole = [](double line, double width) {
    return 90 - std::abs(line) < std::abs(width) ? std::copysign(90, line) : line;
  };
  const std::size_t n = lines.size();
  const double last_width = lines[n - 1] - lines[n - 2];
  lines[0] = to_pole(lines[0], lines[1] - lines[0]);
  lines[n - 1] = to_pole(lines[n - 1], last_width);
  return lines;
}

void require_two(const MeshVariable& bounds, const MeshVariable& of) {
  if (bounds.num_values == 2 * of.num_values) return;
  throw BadValue("variable " + io::in_quotes(bounds.name) + " has " +
                 std::to_string(bounds.num_values) + " values instead of " +
                 std::to_string(2 * of.num_values));
}

void require_finite(const MeshVariable& variable, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    throw BadValue("value " + std::to_string(i) + " of " + io::in_quotes(variable.name) +
                   " is not finite");
  }
}

std::vector<double> meridians_of(const NetcdfReader& file, const CoordinatePair& pair) {
  if (pair.lon_bounds == nullptr) {
    const std::vector<double> values = file.degrees(*pair.lon);
    require_finite(*pair.lon, values);
    if (values.size() < 2) throw BadValue("one longitude without bounds has no width");
    return meridians_between(values);
  }
  require_two(*pair.lon_bounds, *pair.lon);
  const std::vector<double> bounds = file.degrees(*pair.lon_bounds);
  require_finite(*pair.lon_bounds, bounds);
  std::vector<double> lines = lines_of_bounds(*pair.lon_bounds, bounds, true);
  close(lines);
  return lines;
}

std::vector<double> parallels_of(const NetcdfReader& file, const CoordinatePair& pair) {
  if (pair.lat_bounds != nullptr) {
    require_two(*pair.lat_bounds, *pair.lat);
    const std::vector<double> bounds = file.degrees(*pair.lat_bounds);
    require_finite(*pair.lat_bounds, bounds);
    return lines_of_bounds(*pair.lat_bounds, bounds, false);
  }
  const std::vector<double> values = file.degrees(*pair.lat);
  require_finite(*pair.lat, values);
  if (values.size() < 2) throw BadValue("one latitude without bounds has no width");
  return parallels_between(values);
}

}  // namespace

std::optional<MeshContent> read_cf_grid(const NetcdfReader& file) {
  const CoordinatePair pair = coordinates_of(file);
  if (pair.lon == nullptr) return std::nullopt;
  MeshContent mesh;
  mesh.convention = "CF";
  if (!pair.is_along_lines()) {
    take_corners(file, *pair.lon_bounds, *pair.lat_bounds, pair.lon->num_values, mesh);
    take_centers(file, pair.lon, pair.lat, mesh);
    if (pair.lon->shape.size() > 1) mesh.shape = pair.lon->shape;
    return mesh;
  }
  mesh.grid = LonLatGrid{meridians_of(file, pair), parallels_of(file, pair)};
  mesh.shape = {pair.lat->num_values, pair.lon->num_values};
  const std::vector<double> lons = file.degrees(*pair.lon);
  const std::vector<double> lats = file.degrees(*pair.lat);
  const std::string name = io::in_quotes(pair.lat->name);
  for (std::size_t j = 0; j < lats.size(); ++j) {
    for (const double lon : lons) {
      mesh.centers.push_back(require_position(name, j, lon, lats[j]));
    }
  }
  return mesh;
}

}  // namespace rondel::overlay

namespace rondel {

LonLatGrid grid_around(std::span<const double> lon_deg, std::span<const double> lat_deg) {
  const system::ArithmeticScope arithmetic;
  if (lon_deg.size() < 2 || lat_deg.size() < 2) {
    throw InvalidInput("one longitude or latitude has no width", 0);
  }
  for (const std::span<const double> values : {lon_deg, lat_deg}) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isfinite(values[i])) continue;
      const char* const name = values.data() == lon_deg.data() ? "longitude " : "latitude ";
      throw InvalidInput(name + std::to_string(i) + " is not finite", i);
    }
  }
  return {overlay::meridians_between({lon_deg.begin(), lon_deg.end()}),
          overlay::parallels_between({lat_deg.begin(), lat_deg.end()})};
}

}  // namespace rondel
