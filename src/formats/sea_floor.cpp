// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Units and standard_names of depths and heights of the sea floor.
#include "formats/sea_floor.h"

#include <algorithm>

#include "formats/cf_names.h"
#include "io/bad_value.h"
#include "io/number.h"

namespace rondel::formats {

std::optional<double> kilometers_of_units(std::string_view units) {
  // UDUNITS writes the symbols m and km in lower case, and files have them in capitals, too.
  const std::string text = lower_case(without_blanks(units));
  for (const std::string_view name : {"km", "kilometer", "kilometers", "kilometre", "kilometres"}) {
    if (text == name) return 1;
  }
  for (const std::string_view name : {"m", "meter", "meters", "metre", "metres"}) {
    if (text == name) return 1e-3;
  }
  return std::nullopt;
}

std::string standard_name_of(std::string_view text) {
  std::string name = lower_case(without_blanks(text));
  std::ranges::replace(name, ' ', '_');
  return name;
}

std::optional<VerticalSense> vertical_sense_of(const std::string& positive,
                                               const std::string& standard_name) {
  const std::string direction = lower_case(without_blanks(positive));
  if (direction == "up" || direction == "down") {
    return VerticalSense{direction == "up" ? mesh::Positive::up : mesh::Positive::down,
                         "its attribute positive is " + io::in_quotes(direction)};
  }
  const std::string name = standard_name_of(standard_name);
  const auto has = [&](std::string_view part) { return name.find(part) != std::string::npos; };
  const bool is_up = has("altitude") || has("height") || has("elevation");
  if (!is_up && !has("depth")) return std::nullopt;
  return VerticalSense{is_up ? mesh::Positive::up : mesh::Positive::down,
                       "its standard_name is " + io::in_quotes(standard_name)};
}

}  // namespace rondel::formats
