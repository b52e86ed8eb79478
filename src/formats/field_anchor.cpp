// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Chooses the places that all fields of a file are at (the anchor), and names them and others in
// messages. The anchor is the wanted places if they are given, or else the places of the first
// variable for which the file leaves one answer; variables at other places are told apart by
// distance, not by name.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "exact/angles.h"
#include "formats/field_layout.h"
#include "rondel/conventions.h"
#include "system/message_text.h"

namespace rondel {

bool is_same_place(const LonLat& a, const LonLat& b, double max_apart_deg) {
  const auto is_missing = [](const LonLat& place) {
    return std::isnan(place.lon_deg) || std::isnan(place.lat_deg);
  };
  if (a == b || is_missing(a) || is_missing(b)) return true;
  const double east = std::abs(std::remainder(a.lon_deg - b.lon_deg, 360));
  const double lat = std::max(std::abs(a.lat_deg), std::abs(b.lat_deg));
  return std::abs(a.lat_deg - b.lat_deg) <= max_apart_deg &&
         (east <= max_apart_deg ||
          east * exact::sine_cosine_of_degrees(lat).cosine <= max_apart_deg);
}

}  // namespace rondel

namespace rondel::formats {
namespace {

// True if both lists have the same places in the same order.
bool are_near(const PlaceList& a, const PlaceList& b, double max_apart_deg) {
  return a.is_same(
      b, [&](const LonLat& x, const LonLat& y) { return is_same_place(x, y, max_apart_deg); });
}

}  // namespace

// Places in one file are the same if they are the same numbers, but for the rounding of single
// precision.
bool FieldDimensionFinder::are_one_place(std::size_t lon_a, std::size_t lon_b, const PlaceList& a,
                                         const PlaceList& b) const {
  const bool is_single = file_.variables()[lon_a].type == io::NetcdfType::float32 ||
                         file_.variables()[lon_b].type == io::NetcdfType::float32;
  return are_near(a, b, is_single ? 1e-4 : 1e-9);
}

// True if the places of the candidate are those of the anchor, which may come from the caller
// alone.
bool FieldDimensionFinder::is_at_anchor(const PossiblePlaces& candidate) const {
  if (candidate.layout.places.size() != anchor_->places.size()) return false;
  if (anchor_->lon == CoordinatePair::none) {
    return are_near(candidate.layout.places, anchor_->places, wanted_.max_apart_deg);
  }
  return are_one_place(candidate.lon, anchor_->lon, candidate.layout.places, anchor_->places);
}

// True if the variable is at the places that are wanted; these are then the places of its
// coordinates.
bool FieldDimensionFinder::choose_wanted(const io::VariableInFile& variable) {
  for (PossiblePlaces& candidate : candidates(variable)) {
    if (!are_near(candidate.layout.places, wanted_places_, wanted_.max_apart_deg)) continue;
    anchor_ = {candidate.lon, candidate.lat, variable.name, std::move(candidate.layout.places)};
    return true;
  }
  return false;
}

// The places are those that are wanted. Otherwise they are those of the first variable that has
// only one answer.
void FieldDimensionFinder::choose_places(std::span<const io::VariableInFile* const> variables) {
  const bool are_wanted = !wanted_.positions.empty();
  for (const io::VariableInFile* const variable : variables) {
    if (variable->type == io::NetcdfType::text) continue;
    try {
      if (are_wanted) {
        if (choose_wanted(*variable)) break;
        continue;
      }
      std::vector<PossiblePlaces> found = candidates(*variable);
      if (found.size() != 1) continue;
      const PlaceList& places = found.front().layout.places;
      // Where the number of points is not given, places with a missing or wrong coordinate do not
      // decide.
      const bool are_places = places.first_not([](const LonLat& place) {
        return std::abs(place.lat_deg) <= 90 && std::isfinite(place.lon_deg);
      }) == places.size();
      if (num_points_ == 0 && (places.empty() || !are_places)) continue;
      anchor_ = {found.front().lon, found.front().lat, variable->name, places};
      if (num_points_ == 0) num_points_ = anchor_->places.size();
      break;
    } catch (const io::BadValue&) {
      continue;  // told where the variable is read
    }
  }
  other_pairs_.clear();
  if (anchor_ || !are_wanted) return;
  name_wanted_places();
  other_pairs_.clear();
  if (!anchor_) {
    anchor_ = {CoordinatePair::none, CoordinatePair::none, std::string(), wanted_places_};
  }
}

// Another variable of the file may name these places in messages; a coordinate does where no field
// has them.
void FieldDimensionFinder::name_wanted_places() {
  for (const bool is_coordinate : {false, true}) {
    for (const io::VariableInFile& variable : file_.variables()) {
      const bool is_text = variable.type == io::NetcdfType::text;
      if (is_text || is_auxiliary(variable) != is_coordinate) continue;
      try {
        if (choose_wanted(variable)) return;
      } catch (const io::BadValue&) {
        continue;
      }
    }
  }
}

std::string FieldDimensionFinder::first_difference(const PlaceList& places) const {
  std::size_t i = 0;
  while (i + 1 < places.size() &&
         is_same_place(places[i], wanted_places_[i], wanted_.max_apart_deg)) {
    ++i;
  }
  const auto text = [](const LonLat& place) {
    return system::shortest_text(place.lon_deg) + " " + system::shortest_text(place.lat_deg);
  };
  return "place " + std::to_string(i) + " is at " + text(places[i]) + ", not at " +
         text(wanted_places_[i]);
}

// Returns the names of two coordinates for messages, "lon and lat".
std::string FieldDimensionFinder::names_of(std::size_t lon, std::size_t lat) const {
  return headers_[lon].name + " and " + headers_[lat].name;
}

std::string FieldDimensionFinder::names_of_places() const {
  const bool has_names = anchor_ && anchor_->lon != CoordinatePair::none;
  return has_names ? names_of(anchor_->lon, anchor_->lat) : std::string();
}

// Returns the names of the first three places at which a variable may be.
std::string FieldDimensionFinder::text_of_choice(const std::vector<PossiblePlaces>& found) const {
  std::string text;
  constexpr std::size_t most = 3;
  for (std::size_t k = 0; k < found.size() && k < most; ++k) {
    text += (k == 0 ? "" : ", or at ") + names_of(found[k].lon, found[k].lat);
  }
  return found.size() > most ? text + " ..." : text;
}

std::string FieldDimensionFinder::remark_on_grids() const {
  if (other_pairs_.empty() || names_of_places().empty()) return {};
  return "the file has several grids; that of " + names_of_places() + " is read, not that of " +
         text_of_others(other_pairs_) + "; FILE.nc:NAME names one by a variable";
}

}  // namespace rondel::formats
