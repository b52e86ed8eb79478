// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Decides whether a file says of two variables that they are no components of the same vectors:
// lack_of_vectors() of rondel/conventions.h. Directions are words of standard names (CF 1.11, appendix
// on the construction of standard names), and units are compared as products of powers.
//
// in    names, standard names and units of two variables
// out   why they are no components, or nothing
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/cf_names.h"
#include "rondel/conventions.h"

namespace rondel {
namespace {

constexpr std::array<std::string_view, 3> to_east = {"eastward", "zonal", "u"};
constexpr std::array<std::string_view, 3> to_north = {"northward", "meridional", "v"};

std::vector<std::string> words_of_standard_name(std::string text) {
  std::ranges::replace(text, '_', ' ');
  return formats::words_of(text);
}

// True for a text that may be a standard name with several words.
bool is_standard_name(const std::string& text) {
  return text.find('_') != std::string::npos && text.find(' ') == std::string::npos;
}

// Replaces all occurrences of a text.
std::string replaced(std::string text, std::string_view old, std::string_view by) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at)) {
    text.replace(at, old.size(), by);
    at += by.size();
  }
  return text;
}

// Units as powers of their parts: "m s-1", "m/s", "m.s^-1" and "meters per second" are the same.
class UnitPowers {
 public:
  explicit UnitPowers(std::string text) {
    text = replaced(replaced(std::move(text), "**", "^"), "/", " / ");
    for (const char sign : {'*', '(', ')'}) std::ranges::replace(text, sign, ' ');
    // A point multiplies, unless it is that of a number.
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
      const bool is_in_number = text[i + 1] >= '0' && text[i + 1] <= '9';
      if (text[i] == '.' && !is_in_number) text[i] = ' ';
    }
    bool is_divided = false;
    for (const std::string& word : formats::words_of(text)) {
      const bool is_slash = word == "/" || word == "per";
      if (!is_slash) add(word, is_divided);
      is_divided = is_slash;
    }
  }
  bool operator==(const UnitPowers&) const = default;

 private:
  // Adds one part with its power, as "s-1" or "s^2".
  void add(std::string part, bool is_divided) {
    const std::size_t end = part.find_first_of("^+-0123456789");
    int power = 1;
    if (end != std::string::npos && end > 0) {
      std::string_view digits = std::string_view(part).substr(end);
      while (digits.starts_with('^') || digits.starts_with('+')) digits.remove_prefix(1);
      const char* const last = digits.data() + digits.size();
      const auto [after, error] = std::from_chars(digits.data(), last, power);
      if (error == std::errc() && after == last) {
        part.resize(end);
      } else {
        power = 1;  // the whole part is a name
      }
    }
    if (part == "1") return;
    const std::string name = in_short(part);
    powers_[name] += is_divided ? -power : power;
    if (powers_[name] == 0) powers_.erase(name);
  }
  // Returns the symbol of a unit that is written out.
  static std::string in_short(const std::string& part) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 12> symbols = {
        {{"meter", "m"},
         {"metre", "m"},
         {"kilometer", "km"},
         {"kilometre", "km"},
         {"second", "s"},
         {"sec", "s"},
         {"hour", "h"},
         {"hr", "h"},
         {"kilogram", "kg"},
         {"newton", "N"},
         {"pascal", "Pa"},
         {"day", "d"}}};
    std::string name = formats::lower_case(part);
    if (name.size() > 2 && name.ends_with('s')) name.pop_back();
    for (const auto& [whole, symbol] : symbols) {
      if (name == whole) return std::string(symbol);
    }
    return part;
  }

  std::map<std::string, int> powers_;
};

// The quantity that a standard name gives without its direction, and what is wrong with the direction.
struct NamedDirectionOf {
  std::string quantity;
  std::string why_not;
};

NamedDirectionOf direction_in(const VectorComponent& component, bool is_east, bool is_along_axes) {
  const auto& own = is_east ? to_east : to_north;
  const std::string_view along_grid = is_east ? "x" : "y";
  NamedDirectionOf found;
  bool has_direction = false;
  bool is_of_grid = false;
  for (const std::string& word : words_of_standard_name(component.standard_name)) {
    const bool is_own = std::ranges::count(own, word) != 0 || (is_along_axes && word == along_grid);
    has_direction = has_direction || is_own;
    is_of_grid = is_of_grid || word == "grid";
    found.quantity += is_own ? "* " : word + " ";
  }
  if (is_of_grid || !has_direction) {
    found.why_not = "'" + component.name + "' has the standard_name '" + component.standard_name +
                    "', which is no " + (is_east ? "eastward" : "northward") + " component";
  }
  return found;
}

}  // namespace

std::string lack_of_vectors(const VectorComponent& east, const VectorComponent& north,
                            bool is_along_axes) {
  std::vector<std::string> quantities;
  for (const VectorComponent* const component : {&east, &north}) {
    if (component->has_flags) {
      return "'" + component->name + "' has flags, whose values stand for categories";
    }
    if (!is_standard_name(component->standard_name)) continue;
    NamedDirectionOf named = direction_in(*component, component == &east, is_along_axes);
    if (!named.why_not.empty()) return named.why_not;
    quantities.push_back(std::move(named.quantity));
  }
  if (quantities.size() == 2 && quantities[0] != quantities[1]) {
    return "'" + east.name + "' and '" + north.name + "' have the standard_names '" +
           east.standard_name + "' and '" + north.standard_name + "', which are different vectors";
  }
  const bool have_units =
      !formats::without_blanks(east.units).empty() && !formats::without_blanks(north.units).empty();
  if (have_units && UnitPowers(east.units) != UnitPowers(north.units)) {
    return "'" + east.name + "' has the units '" + east.units + "', and '" + north.name + "' '" +
           north.units + "'";
  }
  return {};
}

}  // namespace rondel
