// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the variables that are longitudes and latitudes, and pairs those that belong together: CF
// 1.11, sections 4.1, 4.2, 5 and 7.1.
#include <algorithm>
#include <string>

#include "formats/cf_names.h"
#include "rondel/conventions.h"
#include "rondel/error.h"

namespace rondel {
namespace {

using formats::CoordinateKind;

constexpr std::size_t none = CoordinatePair::none;

// The rank of a pair is a sum of these. Each is more than all that follow it together, so that the
// first difference of two pairs decides.
constexpr int rank_of_listed = 64;
constexpr int rank_of_attributes = 32;
constexpr int rank_of_bounds = 16;
constexpr int rank_of_axes = 8;
constexpr int rank_of_used = 4;
constexpr int rank_of_standard_names = 2;
constexpr int rank_of_uncrossed = 1;

// The attributes by which CF marks longitudes, or latitudes.
struct DirectionMarks {
  std::string_view standard_name;
  std::string_view axis_type;  // used by netCDF-Java
  std::vector<std::string_view> units;
};

// Returns the marks of longitudes or latitudes.
const DirectionMarks& marks_of(CoordinateKind kind) {
  static const DirectionMarks east = {
      "longitude",
      "Lon",
      {"degrees_east", "degree_east", "degree_e", "degrees_e", "degreee", "degreese"}};
  static const DirectionMarks north = {
      "latitude",
      "Lat",
      {"degrees_north", "degree_north", "degree_n", "degrees_n", "degreen", "degreesn"}};
  return kind == CoordinateKind::lon ? east : north;
}

// True if the units are degrees in the direction of the marks.
bool has_unit(const DirectionMarks& marks, const std::string& units) {
  const std::string lower = formats::lower_case(formats::without_blanks(units));
  return std::ranges::find(marks.units, lower) != marks.units.end();
}

// True if both variables have the same dimensions, in any order.
bool has_same_dimensions(const VariableHeader& a, const VariableHeader& b) {
  return a.dimensions.size() == b.dimensions.size() &&
         std::ranges::is_permutation(a.dimensions, b.dimensions);
}

// Searches the pairs of longitudes and latitudes among variables.
class CoordinateSearch {
 public:
  // Takes the variables of a file and what is asked for; `remarks` may be null. Throws InvalidInput
  // for a name in the query that no variable has.
  CoordinateSearch(std::span<const VariableHeader> variables, const CoordinateQuery& query,
                   std::vector<std::string>* remarks)
      : variables_(variables), remarks_(remarks) {
    chosen_lon_ = chosen(query.lon);
    chosen_lat_ = chosen(query.lat);
    values_ = chosen(query.values);
    for (const VariableHeader& variable : variables) {
      const bool is_asked = values_ == none || &variable == &variables[values_];
      std::vector<std::string> words = formats::words_of(variable.text("coordinates"));
      if (is_asked && words.size() > 1) lists_.push_back(std::move(words));
    }
    if (values_ != none && lists_.empty()) add_list_of_mesh();
  }

  // Returns all pairs, the best one first.
  [[nodiscard]] std::vector<CoordinatePair> pairs() const {
    std::vector<CoordinatePair> found;
    for (std::size_t lon = 0; lon < variables_.size(); ++lon) {
      const int lon_evidence = evidence_of(lon, CoordinateKind::lon);
      if (lon_evidence == 0) continue;
      for (std::size_t lat = 0; lat < variables_.size(); ++lat) {
        const int lat_evidence = lat == lon ? 0 : evidence_of(lat, CoordinateKind::lat);
        if (lat_evidence == 0 || !belong_together(lon, lat)) continue;
        found.push_back(pair_of(lon, lat, std::min(lon_evidence, lat_evidence)));
      }
    }
    // Which pairs are crossed, or true places beside nominal axes, is only known when all of them
    // are.
    prefer_true_places(found);
    for (CoordinatePair& pair : found) {
      if (!is_crossed(pair, found)) pair.rank += rank_of_uncrossed;
    }
    std::ranges::stable_sort(found, std::ranges::greater(), &CoordinatePair::rank);
    return found;
  }

  // Adds a sentence for each longitude or latitude that an attribute `coordinates` names and that
  // the file does not have: other coordinates are then read in its place.
  void remark_missing_coordinates() const {
    std::vector<std::string> missing;
    for (const VariableHeader& variable : variables_) {
      for (const std::string& word : formats::words_of(variable.text("coordinates"))) {
        const bool is_place = formats::is_name_of_places(word, CoordinateKind::lon) ||
                              formats::is_name_of_places(word, CoordinateKind::lat);
        if (!is_place || find(word) != none || std::ranges::count(missing, word) != 0) continue;
        missing.push_back(word);
        remarks_->push_back("there is no variable '" + word +
                            "', which the attribute coordinates of '" + variable.name + "' names");
      }
    }
  }

