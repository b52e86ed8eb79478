// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the attribute cell_methods (CF 1.11, section 7.3): "time: maximum lat: lon: sum where land (comment)".
//
// in    the text, the names of dimensions of places
// out   what was done over the area of a cell, last
#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "formats/cf_names.h"
#include "rondel/conventions.h"

namespace rondel {
namespace {

// One method, and the names of what it was applied to.
struct CellMethod {
  std::vector<std::string> names;
  std::string method;
};

// Returns the words outside of parentheses, which have comments and intervals.
std::vector<std::string> words_outside(std::string_view text) {
  std::string outside;
  int depth = 0;
  for (const char c : text) {
    if (c == '(') ++depth;
    if (depth <= 0) outside += c;
    if (c == ')') --depth;
  }
  return formats::words_of(outside);
}

// Returns the methods in their order. Words after a method that end in no colon say where it holds.
std::vector<CellMethod> methods_in(std::string_view text) {
  std::vector<CellMethod> methods;
  bool is_named = false;  // true after a name, before its method
  for (std::string& word : words_outside(text)) {
    if (word.size() > 1 && word.ends_with(':')) {
      word.pop_back();
      if (!is_named) methods.emplace_back();
      methods.back().names.push_back(std::move(word));
      is_named = true;
    } else if (is_named) {
      methods.back().method = formats::lower_case(word);
      is_named = false;
    }
  }
  return methods;
}

// True for a dimension of places, or the standard_name of a coordinate of places.
bool is_of_places(const std::string& name, std::span<const std::string> places) {
  constexpr std::string_view standard_names[] = {
      "grid_longitude", "grid_latitude", "projection_x_coordinate", "projection_y_coordinate"};
  return std::ranges::count(places, name) != 0 || formats::is_dimension_of_places(name) ||
         std::ranges::count(standard_names, name) != 0;
}

// Returns the method that was applied last over the area of a cell: over `area`, the dimension of
// cells, or two dimensions of places. Empty if there is none.
std::string last_over_area(std::string_view text, std::span<const std::string> places) {
  std::string last;
  std::set<std::string> names;  // of single dimensions in turn, as in "lat: sum lon: sum"
  std::string of_names;
  for (const CellMethod& method : methods_in(text)) {
    if (method.method != of_names) names.clear();
    of_names = method.method;
    bool is_over_area = false;
    for (const std::string& name : method.names) {
      is_over_area |= name == "area" || is_name_of_cells(name) ||
                      (places.size() == 1 && name == places.front());
      if (is_of_places(name, places)) names.insert(name);
    }
    if (is_over_area || names.size() > 1) last = method.method;
  }
  return last;
}

}  // namespace

bool are_sums_over_cells(std::string_view cell_methods, std::span<const std::string> places) {
  return last_over_area(cell_methods, places) == "sum";
}

std::string with_cell_method(std::string_view cell_methods, std::string_view method,
                             std::span<const std::string> places) {
  std::string text(cell_methods);
  if (last_over_area(cell_methods, places) == method) return text;
  if (!text.empty()) text += ' ';
  return text.append("area: ").append(method);
}

}  // namespace rondel
