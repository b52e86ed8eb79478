// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/written_names.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "formats/cf_names.h"

namespace rondel::formats {
namespace {

// True if the name or the units of a variable make it a longitude or latitude, or bounds of one.
bool is_like_coordinate(const VariableHeader& variable) {
  const auto is_of = [&](CoordinateKind kind, std::string_view coordinate) {
    return coordinate_evidence(variable, kind) > 0 || is_name_of_part(variable.name, kind) ||
           is_name_of_bounds(variable.name, coordinate);
  };
  return is_of(CoordinateKind::lon, "lon") || is_of(CoordinateKind::lat, "lat") ||
         is_named_like_degrees(variable);
}

}  // namespace

VariableHeader header_with(std::string name, const std::vector<io::NetcdfAttribute>& attributes) {
  VariableHeader header{
      .name = std::move(name), .dimensions = {"point"}, .shape = {1}, .texts = {}};
  for (const io::NetcdfAttribute& attribute : attributes) {
    header.texts.emplace_back(attribute.name, attribute.text);
  }
  return header;
}

void remove_marks_of_coordinates(std::vector<io::NetcdfAttribute>& attributes) {
  std::erase_if(attributes, [](const io::NetcdfAttribute& attribute) {
    return attribute.name == "cf_role" || attribute.name == "_CoordinateAxisType" ||
           (attribute.name == "standard_name" &&
            (attribute.text == "longitude" || attribute.text == "latitude"));
  });
  const VariableHeader header = header_with({}, attributes);
  if (coordinate_evidence(header, CoordinateKind::lon) == 0 &&
      coordinate_evidence(header, CoordinateKind::lat) == 0) {
    return;
  }
  const auto units = std::ranges::find(attributes, "units", &io::NetcdfAttribute::name);
  if (units != attributes.end()) units->text = "degrees";
}

std::vector<std::string> take_names_of_fields(std::vector<VariableHeader> fields,
                                              std::set<std::string>& taken) {
  for (VariableHeader& field : fields) field.name = take_name(field.name, taken);
  // A name that changes may be the one by which others are parts of a mesh. No name changes twice,
  // since those with an underscore at the end are names of no convention.
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    const std::vector<bool> parts = parts_of_grids(fields);
    for (std::size_t f = 0; f < fields.size(); ++f) {
      VariableHeader& field = fields[f];
      if (field.name.ends_with('_') || !(parts[f] || is_like_coordinate(field))) continue;
      field.name = take_name(field.name + '_', taken);
      has_changed = true;
    }
  }
  std::vector<std::string> names;
  names.reserve(fields.size());
  for (VariableHeader& field : fields) names.push_back(std::move(field.name));
  return names;
}

}  // namespace rondel::formats
