// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>

#include "overlay/feature_polygons.h"

namespace rondel::overlay {

std::optional<std::size_t> lone_long_side(std::span<const LonLat> ring) {
  const bool is_north = std::ranges::all_of(ring, [](const LonLat& p) { return p.lat_deg > 0; });
  const bool is_south = std::ranges::all_of(ring, [](const LonLat& p) { return p.lat_deg < 0; });
  if (!is_north && !is_south) return std::nullopt;
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LonLat& from = ring[k];
    const LonLat& to = ring[k + 1 < ring.size() ? k + 1 : 0];
    if (std::abs(to.lon_deg - from.lon_deg) <= 180) continue;
    if (found || (std::abs(from.lat_deg) == 90 && std::abs(to.lat_deg) == 90)) return std::nullopt;
    found = k;
  }
  if (!found) return std::nullopt;
  const std::size_t n = ring.size();
  const std::size_t next = (*found + 1) % n;
  const bool is_of_box = ring[*found].lon_deg == ring[(*found + n - 1) % n].lon_deg &&
                         ring[next].lon_deg == ring[(next + 1) % n].lon_deg;
  return is_of_box ? std::nullopt : found;
}

}  // namespace rondel::overlay
