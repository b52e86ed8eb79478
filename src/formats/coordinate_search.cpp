// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Pairs the longitudes and latitudes that belong together: CF 1.11, sections 4.1, 4.2, 5 and 7.1. The
// constructor finds the variables that may be coordinates. A question about the values of one
// variable then looks only at those along its dimensions, and a pair keeps what is known of it.
#include "formats/coordinate_search.h"

#include <algorithm>
#include <string>

#include "rondel/error.h"

namespace rondel::formats {
namespace {

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

// True if both variables have the same dimensions, in any order.
bool has_same_dimensions(const VariableHeader& a, const VariableHeader& b) {
  return a.dimensions.size() == b.dimensions.size() &&
         std::ranges::is_permutation(a.dimensions, b.dimensions);
}

// True if one of the attributes `coordinates` lists both names.
bool are_listed(const std::vector<std::vector<std::string>>& lists, const std::string& lon,
                const std::string& lat) {
  return std::ranges::any_of(lists, [&](const std::vector<std::string>& words) {
    return std::ranges::count(words, lon) != 0 && std::ranges::count(words, lat) != 0;
  });
}

}  // namespace

CoordinateSearch::CoordinateSearch(std::span<const VariableHeader> variables)
    : variables_(variables), index_(variables) {
  for (const VariableHeader& variable : variables) {
    std::string bounds = variable.text("bounds");
    if (bounds.empty()) continue;
    if (coordinate_evidence(variable, CoordinateKind::lon) == 0 &&
        coordinate_evidence(variable, CoordinateKind::lat) == 0) {
      bounds_of_others_.insert(bounds);
    }
    named_bounds_.insert(std::move(bounds));
  }
  for (const CoordinateKind kind : {CoordinateKind::lon, CoordinateKind::lat}) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const VariableHeader& variable = variables[i];
      int evidence = coordinate_evidence(variable, kind);
      const bool is_of_part = evidence == 0 && variable.is_number && !variable.shape.empty() &&
                              is_name_of_part(variable.name, kind);
      if (is_of_part) evidence = 1;
      if (evidence == 0 || is_bounds(variable.name)) continue;
      (kind == CoordinateKind::lon ? lons_ : lats_).push_back({i, evidence, is_of_part});
    }
  }
}

std::size_t CoordinateSearch::chosen(const std::string& name) const {
  if (name.empty()) return none;
  const std::size_t found = index_.find(name);
  if (found == none) throw InvalidInput("there is no variable '" + name + "'", 0);
  return found;
}

// Without values the attributes `coordinates` of all variables count; equal ones do so once. Values
// without the attribute have the coordinates of the nodes, edges or faces that they are on, by UGRID.
CoordinateSearch::KnownQuery CoordinateSearch::question_of(const CoordinateQuery& query) const {
  KnownQuery question{chosen(query.lon), chosen(query.lat), chosen(query.values)};
  const auto add = [&](const std::string& text) {
    std::vector<std::string> words = words_of(text);
    if (words.size() > 1) question.lists.push_back(std::move(words));
  };
  if (question.values == none) {
    std::set<std::string> texts;
    for (const VariableHeader& variable : variables_) texts.insert(variable.text("coordinates"));
    std::ranges::for_each(texts, add);
    return question;
  }
  const VariableHeader& values = variables_[question.values];
  add(values.text("coordinates"));
  const std::size_t topology = index_.find(values.text("mesh"));
  if (question.lists.empty() && topology != none) {
    add(variables_[topology].text(values.text("location") + "_coordinates"));
  }
  return question;
}

// A variable that the user names excludes all others.
std::vector<CoordinateSearch::MaybeCoordinate> CoordinateSearch::candidates(
    const KnownQuery& question, CoordinateKind kind) const {
  const std::size_t asked = kind == CoordinateKind::lon ? question.lon : question.lat;
  std::vector<MaybeCoordinate> all;
  if (asked != none) {
    all.push_back({asked, 2, false});
  } else {
    all = kind == CoordinateKind::lon ? lons_ : lats_;
  }
  std::erase_if(all, [&](const MaybeCoordinate& candidate) {
    return question.values == none ? candidate.is_of_part
                                   : !is_along(candidate.index, question.values);
  });
  return all;
}

