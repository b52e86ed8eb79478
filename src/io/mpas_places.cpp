// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/mpas_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "io/bad_value.h"
#include "io/cf_reader.h"
#include "io/number.h"
#include "rondel/delaunay.h"
#include "system/shortest_text.h"

namespace rondel::io {
namespace {

// The largest distance of two places that count as one, in radians. Longitudes in single precision
// are off by up to 3e-7.
constexpr double most_apart_of_mpas = 1e-5;
// How far a latitude may be beyond a pole, in degrees: pi / 2 in single precision is 90.0000025
// degrees.
constexpr double rounding_of_pole = 1e-5;

}  // namespace

void require_one_place(const NetcdfReader& file, const std::string& kind, PlacesMay may) {
  const std::array<const NetcdfReader::Variable*, 5> variables = {
      file.find("lon" + kind), file.find("lat" + kind), file.find("x" + kind),
      file.find("y" + kind), file.find("z" + kind)};
  if (std::ranges::count(variables, nullptr) > 0) return;
  const auto [lon, lat, x, y, z] = variables;
  for (const auto* const variable : variables) {
    if (variable->num_values == x->num_values) continue;
    if (may == PlacesMay::be_missing) return;
    throw BadValue("variable " + in_quotes(variable->name) + " has " +
                   std::to_string(variable->num_values) + " values instead of " +
                   std::to_string(x->num_values));
  }
  const std::vector<double> lons = degrees_of(file, *lon, UsualUnits::radians, {nullptr, lat});
  const std::vector<double> lats = degrees_of(file, *lat, UsualUnits::radians, {nullptr, lon});
  const std::array<std::vector<double>, 3> xyz = {file.numbers(*x), file.numbers(*y),
                                                  file.numbers(*z)};
  for (std::size_t i = 0; i < lons.size(); ++i) {
    LonLat place{lons[i], lats[i]};
    const bool is_place =
        std::isfinite(place.lon_deg) && std::abs(place.lat_deg) <= 90 + rounding_of_pole;
    if (!is_place && may == PlacesMay::not_be_missing) {
      throw BadValue("value " + std::to_string(i) + " of " + in_quotes(lon->name) + " and " +
                     in_quotes(lat->name) + ", " + system::shortest_text(place.lon_deg) + " and " +
                     system::shortest_text(place.lat_deg) + " degrees, is no place");
    }
    if (!is_place) continue;
    place.lat_deg = std::clamp(place.lat_deg, -90.0, 90.0);
    const Point unit = unit_vectors({&place, 1}).front();
    const double length =
        std::sqrt(xyz[0][i] * xyz[0][i] + xyz[1][i] * xyz[1][i] + xyz[2][i] * xyz[2][i]);
    if (!(length > 0)) continue;
    const double dx = xyz[0][i] / length - unit.x;
    const double dy = xyz[1][i] / length - unit.y;
    const double dz = xyz[2][i] / length - unit.z;
    if (!(dx * dx + dy * dy + dz * dz > most_apart_of_mpas * most_apart_of_mpas)) continue;
    throw BadValue("value " + std::to_string(i) + " of " + in_quotes(lon->name) + " and " +
                   in_quotes(lat->name) + ", " + system::shortest_text(place.lon_deg) + " and " +
                   system::shortest_text(place.lat_deg) +
                   " degrees, is another place than that of " + in_quotes(x->name) + ", " +
                   in_quotes(y->name) + " and " + in_quotes(z->name));
  }
}

}  // namespace rondel::io
