// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/field_layout.h"

#include <algorithm>
#include <cmath>

#include "io/bad_value.h"
#include "io/cf_names.h"
#include "io/cf_reader.h"

namespace rondel::interpolation {
namespace {

using LayoutVariable = io::NetcdfReader::Variable;

// The products of the last lengths, without those of 1.
std::vector<std::uint64_t> products(std::span<const std::uint64_t> lengths) {
  std::vector<std::uint64_t> result = {1};
  for (std::size_t k = lengths.size(); k-- > 0;) {
    if (lengths[k] != 1) result.push_back(result.back() * lengths[k]);
  }
  return result;
}

// Whether arrays of these lengths hold the same values in the same order, one perhaps with dimensions made one.
bool agree(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b) {
  const std::vector<std::uint64_t> of_a = products(a);
  const std::vector<std::uint64_t> of_b = products(b);
  return std::ranges::includes(of_a, of_b) || std::ranges::includes(of_b, of_a);
}

// Reverses the dimensions where the lengths of the grid say so. False if they are others.
bool fit(std::span<const std::uint64_t> wanted, const LayoutVariable& variable,
         std::vector<std::size_t>& points) {
  if (wanted.size() < 2) return true;
  std::vector<std::uint64_t> lengths;
  lengths.reserve(points.size());
  for (const std::size_t d : points) lengths.push_back(variable.shape[d]);
  if (agree(lengths, wanted)) return true;
  std::ranges::reverse(lengths);
  std::ranges::reverse(points);
  return agree(lengths, wanted);
}

bool has_no_place(const LonLat& place) {
  return std::isnan(place.lon_deg) || std::isnan(place.lat_deg);
}

// The dimensions that are longer than 1.
std::set<std::size_t> long_ones(std::span<const std::size_t> dimensions,
                                std::span<const std::uint64_t> lengths) {
  std::set<std::size_t> result;
  for (std::size_t k = 0; k < dimensions.size(); ++k) {
    if (lengths[k] > 1) result.insert(dimensions[k]);
  }
  return result;
}

void take_rest(const LayoutVariable& variable, FieldDimensions& layout) {
  for (std::size_t d = 0; d < variable.shape.size(); ++d) {
    if (std::ranges::count(layout.points, d) == 0) layout.leading.push_back(d);
  }
}

}  // namespace

std::vector<std::size_t> FieldDimensions::order() const {
  std::vector<std::size_t> all = leading;
  all.insert(all.end(), points.begin(), points.end());
  return all;
}

FieldDimensionFinder::FieldDimensionFinder(const io::NetcdfReader& file, std::uint64_t num_points,
                                           std::span<const std::uint64_t> shape)
    : file_(file),
      num_points_(num_points),
      shape_(shape.begin(), shape.end()),
      headers_(io::headers_of(file)) {}

const FieldDimensionFinder::KnownPlaces& FieldDimensionFinder::places_of_pair(
    const CoordinatePair& pair) {
  for (const KnownPlaces& known : known_) {
    if (known.lon == pair.lon && known.lat == pair.lat) return known;
  }
  const LayoutVariable& lon = file_.variables()[pair.lon];
  const LayoutVariable& lat = file_.variables()[pair.lat];
  KnownPlaces known{pair.lon, pair.lat, {}, {}, {}, 0};
  if (pair.are_axes) {
    known.dimensions = {lat.dimensions[0], lon.dimensions[0]};
    known.shape = {lat.shape[0], lon.shape[0]};
    const std::vector<double> lons =
        io::degrees_of(file_, lon, io::UsualUnits::of_name, {nullptr, &lat});
    for (const double y : io::degrees_of(file_, lat, io::UsualUnits::of_name, {nullptr, &lon})) {
      for (const double x : lons) known.places.push_back({x, y});
    }
  } else {
    const io::PlaceArrays arrays = io::places_of(file_, lon, lat);
    known.dimensions = arrays.dimensions;
    known.shape = arrays.shape;
    for (std::size_t i = 0; i < arrays.lon.size(); ++i) {
      known.places.push_back({arrays.lon[i], arrays.lat[i]});
    }
  }
  known.num_known = known.places.size() -
                    static_cast<std::size_t>(std::ranges::count_if(known.places, has_no_place));
  known_.push_back(std::move(known));
  return known_.back();
}

std::optional<FieldDimensions> FieldDimensionFinder::by_coordinates(
    const LayoutVariable& variable) {
  std::optional<FieldDimensions> layout;
  int rank = 0;
  for (const CoordinatePair& pair : find_coordinates(headers_, {{}, {}, variable.name})) {
    if (layout && pair.rank < rank) break;
    const LayoutVariable& lon = file_.variables()[pair.lon];
    const std::uint64_t most =
        pair.are_axes ? lon.num_values * file_.variables()[pair.lat].num_values : lon.num_values;
    if (most < num_points_) continue;
    const KnownPlaces& known = places_of_pair(pair);
    const bool fits = known.places.size() == num_points_ || known.num_known == num_points_;
    if (num_points_ != 0 && !fits) continue;
    if (layout) {
      if (layout->kept.empty()) layout->places.clear();  // said more than once
      break;
    }
    FieldDimensions found;
    for (const std::size_t dimension : known.dimensions) {
      const auto at = std::ranges::find(variable.dimensions, dimension);
      found.points.push_back(static_cast<std::size_t>(at - variable.dimensions.begin()));
    }
    const std::vector<std::size_t> before = found.points;
    if (!fit(shape_, variable, found.points)) continue;
    found.places = known.places;
    if (found.points != before) {
      std::vector<std::size_t> numbers(known.places.size());
      const std::size_t row = known.shape.back();
      const std::size_t num_rows = numbers.size() / row;
      // Only two dimensions can fit in reverse, but for others of length 1.
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        found.places[i] = known.places[i % num_rows * row + i / num_rows];
      }
    }
    leave_out_missing(known, found);
    take_rest(variable, found);
    layout = std::move(found);
    rank = pair.rank;
  }
  return layout;
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
  layout.places = std::move(places);
}