std::vector<CoordinatePair> CoordinateSearch::pairs(const CoordinateQuery& query,
                                                    std::vector<std::string>* remarks) {
  const KnownQuery question = question_of(query);
  const std::vector<MaybeCoordinate> lats = candidates(question, CoordinateKind::lat);
  std::vector<CoordinatePair> found;
  for (const MaybeCoordinate& lon : candidates(question, CoordinateKind::lon)) {
    for (const MaybeCoordinate& lat : lats) {
      if (lat.index == lon.index ||
          !(are_axes(lon.index, lat.index) ||
            has_same_dimensions(variables_[lon.index], variables_[lat.index]))) {
        continue;
      }
      CoordinatePair pair = known_pair(lon.index, lat.index);
      pair.is_listed =
          are_listed(question.lists, variables_[lon.index].name, variables_[lat.index].name);
      const int known_by = std::min(lon.evidence, lat.evidence);
      if (pair.is_listed) pair.rank += rank_of_listed;
      if (known_by >= 2) pair.rank += rank_of_attributes;
      if (known_by == 3) pair.rank += rank_of_standard_names;
      found.push_back(pair);
    }
  }
  // Which pairs are crossed, or true places beside nominal axes, is only known when all of them
  // are.
  prefer_true_places(found);
  prefer_uncrossed(found);
  std::ranges::stable_sort(found, std::ranges::greater(), &CoordinatePair::rank);
  if (remarks != nullptr) {
    for (const CoordinatePair& pair : found) remark_missing_bounds(pair, *remarks);
    remark_missing_coordinates(*remarks);
  }
  return found;
}

std::vector<CoordinatePair> CoordinateSearch::pairs_of(std::size_t variable) {
  if (variable >= variables_.size()) {
    throw InvalidInput("there is no variable " + std::to_string(variable), variable);
  }
  std::vector<CoordinatePair> found = pairs({{}, {}, variables_[variable].name});
  const auto is_part = [&](const CoordinatePair& pair) {
    return pair.lon == variable || pair.lat == variable;
  };
  // A coordinate is at the places of its own pairs. For other variables an attribute `coordinates`
  // excludes all pairs that it does not list.
  if (std::ranges::any_of(found, is_part)) {
    std::erase_if(found, [&](const CoordinatePair& pair) { return !is_part(pair); });
  } else if (std::ranges::any_of(found, &CoordinatePair::is_listed)) {
    std::erase_if(found, [](const CoordinatePair& pair) { return !pair.is_listed; });
  }
  return found;
}

bool CoordinateSearch::are_partners(const CoordinatePair& pair) const {
  return formats::are_partners(variables_[pair.lon].name, variables_[pair.lat].name);
}

// A pair is crossed if both have a partner, and not each other: ULONG and TLAT, where there are TLONG
// and ULAT.
void CoordinateSearch::prefer_uncrossed(std::vector<CoordinatePair>& all) const {
  std::set<std::size_t> lons;  // those with a partner
  std::set<std::size_t> lats;
  std::vector<bool> are_own;
  for (const CoordinatePair& pair : all) {
    are_own.push_back(are_partners(pair));
    if (!are_own.back()) continue;
    lons.insert(pair.lon);
    lats.insert(pair.lat);
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool is_crossed = !are_own[k] && lons.contains(all[k].lon) && lats.contains(all[k].lat);
    if (!is_crossed) all[k].rank += rank_of_uncrossed;
  }
}

// Grids that are not along axes may have nominal axes beside their longitudes and latitudes of two
// dimensions, which are somewhere else, as north of a tripolar grid's cap. Where the axes have no
// bounds, a pair of two dimensions gets their rank if it has a name that models give to places: a
// field may be of degrees, too.
void CoordinateSearch::prefer_true_places(std::vector<CoordinatePair>& all) const {
  std::vector<std::size_t> rivals;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool is_rival = !all[k].are_axes && variables_[all[k].lon].dimensions.size() == 2 &&
                          is_name_of_places(variables_[all[k].lon].name, CoordinateKind::lon) &&
                          is_name_of_places(variables_[all[k].lat].name, CoordinateKind::lat);
    if (is_rival) rivals.push_back(k);
  }
  if (rivals.empty()) return;
  for (CoordinatePair& axes : all) {
    if (!axes.are_axes || (axes.lon_bounds != none && axes.lat_bounds != none)) continue;
    const std::vector<std::string> dimensions = {variables_[axes.lat].dimensions[0],
                                                 variables_[axes.lon].dimensions[0]};
    bool has_rival = false;
    for (const std::size_t k : rivals) {
      if (!std::ranges::is_permutation(variables_[all[k].lon].dimensions, dimensions)) continue;
      all[k].rank |= axes.rank & (rank_of_attributes | rank_of_standard_names | rank_of_axes);
      has_rival = true;
    }
    if (has_rival) axes.rank &= ~rank_of_axes;
  }
}

// A usual name is that of a variable with an ending or a beginning more.
bool CoordinateSearch::is_bounds(std::string_view name) const {
  if (named_bounds_.contains(name)) return true;
  return std::ranges::any_of(usual_coordinates_of_bounds(name),
                             [&](std::string_view coordinate) { return index_.has(coordinate); });
}

bool CoordinateSearch::are_axes(std::size_t lon, std::size_t lat) const {
  const VariableHeader& a = variables_[lon];
  const VariableHeader& b = variables_[lat];
  return a.dimensions.size() == 1 && b.dimensions.size() == 1 && a.dimensions != b.dimensions;
}

