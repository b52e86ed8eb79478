// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Units of angles as UDUNITS 2.2 spells them, of which CF allows those of longitudes and latitudes
// in sections 4.1 and 4.2: degrees_per_unit(). Names may be in any case and have a plural; symbols
// must match exactly.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "formats/cf_names.h"
#include "rondel/conventions.h"
#include "rondel/error.h"

namespace rondel {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

// A name of a unit, and the degrees in it.
struct UnitName {
  std::string_view singular;
  std::string_view plural;
  double degrees;
};
// Degrees to the west count negative, so that the product counts degrees to the east.
constexpr std::array unit_names = {
    UnitName{"degree", "degrees", 1},
    UnitName{"arc_degree", "arc_degrees", 1},
    UnitName{"angular_degree", "angular_degrees", 1},
    UnitName{"arcdeg", "arcdegs", 1},
    UnitName{"deg", "degs", 1},
    UnitName{"degree_north", "degrees_north", 1},
    UnitName{"degree_n", "degrees_n", 1},
    UnitName{"degreen", "degreesn", 1},
    UnitName{"degree_east", "degrees_east", 1},
    UnitName{"degree_e", "degrees_e", 1},
    UnitName{"degreee", "degreese", 1},
    UnitName{"degree_true", "degrees_true", 1},
    UnitName{"degree_t", "degrees_t", 1},
    UnitName{"degreet", "degreest", 1},
    UnitName{"degree_west", "degrees_west", -1},
    UnitName{"degree_w", "degrees_w", -1},
    UnitName{"degreew", "degreesw", -1},
    UnitName{"radian", "radians", degrees_per_radian},
    UnitName{"milliradian", "milliradians", degrees_per_radian / 1e3},
    UnitName{"microradian", "microradians", degrees_per_radian / 1e6},
    UnitName{"arc_minute", "arc_minutes", 1.0 / 60},
    UnitName{"angular_minute", "angular_minutes", 1.0 / 60},
    UnitName{"arcminute", "arcminutes", 1.0 / 60},
    UnitName{"arcmin", "arcmins", 1.0 / 60},
    UnitName{"arc_second", "arc_seconds", 1.0 / 3600},
    UnitName{"angular_second", "angular_seconds", 1.0 / 3600},
    UnitName{"arcsecond", "arcseconds", 1.0 / 3600},
    UnitName{"arcsec", "arcsecs", 1.0 / 3600},
    UnitName{"grade", "grades", 0.9},
};

// A symbol of a unit, and the degrees in it.
struct UnitSymbol {
  std::string_view symbol;
  double degrees;
};
constexpr std::array unit_symbols = {
    UnitSymbol{"rad", degrees_per_radian},
    UnitSymbol{"mrad", degrees_per_radian / 1e3},
    UnitSymbol{"urad", degrees_per_radian / 1e6},
    // This is the degree sign in UTF-8.
    UnitSymbol{"\xC2\xB0", 1},
};

}  // namespace

namespace formats {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace formats

std::optional<double> degrees_per_unit(std::string_view units) {
  const std::string_view text = formats::without_blanks(units);
  for (const UnitSymbol& unit : unit_symbols) {
    if (text == unit.symbol) return unit.degrees;
  }
  const std::string name = formats::lower_case(text);
  for (const UnitName& unit : unit_names) {
    if (name == unit.singular || name == unit.plural) return unit.degrees;
  }
  return std::nullopt;
}

// Returns the degrees in a unit of the variable; without units, those of the first relative that
// has some. Throws InvalidInput for units that are no angles, and for coordinates of a rotated pole
// or a projection.
double degrees_per_unit(const VariableHeader& variable,
                        std::span<const VariableHeader* const> relatives) {
  if (formats::is_rotated_or_projected(variable)) {
    throw InvalidInput(formats::remark_on_rotation(variable), 0);
  }
  const std::string units = variable.text("units");
  if (const std::optional<double> degrees = degrees_per_unit(units)) return *degrees;
  if (!formats::without_blanks(units).empty()) {
    throw InvalidInput(
        "units '" + units + "' of variable '" + variable.name + "' are neither degrees nor radians",
        0);
  }
  bool is_in_radians = formats::is_in_radians(variable.name);
  for (const VariableHeader* const relative : relatives) {
    if (relative == nullptr) continue;
    const bool is_first = relative == relatives.front();
    if (!formats::without_blanks(relative->text("units")).empty()) {
      const double degrees = degrees_per_unit(*relative);
      // Only the first relative is of the same kind, so only its units say that degrees count to
      // the west.
      return is_first ? degrees : std::abs(degrees);
    }
    is_in_radians = is_in_radians || (is_first && formats::is_in_radians(relative->name));
  }
  return is_in_radians ? degrees_per_radian : 1;
}

}  // namespace rondel