std::optional<FieldDimensions> FieldDimensionFinder::by_lengths(const LayoutVariable& variable) {
  FieldDimensions layout;
  layout.points = run_of_points(variable);
  const std::vector<std::size_t> before = layout.points;
  if (layout.points.empty() || !fit(shape_, variable, layout.points)) return std::nullopt;
  if (!may_be_of_places(variable, layout.points)) return std::nullopt;
  layout.is_reversed = layout.points != before;
  take_rest(variable, layout);
  return layout;
}

const std::vector<FieldDimensionFinder::DimensionSet>& FieldDimensionFinder::sets_of_places() {
  if (sets_of_places_) return *sets_of_places_;
  sets_of_places_.emplace();
  for (const CoordinatePair& pair : find_coordinates(headers_, {})) {
    const LayoutVariable& lon = file_.variables()[pair.lon];
    const std::uint64_t most =
        pair.are_axes ? lon.num_values * file_.variables()[pair.lat].num_values : lon.num_values;
    if (!pair.is_used || most < num_points_) continue;
    try {
      const KnownPlaces& known = places_of_pair(pair);
      if (known.places.size() != num_points_ && known.num_known != num_points_) continue;
      sets_of_places_->push_back(long_ones(known.dimensions, known.shape));
    } catch (const io::BadValue&) {
      continue;  // coordinates that are no places
    }
  }
  return *sets_of_places_;
}

// Where the file has longitudes and latitudes of the points, values on other dimensions of the same lengths are elsewhere.
bool FieldDimensionFinder::may_be_of_places(const LayoutVariable& variable,
                                            std::span<const std::size_t> points) {
  const std::vector<DimensionSet>& sets = sets_of_places();
  if (sets.empty()) return true;
  std::vector<std::size_t> dimensions;
  std::vector<std::uint64_t> lengths;
  for (const std::size_t d : points) {
    dimensions.push_back(variable.dimensions[d]);
    lengths.push_back(variable.shape[d]);
  }
  return std::ranges::count(sets, long_ones(dimensions, lengths)) != 0;
}

// The candidates are tried in this order: the dimension that is called cells; dimensions as long as those of the grid; the last ones; a
// single one; others that follow each other.
std::vector<std::size_t> FieldDimensionFinder::run_of_points(const LayoutVariable& variable) const {
  const std::span<const std::uint64_t> shape = variable.shape;
  const std::size_t rank = shape.size();
  std::vector<std::size_t> best;
  int rank_of_best = 0;
  for (std::size_t begin = 0; begin < rank; ++begin) {
    std::uint64_t product = 1;
    for (std::size_t end = begin + 1; end <= rank; ++end) {
      if (__builtin_mul_overflow(product, shape[end - 1], &product)) break;
      if (product != num_points_) continue;
      const bool is_single = end == begin + 1;
      const std::string& name = file_.dimensions()[variable.dimensions[begin]].name;
      const int preference = is_single && io::is_name_of_cells(name)                         ? 5
                             : std::ranges::equal(shape.subspan(begin, end - begin), shape_) ? 4
                             : end == rank                                                   ? 3
                             : is_single                                                     ? 2
                                                                                             : 1;
      if (preference < rank_of_best) continue;
      rank_of_best = preference;
      best.clear();
      for (std::size_t d = begin; d < end; ++d) best.push_back(d);
      break;
    }
  }
  return best;
}

std::optional<FieldDimensions> FieldDimensionFinder::layout(const LayoutVariable& variable) {
  if (variable.type == io::NetcdfType::text) return std::nullopt;
  std::optional<FieldDimensions> found = by_coordinates(variable);
  if (num_points_ == 0) {
    if (!found || found->places.empty()) return std::nullopt;
    num_points_ = found->places.size();
  }
  return found ? found : by_lengths(variable);
}

bool FieldDimensionFinder::is_auxiliary(const LayoutVariable& variable) const {
  const auto index = static_cast<std::size_t>(&variable - file_.variables().data());
  const VariableHeader& header = headers_[index];
  if (header.dimensions.size() == 1 && header.dimensions[0] == header.name) return true;
  const std::string name = io::lower_case(header.name);
  const bool is_called_so =
      name.find("lon") != std::string::npos || name.find("lat") != std::string::npos;
  if (is_called_so && degrees_per_unit(header.text("units"))) return true;
  if (io::is_connectivity(header)) return true;
  if (io::coordinate_evidence(header, io::CoordinateKind::lon) > 0 ||
      io::coordinate_evidence(header, io::CoordinateKind::lat) > 0) {
    return true;
  }
  return std::ranges::any_of(
      headers_, [&](const VariableHeader& other) { return other.text("bounds") == header.name; });
}

}  // namespace rondel::interpolation
