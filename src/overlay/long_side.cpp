// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "overlay/feature_polygons.h"
#include "rondel/polygon_files.h"
#include "system/message_text.h"

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

std::vector<LongSide> long_sides(const map::PolygonFeatures& features) {
  std::vector<LongSide> found;
  for (std::size_t f = 0; f < features.rings.size(); ++f) {
    for (std::size_t r = 0; r < features.rings[f].size(); ++r) {
      const std::vector<LonLat>& ring = features.rings[f][r].positions;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const LonLat& from = ring[k];
        const LonLat& to = ring[k + 1 < ring.size() ? k + 1 : 0];
        const double width = std::abs(to.lon_deg - from.lon_deg);
        const bool is_at_pole = std::abs(from.lat_deg) == 90 && std::abs(to.lat_deg) == 90;
        if (width > 180 && width < 360 && !is_at_pole) found.push_back({f, r, from, to});
      }
    }
  }
  return found;
}

void tell_of_long_sides(const std::vector<LongSide>& sides, const map::PolygonFeatures& features,
                        std::vector<CellFacts>& facts) {
  struct Told {
    const LongSide* first = nullptr;
    std::size_t number = 0;
  };
  std::vector<Told> told(facts.size());
  for (const LongSide& side : sides) {
    const std::vector<map::LonLatRing>& rings = features.rings[side.feature];
    if (side.ring < rings.size() && rings[side.ring].is_shorter) continue;
    const auto file = &features.place_of(side.feature).file - features.files.data();
    Told& of_file = told[static_cast<std::size_t>(file)];
    if (of_file.number++ == 0) of_file.first = &side;
  }
  for (std::size_t k = 0; k < told.size(); ++k) {
    if (told[k].number == 0) continue;
    const auto& [feature, ring, from, to] = *told[k].first;
    const auto [file, of_file] = features.place_of(feature);
    std::string text = "feature " + feature_name(file.columns, of_file) + ": the side from " +
                       text_of_place(from) + " to " + text_of_place(to) + " goes " +
                       system::shortest_text(std::abs(to.lon_deg - from.lon_deg)) +
                       " degrees of longitude, the long way around the globe";
    const std::size_t others = told[k].number - 1;
    if (others == 1) text += ", as does another side";
    if (others > 1) text += ", as do " + std::to_string(others) + " other sides";
    facts[k].remarks.push_back(std::move(text));
  }
}

}  // namespace rondel::overlay
