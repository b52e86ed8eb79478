// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the pairs of longitudes and latitudes of many variables of one file: find_coordinates() and
// coordinates_of() of rondel/conventions.h, which say by which rules. What names and attributes say
// is found once for the file, so that a question takes no time that grows with its variables.
//
// in    headers of variables, which must outlive the search; questions
// out   pairs, the best first
// index variables by their position among the headers
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/cf_names.h"
#include "formats/variable_index.h"
#include "rondel/conventions.h"

namespace rondel::formats {

// Searches the pairs of longitudes and latitudes among the variables of a file.
class CoordinateSearch {
 public:
  explicit CoordinateSearch(std::span<const VariableHeader> variables);
  CoordinateSearch(const CoordinateSearch&) = delete;  // a copy of its owner has other headers
  CoordinateSearch& operator=(const CoordinateSearch&) = delete;

  // Returns the pairs, as find_coordinates(). Throws InvalidInput for a name in the query that no
  // variable has.
  [[nodiscard]] std::vector<CoordinatePair> pairs(const CoordinateQuery& query = {},
                                                  std::vector<std::string>* remarks = nullptr);
  // Returns the pairs at which a variable may be, as coordinates_of().
  [[nodiscard]] std::vector<CoordinatePair> pairs_of(std::size_t variable);
  // True if the attribute `bounds` of a variable names this one.
  [[nodiscard]] bool are_named_bounds(std::string_view name) const {
    return named_bounds_.contains(name);
  }
  // True if that variable is neither longitudes nor latitudes.
  [[nodiscard]] bool are_bounds_of_others(std::string_view name) const {
    return bounds_of_others_.contains(name);
  }

 private:
  // A variable that may hold longitudes, or latitudes.
  struct MaybeCoordinate {
    std::size_t index;
    int evidence;     // of coordinate_evidence(), or of a name of parts
    bool is_of_part;  // of corners or edges: it counts where the coordinates of a variable are
                      // wanted, and does not say what the cells of a file are
  };
  // A query by the numbers of the variables that it names, or `none`.
  struct KnownQuery {
    std::size_t lon = CoordinatePair::none;
    std::size_t lat = CoordinatePair::none;
    std::size_t values = CoordinatePair::none;
    std::vector<std::vector<std::string>> lists = {};  // attributes `coordinates`, word by word
  };

  // Returns the question with the numbers of the variables. Throws InvalidInput for other names.
  [[nodiscard]] KnownQuery question_of(const CoordinateQuery& query) const;
  // Returns the index of a variable that the user names. Throws InvalidInput if there is none.
  [[nodiscard]] std::size_t chosen(const std::string& name) const;
  // Returns what may be the longitudes, or the latitudes, for a question.
  [[nodiscard]] std::vector<MaybeCoordinate> candidates(const KnownQuery& question,
                                                        CoordinateKind kind) const;
  // True if a variable is the bounds of another one, by an attribute or a usual name.
  [[nodiscard]] bool is_bounds(std::string_view name) const;
  // True if both variables are axes, along different dimensions.
  [[nodiscard]] bool are_axes(std::size_t lon, std::size_t lat) const;
  // True if all dimensions of a variable are dimensions of the values.
  [[nodiscard]] bool is_along(std::size_t index, std::size_t values) const;
  // Returns the bounds of a coordinate, by the attribute or by a usual name; `none` without any.
  [[nodiscard]] std::size_t bounds_of(std::size_t coordinate) const;
  // True if a variable other than the pair and its bounds has all dimensions of the pair.
  [[nodiscard]] bool is_used(const CoordinatePair& pair) const;
  // Returns the pair with its bounds and the part of its rank that no question changes.
  [[nodiscard]] const CoordinatePair& known_pair(std::size_t lon, std::size_t lat);
  // True if the names of both differ only in that one means longitudes and the other latitudes.
  [[nodiscard]] bool are_partners(const CoordinatePair& pair) const;
  // These change the ranks of pairs by what the other pairs are.
  void prefer_true_places(std::vector<CoordinatePair>& all) const;
  void prefer_uncrossed(std::vector<CoordinatePair>& all) const;
  // These add sentences on what attributes name and the file does not have.
  void remark_missing_bounds(const CoordinatePair& pair, std::vector<std::string>& remarks) const;
  void remark_missing_coordinates(std::vector<std::string>& remarks) const;

  std::span<const VariableHeader> variables_;
  VariableIndex index_;
  std::set<std::string, std::less<>> named_bounds_;
  std::set<std::string, std::less<>> bounds_of_others_;
  std::vector<MaybeCoordinate> lons_;
  std::vector<MaybeCoordinate> lats_;
  std::map<std::pair<std::size_t, std::size_t>, CoordinatePair> known_;
};

}  // namespace rondel::formats
