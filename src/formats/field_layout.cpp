// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the dimensions of points by coordinates (rules 1 and 2 of field_layout.h). layout() first
// asks the pairs of coordinates of a variable (candidates()), and takes the one at the anchor; only
// where the file says nothing of places it asks the lengths (field_lengths.cpp).
#include "formats/field_layout.h"

#include <algorithm>
#include <cmath>

#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/grid_of_file.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "rondel/named_grids.h"

namespace rondel::formats {
namespace {

// True if a coordinate of the place is missing.
bool has_no_place(const LonLat& place) {
  return std::isnan(place.lon_deg) || std::isnan(place.lat_deg);
}

}  // namespace

std::vector<std::size_t> FieldDimensions::order() const {
  std::vector<std::size_t> all = leading;
  all.insert(all.end(), points.begin(), points.end());
  return all;
}

FieldDimensionFinder::FieldDimensionFinder(const io::NetcdfReader& file, const FieldsToRead& wanted,
                                           std::span<const io::VariableInFile* const> variables)
    : file_(file),
      num_points_(wanted.num_points),
      shape_(wanted.shape.begin(), wanted.shape.end()),
      wanted_(wanted.places),
      headers_(headers_of(file)),
      coordinates_(headers_),
      parts_of_grids_(parts_of_grids(headers_)),
      are_at_places_(are_at_places(headers_)),
      are_measures_(are_measures_of_cells(headers_)) {
  // Places that are not as many as the points cannot be compared with them.
  if (wanted_.positions.size() != num_points_) wanted_.positions = {};
  wanted_places_ =
      PlaceList(std::vector<LonLat>(wanted_.positions.begin(), wanted_.positions.end()));
  take_pixels();
  std::vector<const io::VariableInFile*> fields(variables.begin(), variables.end());
  // Coordinates are fields only if they are named.
  if (wanted.names.empty()) {
    std::erase_if(fields, [&](const io::VariableInFile* field) { return is_auxiliary(*field); });
  }
  choose_places(fields);
  choose_dimension_of_cells(fields);
}

void FieldDimensionFinder::take_pixels() {
  const GridOfFile pixels = listed_pixels(file_);
  list_of_pixels_ = pixels.list;
  if (wanted_.positions.empty()) return;
  if (list_of_pixels_.empty()) {
    const auto place = [&](std::size_t i) { return wanted_.positions[i]; };
    require_named_places(file_, {wanted_.positions.size(), nullptr, place});
    return;
  }
  const NamedGrid grid(pixels.name);
  const bool are_all = pixels.numbers.empty();
  const std::size_t count = are_all ? grid.num_cells() : pixels.numbers.size();
  for (std::size_t i = 0; i < count && count == wanted_.positions.size(); ++i) {
    const LonLat& place = wanted_.positions[i];
    const LonLat center = grid.center(are_all ? i : pixels.numbers[i]);
    if (has_no_place(place) || is_same_place(center, place, wanted_.max_apart_deg)) continue;
    throw io::BadValue("variable " + io::in_quotes(list_of_pixels_) +
                       " has the numbers of pixels that are at other places than the source");
  }
}

const FieldDimensionFinder::KnownPlaces& FieldDimensionFinder::places_of_pair(
    const CoordinatePair& pair) {
  for (const KnownPlaces& known : known_) {
    if (known.lon == pair.lon && known.lat == pair.lat) return known;
  }
  const io::VariableInFile& lon = file_.variables()[pair.lon];
  const io::VariableInFile& lat = file_.variables()[pair.lat];
  KnownPlaces known{pair.lon, pair.lat, {}, {}, {}, 0};
  if (pair.are_axes) {
    known.dimensions = {lat.dimensions[0], lon.dimensions[0]};
    known.shape = {lat.shape[0], lon.shape[0]};
    known.places =
        PlaceList(LonLatAxes{degrees_of(file_, lon, UsualUnits::of_name, {nullptr, &lat}),
                             degrees_of(file_, lat, UsualUnits::of_name, {nullptr, &lon})});
  } else {
    const PlaceArrays arrays = places_of(file_, lon, lat);
    known.dimensions = arrays.dimensions;
    known.shape = arrays.shape;
    std::vector<LonLat> places;
    for (std::size_t i = 0; i < arrays.lon.size(); ++i) {
      places.push_back({arrays.lon[i], arrays.lat[i]});
    }
    known.places = PlaceList(std::move(places));
  }
  known.num_known = known.places.size();
  const std::size_t first_missing =
      known.places.first_not([](const LonLat& place) { return !has_no_place(place); });
  for (std::size_t i = first_missing; i < known.places.size(); ++i) {
    if (has_no_place(known.places[i])) --known.num_known;
  }
  known_.push_back(std::move(known));
  return known_.back();
}

// Returns the dimensions of a variable that is at these places. `points` is empty if the variable
// lacks a dimension of theirs, or the lengths are not those of the grid.
FieldDimensions FieldDimensionFinder::layout_along(const io::VariableInFile& variable,
                                                   const KnownPlaces& known) const {
  FieldDimensions found;
  for (const std::size_t dimension : known.dimensions) {
    const auto at = std::ranges::find(variable.dimensions, dimension);
    if (at == variable.dimensions.end()) return {};  // the places move, and the field has no time
    found.points.push_back(static_cast<std::size_t>(at - variable.dimensions.begin()));
  }
  const std::vector<std::size_t> before = found.points;
  if (!fit_lengths(shape_, variable, found.points)) return {};
  found.places = known.places;
  // Only two dimensions can fit in reverse, but for others of length 1.
  if (found.points != before) found.places = known.places.by_column(known.shape.back());
  leave_out_missing(known, found);
  take_other_dimensions(variable, found);
  return found;
}

void FieldDimensionFinder::leave_out_missing(const KnownPlaces& known,
                                             FieldDimensions& layout) const {
  const bool has_all = known.num_known == known.places.size() || known.places.size() == num_points_;
  if (has_all) return;
  std::vector<LonLat> places;
  for (std::size_t i = 0; i < layout.places.size(); ++i) {
    if (has_no_place(layout.places[i])) continue;
    places.push_back(layout.places[i]);
    layout.kept.push_back(i);
  }
  layout.places = PlaceList(std::move(places));
}

// Returns the places at which a variable may be, all of the best rank; sets why_not_ if it has
// coordinates, and not as many as there are points.
std::vector<FieldDimensionFinder::PossiblePlaces> FieldDimensionFinder::candidates(
    const io::VariableInFile& variable) {
  std::vector<PossiblePlaces> found;
  int rank = 0;
  why_not_.clear();
  const auto index = static_cast<std::size_t>(&variable - file_.variables().data());
  for (const CoordinatePair& pair : coordinates_.pairs_of(index)) {
    // The pairs come in the order of their ranks, and a worse one is no choice beside a better one.
    if (!found.empty() && pair.rank < rank) break;
    const io::VariableInFile& lon = file_.variables()[pair.lon];
    const std::uint64_t most =
        pair.are_axes ? lon.num_values * file_.variables()[pair.lat].num_values : lon.num_values;
    // Coordinates with fewer values than points need not be read.
    const KnownPlaces* const known = most < num_points_ ? nullptr : &places_of_pair(pair);
    const bool fits = num_points_ == 0 ||
                      (known != nullptr &&
                       (known->places.size() == num_points_ || known->num_known == num_points_));
    if (!fits) {
      if (why_not_.empty() && pair.is_used) {
        why_not_ = "is at " + names_of(pair.lon, pair.lat) + ", which are not " +
                   std::to_string(num_points_) + " places";
        other_pairs_.push_back(names_of(pair.lon, pair.lat));
      }
      continue;
    }
    FieldDimensions layout = layout_along(variable, *known);
    if (layout.points.empty()) continue;
    // Two pairs may have the same places under two names.
    const bool is_known = std::ranges::any_of(found, [&](const PossiblePlaces& other) {
      return other.layout.points == layout.points &&
             are_one_place(other.lon, pair.lon, other.layout.places, layout.places);
    });
    if (!is_known) found.push_back({pair.lon, pair.lat, std::move(layout)});
    rank = pair.rank;
  }
  if (!found.empty()) why_not_.clear();
  return found;
}

// Returns the dimensions of a variable at the anchor, or without an anchor at its only places.
// Throws BadValue if there are several places with different dimensions.
std::optional<FieldDimensions> FieldDimensionFinder::by_coordinates(
    const io::VariableInFile& variable) {
  std::vector<PossiblePlaces> found = candidates(variable);
  other_places_.clear();
  first_other_.clear();
  if (found.empty()) return std::nullopt;
  if (anchor_) {
    for (PossiblePlaces& candidate : found) {
      if (!is_at_anchor(candidate)) continue;
      if (found.size() > 1) {
        candidate.layout.remark = "variable " + io::in_quotes(variable.name) + " may be at " +
                                  text_of_choice(found) + "; it is read at " +
                                  names_of(candidate.lon, candidate.lat);
      }
      return std::move(candidate.layout);
    }
    other_places_ = names_of(found.front().lon, found.front().lat);
    other_pairs_.push_back(other_places_);
    why_not_ = "is at " + other_places_;
    if (anchor_->lon == CoordinatePair::none) {
      first_other_ = first_difference(found.front().layout.places);
      why_not_ += ", which are not the places that are wanted: " + first_other_;
    } else {
      why_not_ += ", and not at " + names_of_places();
      if (anchor_->variable != variable.name) {
        why_not_ += " as " + io::in_quotes(anchor_->variable);
      }
    }
    return std::nullopt;
  }
  if (found.size() == 1) return std::move(found.front().layout);
  // Several pairs of places may agree in which dimensions are theirs.
  const bool have_one_layout = std::ranges::all_of(found, [&](const PossiblePlaces& other) {
    return other.layout.points == found.front().layout.points;
  });
  if (num_points_ == 0 || !have_one_layout) {
    throw io::BadValue("variable " + io::in_quotes(variable.name) + " may be at " +
                       text_of_choice(found) + "; FILE.nc:" + headers_[found.back().lon].name +
                       ", the name of a coordinate, says where");
  }
  // Only the order of the values is needed, which is known.
  if (found.front().layout.kept.empty()) found.front().layout.places = {};
  return std::move(found.front().layout);
}

// The first variable with places gives the number of points if the caller has not.
std::optional<FieldDimensions> FieldDimensionFinder::layout(const io::VariableInFile& variable) {
  why_not_.clear();
  other_places_.clear();
  if (variable.type == io::NetcdfType::text) return std::nullopt;
  std::optional<FieldDimensions> found = by_coordinates(variable);
  if (num_points_ == 0) {
    if (!found || found->places.empty()) return std::nullopt;
    num_points_ = found->places.size();
  }
  if (found || !why_not_.empty()) return found;
  return by_lengths(variable);
}

// The tests go from what is certain to what only names suggest: an axis, degrees, a part of a mesh or
// the areas of its cells, a coordinate, bounds.
bool FieldDimensionFinder::is_auxiliary(const io::VariableInFile& variable) const {
  const auto index = static_cast<std::size_t>(&variable - file_.variables().data());
  const VariableHeader& header = headers_[index];
  if (header.dimensions.size() == 1 && header.dimensions[0] == header.name) return true;
  if (header.name == list_of_pixels_) return true;
  if (pixel_list_of(header, false) == PixelList::stated) return true;
  if (is_named_like_degrees(header) || parts_of_grids_[index] || are_measures_[index]) return true;
  if (coordinate_evidence(header, CoordinateKind::lon) > 0 ||
      coordinate_evidence(header, CoordinateKind::lat) > 0) {
    return true;
  }
  return coordinates_.are_named_bounds(header.name);
}

bool FieldDimensionFinder::is_plain_axis(const io::VariableInFile& variable) const {
  const auto index = static_cast<std::size_t>(&variable - file_.variables().data());
  const VariableHeader& header = headers_[index];
  const bool is_axis =
      header.is_number && header.dimensions.size() == 1 && header.dimensions[0] == header.name;
  return is_axis && header.name != list_of_pixels_ && !parts_of_grids_[index] &&
         !are_measures_[index] && !is_named_like_degrees(header) &&
         pixel_list_of(header, false) != PixelList::stated &&
         coordinate_evidence(header, CoordinateKind::lon) == 0 &&
         coordinate_evidence(header, CoordinateKind::lat) == 0;
}

bool FieldDimensionFinder::is_at_places(const io::VariableInFile& variable) const {
  return are_at_places_[static_cast<std::size_t>(&variable - file_.variables().data())];
}

bool FieldDimensionFinder::is_measure_of_cells(const io::VariableInFile& variable) const {
  return are_measures_[static_cast<std::size_t>(&variable - file_.variables().data())];
}

bool FieldDimensionFinder::is_lost(const io::VariableInFile& variable) const {
  const auto index = static_cast<std::size_t>(&variable - file_.variables().data());
  const VariableHeader& header = headers_[index];
  if (parts_of_grids_[index]) return false;
  if (header.shape.empty()) {
    // Mappings and topologies are numbers or characters without a meaning.
    return header.text("grid_mapping_name").empty() && header.text("cf_role").empty() &&
           header.text("standard_name") != "mesh_topology";
  }
  if (!header.is_number) {
    return header.shape.size() == 1 && header.dimensions[0] == header.name;
  }
  return coordinates_.are_bounds_of_others(header.name);
}

}  // namespace rondel::formats