  // Adds a sentence for each coordinate whose bounds are missing.
  void remark_missing_bounds(const CoordinatePair& pair) const {
    for (const std::size_t coordinate : {pair.lon, pair.lat}) {
      const std::string name = variables_[coordinate].text("bounds");
      if (remarks_ == nullptr || name.empty() || find(name) != none) continue;
      const std::string text = "there is no variable '" + name +
                               "', which the attribute bounds of '" + variables_[coordinate].name +
                               "' names";
      if (std::ranges::count(*remarks_, text) == 0) remarks_->push_back(text);
    }
  }

 private:
  // Adds the coordinates of the nodes, edges or faces that the variable is on, by UGRID.
  void add_list_of_mesh() {
    const std::size_t topology = find(variables_[values_].text("mesh"));
    if (topology == none) return;
    const std::string attribute = variables_[values_].text("location") + "_coordinates";
    lists_.push_back(formats::words_of(variables_[topology].text(attribute)));
  }

  // True if the names of both differ only in that one means longitudes and the other latitudes.
  [[nodiscard]] bool are_partners(const CoordinatePair& pair) const {
    return formats::are_partners(variables_[pair.lon].name, variables_[pair.lat].name);
  }

  // True if both have a partner, and not each other: ULONG and TLAT, where there are TLONG and
  // ULAT.
  [[nodiscard]] bool is_crossed(const CoordinatePair& pair,
                                const std::vector<CoordinatePair>& all) const {
    if (are_partners(pair)) return false;
    const auto has = [&](std::size_t CoordinatePair::*kind) {
      return std::ranges::any_of(all, [&](const CoordinatePair& other) {
        return other.*kind == pair.*kind && are_partners(other);
      });
    };
    return has(&CoordinatePair::lon) && has(&CoordinatePair::lat);
  }

  // Grids that are not along axes may have nominal axes beside their longitudes and latitudes of two
  // dimensions, which are somewhere else, as north of a tripolar grid's cap. Where the axes have no
  // bounds, a pair of two dimensions gets their rank if it has a name that models give to places: a
  // field may be of degrees, too.
  void prefer_true_places(std::vector<CoordinatePair>& all) const {
    for (CoordinatePair& axes : all) {
      if (!axes.are_axes || (axes.lon_bounds != none && axes.lat_bounds != none)) continue;
      const std::vector<std::string> dimensions = {variables_[axes.lat].dimensions[0],
                                                   variables_[axes.lon].dimensions[0]};
      bool has_rival = false;
      for (CoordinatePair& pair : all) {
        if (pair.are_axes ||
            !std::ranges::is_permutation(variables_[pair.lon].dimensions, dimensions) ||
            !formats::is_name_of_places(variables_[pair.lon].name, CoordinateKind::lon) ||
            !formats::is_name_of_places(variables_[pair.lat].name, CoordinateKind::lat)) {
          continue;
        }
        pair.rank |= axes.rank & (rank_of_attributes | rank_of_standard_names | rank_of_axes);
        has_rival = true;
      }
      if (has_rival) axes.rank &= ~rank_of_axes;
    }
  }

  // Returns the index of a variable, or `none`.
  [[nodiscard]] std::size_t find(std::string_view name) const {
    const auto at = std::ranges::find(variables_, name, &VariableHeader::name);
    return at == variables_.end() ? none : static_cast<std::size_t>(at - variables_.begin());
  }
  // Returns the index of a variable that the user names. Throws InvalidInput if there is none.
  [[nodiscard]] std::size_t chosen(const std::string& name) const {
    if (name.empty()) return none;
    const std::size_t index = find(name);
    if (index == none) throw InvalidInput("there is no variable '" + name + "'", 0);
    return index;
  }

  // Returns the evidence that a variable holds longitudes, or latitudes; a named one excludes all
  // others.
  [[nodiscard]] int evidence_of(std::size_t index, CoordinateKind kind) const {
    const std::size_t asked = kind == CoordinateKind::lon ? chosen_lon_ : chosen_lat_;
    if (asked != none) return asked == index ? 2 : 0;
    if (is_bounds(variables_[index].name)) return 0;
    const int evidence = formats::coordinate_evidence(variables_[index], kind);
    // Names of corners and edges say where one variable is, and not what the cells of a file are.
    const bool is_of_part = values_ != none && evidence == 0 && variables_[index].is_number &&
                            !variables_[index].shape.empty() &&
                            formats::is_name_of_part(variables_[index].name, kind);
    return is_of_part ? 1 : evidence;
  }

  // True if a variable is the bounds of another one.
  [[nodiscard]] bool is_bounds(const std::string& name) const {
    return std::ranges::any_of(variables_, [&](const VariableHeader& other) {
      return other.text("bounds") == name || formats::is_name_of_bounds(name, other.name);
    });
  }