// Values without time may have coordinates that are repeated along time, as WRF's
// HGT(south_north, west_east) has.
bool CoordinateSearch::is_along(std::size_t index, std::size_t values) const {
  const std::vector<std::string>& own = variables_[index].dimensions;
  const std::vector<std::string>& of_values = variables_[values].dimensions;
  return std::ranges::all_of(own, [&](const std::string& name) {
    return std::ranges::count(of_values, name) != 0 || (own.size() > 1 && is_name_of_time(name));
  });
}

std::size_t CoordinateSearch::bounds_of(std::size_t coordinate) const {
  const std::size_t named = index_.find(variables_[coordinate].text("bounds"));
  if (named != none && variables_[named].is_number) return named;
  std::size_t first = none;  // `none` is larger than all indices
  for (const std::string& name : usual_names_of_bounds(variables_[coordinate].name)) {
    const std::size_t i = index_.find(name);
    if (i == none || !variables_[i].is_number) continue;
    const bool is_larger = variables_[i].shape.size() > variables_[coordinate].shape.size() ||
                           name.starts_with("corner_") || name.ends_with("_b");
    if (is_larger) first = std::min(first, i);
  }
  return first;
}

bool CoordinateSearch::is_used(const CoordinatePair& pair) const {
  const auto has_all = [&](std::size_t user, std::size_t coordinate) {
    return std::ranges::all_of(variables_[coordinate].dimensions, [&](const std::string& name) {
      return std::ranges::count(variables_[user].dimensions, name) != 0;
    });
  };
  const auto is_user = [&](std::size_t i) {
    return i != pair.lon && i != pair.lat && i != pair.lon_bounds && i != pair.lat_bounds &&
           has_all(i, pair.lon) && has_all(i, pair.lat);
  };
  // The user may name coordinates of one place, which have no dimension.
  const std::vector<std::string>& dimensions = variables_[pair.lon].dimensions;
  return std::ranges::any_of(dimensions.empty() ? index_.all() : index_.along(dimensions.front()),
                             is_user);
}

const CoordinatePair& CoordinateSearch::known_pair(std::size_t lon, std::size_t lat) {
  const auto [at, is_new] = known_.try_emplace({lon, lat});
  CoordinatePair& pair = at->second;
  if (!is_new) return pair;
  pair.lon = lon;
  pair.lat = lat;
  pair.are_axes = are_axes(lon, lat);
  pair.lon_bounds = bounds_of(lon);
  pair.lat_bounds = bounds_of(lat);
  pair.is_used = is_used(pair);
  if (pair.lon_bounds != none && pair.lat_bounds != none) pair.rank += rank_of_bounds;
  if (pair.are_axes) pair.rank += rank_of_axes;
  if (pair.is_used) pair.rank += rank_of_used;
  return pair;
}

// Adds a sentence for each longitude or latitude that an attribute `coordinates` names and that the
// file does not have: other coordinates are then read in its place.
void CoordinateSearch::remark_missing_coordinates(std::vector<std::string>& remarks) const {
  std::set<std::string> missing;
  for (const VariableHeader& variable : variables_) {
    for (const std::string& word : words_of(variable.text("coordinates"))) {
      if (index_.has(word) || missing.contains(word)) continue;
      const bool is_place = is_name_of_places(word, CoordinateKind::lon) ||
                            is_name_of_places(word, CoordinateKind::lat);
      if (!is_place) continue;
      missing.insert(word);
      remarks.push_back("there is no variable '" + word +
                        "', which the attribute coordinates of '" + variable.name + "' names");
    }
  }
}

void CoordinateSearch::remark_missing_bounds(const CoordinatePair& pair,
                                             std::vector<std::string>& remarks) const {
  for (const std::size_t coordinate : {pair.lon, pair.lat}) {
    const std::string name = variables_[coordinate].text("bounds");
    if (name.empty() || index_.has(name)) continue;
    const std::string text = "there is no variable '" + name +
                             "', which the attribute bounds of '" + variables_[coordinate].name +
                             "' names";
    if (std::ranges::count(remarks, text) == 0) remarks.push_back(text);
  }
}

}  // namespace rondel::formats

namespace rondel {

std::vector<CoordinatePair> find_coordinates(std::span<const VariableHeader> variables,
                                             const CoordinateQuery& query,
                                             std::vector<std::string>* remarks) {
  return formats::CoordinateSearch(variables).pairs(query, remarks);
}

std::vector<CoordinatePair> coordinates_of(std::span<const VariableHeader> variables,
                                           std::size_t variable) {
  return formats::CoordinateSearch(variables).pairs_of(variable);
}

std::vector<std::vector<CoordinatePair>> coordinates_of(std::span<const VariableHeader> variables,
                                                        std::span<const std::size_t> wanted) {
  formats::CoordinateSearch search(variables);
  std::vector<std::vector<CoordinatePair>> pairs;
  pairs.reserve(wanted.size());
  for (const std::size_t variable : wanted) pairs.push_back(search.pairs_of(variable));
  return pairs;
}

}  // namespace rondel
