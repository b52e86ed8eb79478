// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Implements field_choice.h: tells "tas[3]" (a position along each leading dimension) and
// "tas_2001-07-15" (the name of a column) from names of variables, and reads the positions.
#include "formats/field_choice.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <functional>

#include "io/bad_value.h"
#include "io/netcdf_groups.h"
#include "io/number.h"

namespace rondel::formats {

std::size_t number_of_field(const FieldArray& several, std::string_view places) {
  std::string meant = several.name;
  meant += places;
  std::string lengths;
  for (std::size_t d = 0; d < several.shape.size(); ++d) {
    lengths +=
        (d == 0 ? "" : ", ") + several.dimensions[d] + " " + std::to_string(several.shape[d]);
  }
  const io::BadValue bad(io::in_quotes(meant) + " is no field of variable " +
                         io::in_quotes(several.name) + ", which has those of " + lengths);
  // The number counts the positions as in an array in C order, the last dimension fastest.
  std::size_t number = 0;
  for (const std::uint64_t& length : several.shape) {
    places.remove_prefix(1);  // a bracket or a comma
    places.remove_prefix(std::min(places.find_first_not_of(' '), places.size()));
    std::int64_t place = 0;
    const char* const end = places.data() + places.size();
    const auto [after, error] = std::from_chars(places.data(), end, place);
    if (place < 0) place += static_cast<std::int64_t>(length);
    if (error != std::errc() || after == end || place < 0 ||
        static_cast<std::uint64_t>(place) >= length) {
      throw bad;
    }
    number = number * static_cast<std::size_t>(length) + static_cast<std::size_t>(place);
    places.remove_prefix(static_cast<std::size_t>(after - places.data()));
    const bool is_last = &length == &several.shape.back();
    if (is_last ? places != "]" : !places.starts_with(',')) throw bad;
  }
  return number;
}

std::vector<const io::VariableInFile*> meant_variables(const io::NetcdfReader& file,
                                                       const std::string& name) {
  std::vector<const io::VariableInFile*> beginnings;
  for (const io::VariableInFile& variable : file.variables()) {
    const std::size_t length = variable.name.size();
    const bool is_meant = name.starts_with(variable.name) &&
                          (length == name.size() || name[length] == '[' || name[length] == '_');
    if (is_meant) beginnings.push_back(&variable);
  }
  std::ranges::sort(beginnings, std::ranges::greater(),
                    [](const io::VariableInFile* variable) { return variable->name.size(); });
  return beginnings;
}

std::vector<const io::VariableInFile*> variables_to_read(const io::NetcdfReader& file,
                                                         std::span<const std::string> names) {
  std::vector<const io::VariableInFile*> variables;
  for (const std::string& given : names) {
    const std::string name = io::full_name(file.variables(), given);
    const std::vector<const io::VariableInFile*> meant = meant_variables(file, name);
    if (!meant.empty()) variables.push_back(meant.front());
  }
  if (!names.empty()) return variables;
  for (const io::VariableInFile& variable : file.variables()) {
    if (!variable.shape.empty()) variables.push_back(&variable);
  }
  return variables;
}

}  // namespace rondel::formats
