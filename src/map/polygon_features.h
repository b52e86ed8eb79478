// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons and lines in longitude and latitude, as files have them.
//
// index features of a file, or its bare geometries
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "rondel/io.h"
#include "rondel/types.h"
#include "system/message_text.h"

namespace rondel::map {

// A ring as the file has it.
struct LonLatRing {
  std::vector<LonLat> positions;  // degrees; the first position is not repeated
  bool is_hole = false;           // a ring that is not a hole begins a polygon
  bool is_turn =
      false;  // its last position is the first one a whole turn of the globe away, and left out
  // The positions before corners of others were inserted, if the ring is so thin that these may
  // have closed it (overlay/feature_polygons.h).
  std::vector<LonLat> thin_positions = {};
  bool is_left_out = false;  // no wider than rounding
  std::string fault = {};    // what makes it no ring, to be repaired; empty for a ring
  bool is_shorter = false;   // sides of more than 180 degrees go the shorter way around the globe
};

// Returns where a side ends that goes the shorter way around the globe, on the turn of its
// beginning.
inline LonLat end_of_shorter(const LonLat& from, const LonLat& to) {
  return {from.lon_deg + std::remainder(to.lon_deg - from.lon_deg, 360.0), to.lat_deg};
}

// Returns a ring of a file, whose last position is the first one again, without its last position.
inline LonLatRing ring_of_file(std::vector<LonLat> positions, bool is_hole) {
  constexpr std::size_t least = 4;
  const std::size_t size = positions.size();
  const bool is_closed = size > 0 && positions.front() == positions.back();
  const bool is_turn =
      size > 0 && !is_closed && positions.front().lat_deg == positions.back().lat_deg &&
      std::remainder(positions.front().lon_deg - positions.back().lon_deg, 360.0) == 0;
  if (is_closed || is_turn) positions.pop_back();
  LonLatRing ring{std::move(positions), is_hole, is_turn};
  if (size < least) {
    ring.fault = "a ring of " + std::to_string(size) + " positions";
  } else if (!is_closed && !is_turn) {
    const auto text_of = [](const LonLat& place) {
      return system::shortest_text(place.lon_deg) + ' ' + system::shortest_text(place.lat_deg);
    };
    ring.fault = "a ring that is not closed, from " + text_of(ring.positions.front()) + " to " +
                 text_of(ring.positions.back());
  }
  return ring;
}

// A file, or an array of another program, that has features.
struct FeatureFile {
  std::string name;  // for messages
  std::vector<Column> columns;
  Column ids;                    // the members `id`, as JSON; without cells if there are none
  std::size_t num_features = 0;  // of several files: how many features are this one's
};

// Row i belongs to feature i of the files, one file after the other; or to bare geometry i.
struct PolygonFeatures {
  std::vector<FeatureFile> files = std::vector<FeatureFile>(1);
  std::vector<std::vector<LonLatRing>> rings;
  std::vector<std::vector<std::vector<LonLat>>> lines;  // a point is a line of one position

  // A feature by its file.
  struct PlaceInFile {
    const FeatureFile& file;
    std::size_t feature;  // of this file
  };
  [[nodiscard]] PlaceInFile place_of(std::size_t feature) const {
    std::size_t file = 0;
    for (; file + 1 < files.size() && feature >= files[file].num_features; ++file) {
      feature -= files[file].num_features;
    }
    return {files[file], feature};
  }
};

// Returns the features of all files.
inline PolygonFeatures joined(std::vector<PolygonFeatures> sets) {
  PolygonFeatures all;
  all.files.clear();
  for (PolygonFeatures& set : sets) {
    set.files.front().num_features = set.rings.size();
    std::ranges::move(set.files, std::back_inserter(all.files));
    std::ranges::move(set.rings, std::back_inserter(all.rings));
    std::ranges::move(set.lines, std::back_inserter(all.lines));
  }
  return all;
}

}  // namespace rondel::map