  // True if both variables are axes, along different dimensions.
  [[nodiscard]] bool are_axes(std::size_t lon, std::size_t lat) const {
    const VariableHeader& a = variables_[lon];
    const VariableHeader& b = variables_[lat];
    return a.dimensions.size() == 1 && b.dimensions.size() == 1 && a.dimensions != b.dimensions;
  }

  // True if two variables form a pair, along the dimensions of the values if these are given.
  [[nodiscard]] bool belong_together(std::size_t lon, std::size_t lat) const {
    if (!are_axes(lon, lat) && !has_same_dimensions(variables_[lon], variables_[lat])) return false;
    return values_ == none || (is_along_values(lon) && is_along_values(lat));
  }
  // True if all dimensions of a variable are dimensions of the values. Values without time may have
  // coordinates that are repeated along time, as WRF's HGT(south_north, west_east) has.
  [[nodiscard]] bool is_along_values(std::size_t index) const {
    const std::vector<std::string>& own = variables_[index].dimensions;
    const std::vector<std::string>& of_values = variables_[values_].dimensions;
    return std::ranges::all_of(own, [&](const std::string& name) {
      return std::ranges::count(of_values, name) != 0 || (own.size() > 1 && is_name_of_time(name));
    });
  }

  // True if an attribute `coordinates` lists both variables.
  [[nodiscard]] bool is_listed(std::size_t lon, std::size_t lat) const {
    return std::ranges::any_of(lists_, [&](const std::vector<std::string>& words) {
      return std::ranges::count(words, variables_[lon].name) != 0 &&
             std::ranges::count(words, variables_[lat].name) != 0;
    });
  }

  // Returns the bounds of a coordinate, by the attribute or by a usual name; `none` if there are
  // none.
  [[nodiscard]] std::size_t bounds_of(std::size_t coordinate) const {
    const std::size_t named = find(variables_[coordinate].text("bounds"));
    if (named != none && variables_[named].is_number) return named;
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      const bool is_larger = variables_[i].shape.size() > variables_[coordinate].shape.size() ||
                             variables_[i].name.starts_with("corner_") ||
                             variables_[i].name.ends_with("_b");
      if (variables_[i].is_number && is_larger &&
          formats::is_name_of_bounds(variables_[i].name, variables_[coordinate].name)) {
        return i;
      }
    }
    return none;
  }

  // Returns the pair with its bounds and its rank. `known_by` is the smaller coordinate_evidence()
  // of the two variables.
  [[nodiscard]] CoordinatePair pair_of(std::size_t lon, std::size_t lat, int known_by) const {
    CoordinatePair pair;
    pair.lon = lon;
    pair.lat = lat;
    pair.are_axes = are_axes(lon, lat);
    pair.lon_bounds = bounds_of(lon);
    pair.lat_bounds = bounds_of(lat);
    pair.is_listed = is_listed(lon, lat);
    if (pair.is_listed) pair.rank += rank_of_listed;
    if (known_by >= 2) pair.rank += rank_of_attributes;
    if (known_by == 3) pair.rank += rank_of_standard_names;
    if (pair.lon_bounds != none && pair.lat_bounds != none) pair.rank += rank_of_bounds;
    if (pair.are_axes) pair.rank += rank_of_axes;
    pair.is_used = is_used(pair);
    if (pair.is_used) pair.rank += rank_of_used;
    return pair;
  }

  // True if a variable other than the pair and its bounds has all dimensions of the pair.
  [[nodiscard]] bool is_used(const CoordinatePair& pair) const {
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      if (i == pair.lon || i == pair.lat || i == pair.lon_bounds || i == pair.lat_bounds) continue;
      const auto has = [&](const std::string& name) {
        return std::ranges::count(variables_[i].dimensions, name) != 0;
      };
      if (std::ranges::all_of(variables_[pair.lon].dimensions, has) &&
          std::ranges::all_of(variables_[pair.lat].dimensions, has)) {
        return true;
      }
    }
    return false;
  }

  // Numbers of variables are indices into `variables_`; `none` stands for a name that was not
  // given.
  std::span<const VariableHeader> variables_;
  std::vector<std::string>* remarks_;
  std::size_t chosen_lon_ = none;
  std::size_t chosen_lat_ = none;
  std::size_t values_ = none;
  // The words of each attribute `coordinates` that has several.
  std::vector<std::vector<std::string>> lists_;
};

}  // namespace

namespace formats {

int coordinate_evidence(const VariableHeader& variable, CoordinateKind kind) {
  if (!variable.is_number || variable.shape.empty() || is_rotated_or_projected(variable)) return 0;
  const DirectionMarks& marks = marks_of(kind);
  const std::string standard_name = variable.text("standard_name");
  if (standard_name == marks.standard_name) return 3;
  const std::string units = variable.text("units");
  if (has_unit(marks, units) || variable.text("_CoordinateAxisType") == marks.axis_type) return 2;
  // A standard_name or units that say something else outweigh the name of the variable.
  const bool is_denied =
      !standard_name.empty() ||
      (!formats::without_blanks(units).empty() && !degrees_per_unit(units)) ||
      has_unit(marks_of(kind == CoordinateKind::lon ? CoordinateKind::lat : CoordinateKind::lon),
               units);
  return !is_denied && formats::is_known_name(variable.name, kind) ? 1 : 0;
}

std::string remark_on_units(std::span<const VariableHeader> variables) {
  std::string remark;
  for (const VariableHeader& variable : variables) {
    if (is_rotated_or_projected(variable)) remark += "; " + remark_on_rotation(variable);
    const std::string units = variable.text("units");
    const bool is_called_so = is_known_name(variable.name, CoordinateKind::lon) ||
                              is_known_name(variable.name, CoordinateKind::lat);
    if (!is_called_so || without_blanks(units).empty() || degrees_per_unit(units)) continue;
    remark += "; '" + variable.name + "' has the units '" + units +
              "', which are neither degrees nor radians";
  }
  return remark;
}

}  // namespace formats

std::string VariableHeader::text(std::string_view attribute) const {
  const auto at = std::ranges::find(texts, attribute, &std::pair<std::string, std::string>::first);
  return at == texts.end() ? std::string() : at->second;
}

std::vector<CoordinatePair> find_coordinates(std::span<const VariableHeader> variables,
                                             const CoordinateQuery& query,
                                             std::vector<std::string>* remarks) {
  const CoordinateSearch search(variables, query, remarks);
  std::vector<CoordinatePair> pairs = search.pairs();
  for (const CoordinatePair& pair : pairs) search.remark_missing_bounds(pair);
  if (remarks != nullptr) search.remark_missing_coordinates();
  return pairs;
}

std::vector<CoordinatePair> coordinates_of(std::span<const VariableHeader> variables,
                                           std::size_t variable) {
  if (variable >= variables.size()) {
    throw InvalidInput("there is no variable " + std::to_string(variable), variable);
  }
  std::vector<CoordinatePair> pairs =
      find_coordinates(variables, {{}, {}, variables[variable].name});
  const auto is_part = [&](const CoordinatePair& pair) {
    return pair.lon == variable || pair.lat == variable;
  };
  // A coordinate is at the places of its own pairs. For other variables an attribute `coordinates`
  // excludes all pairs that it does not list.
  if (std::ranges::any_of(pairs, is_part)) {
    std::erase_if(pairs, [&](const CoordinatePair& pair) { return !is_part(pair); });
  } else if (std::ranges::any_of(pairs, &CoordinatePair::is_listed)) {
    std::erase_if(pairs, [](const CoordinatePair& pair) { return !pair.is_listed; });
  }
  return pairs;
}

std::vector<bool> repeated_dimensions(std::span<const std::string> names,
                                      std::span<const std::uint64_t> shape,
                                      std::span<const double> lon, std::span<const double> lat) {
  std::uint64_t size = 1;
  for (const std::uint64_t length : shape) size *= length;
  if (lon.size() != size || lat.size() != size || names.size() != shape.size()) {
    throw InvalidInput(std::to_string(lon.size()) + " longitudes and " +
                           std::to_string(lat.size()) + " latitudes are not " +
                           std::to_string(size),
                       0);
  }
  std::vector<bool> repeated(shape.size(), false);
  if (shape.size() < 2) return repeated;
  const auto is_same = [](double a, double b) { return a == b || (a != a && b != b); };
  std::size_t stride = size;
  std::size_t num_kept = shape.size();
  for (std::size_t d = 0; d < shape.size(); ++d) {
    // The number of values for one index of the dimensions before this one.
    const std::size_t block = stride;
    stride = shape[d] == 0 ? 0 : block / shape[d];
    const bool is_time = is_name_of_time(names[d]);
    // One dimension is always kept, and so is one of length 1 that is not called time.
    if (shape[d] == 0 || (shape[d] == 1 && !is_time) || num_kept == 1) continue;
    bool changes = false;
    for (std::size_t i = 0; i < size && !changes; ++i) {
      // This is the value at index 0 of dimension d, and the same indices of the others.
      const std::size_t first = i - i % block + i % stride;
      changes = !is_same(lon[i], lon[first]) || !is_same(lat[i], lat[first]);
    }
    if (changes && is_time && shape.size() > 2) {
      throw InvalidInput("longitudes and latitudes change along '" + names[d] + "'", d);
    }
    repeated[d] = !changes;
    if (!changes) --num_kept;
  }
  return repeated;
}

}  // namespace rondel
