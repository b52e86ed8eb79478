// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "field_facts.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "rondel/error.h"

namespace rondel::cli {
namespace {

using FieldJson = nlohmann::ordered_json;

// Returns the text of an attribute; empty if the array has none of this name.
std::string_view attribute_of(const FieldArray& array, std::string_view name) {
  const auto found =
      std::ranges::find(array.attributes, name, &std::pair<std::string, std::string>::first);
  return found == array.attributes.end() ? std::string_view() : std::string_view(found->second);
}

// Returns "tas [K] (time 12, level 3)".
std::string text_of(const FieldArray& array) {
  std::string text = array.name;
  if (const std::string_view units = attribute_of(array, "units"); !units.empty()) {
    text.append(" [").append(units).append("]");
  }
  return array.dimensions.empty() ? text : text + " (" + array.lengths_in_words() + ')';
}

// Returns "time: 0 to 330, 12 of them [days since 2000-01-01]"; an empty text for an axis of texts.
std::string line_of_axis(const FieldArray& axis) {
  if (axis.values.empty()) return {};
  char numbers[128];
  std::snprintf(numbers, sizeof numbers, "%.9g to %.9g, %zu of them", axis.values.front(),
                axis.values.back(), axis.values.size());
  std::string line = axis.name + ": " + numbers;
  if (const std::string_view units = attribute_of(axis, "units"); !units.empty()) {
    line.append(" [").append(units).append("]");
  }
  return line + '\n';
}

FieldJson json_of(const FieldArray& array) {
  return {{"name", array.name},
          {"dimensions", array.dimensions},
          {"shape", array.shape},
          {"units", attribute_of(array, "units")},
          {"long_name", attribute_of(array, "long_name")}};
}

}  // namespace

std::string lines_of_fields(const FieldSet& fields) {
  std::string text;
  if (fields.shape.size() == 2) {
    text +=
        "grid: " + std::to_string(fields.shape[0]) + " x " + std::to_string(fields.shape[1]) + '\n';
  }
  for (const FieldArray& array : fields.arrays) {
    text += (&array == fields.arrays.data() ? "fields: " : ", ") + text_of(array);
  }
  if (!fields.arrays.empty()) text += '\n';
  for (const FieldArray& axis : fields.axes) text += line_of_axis(axis);
  for (const std::string& remark : fields.remarks) text += "remark: " + remark + '\n';
  return text;
}

void add_facts_of(const FieldSet& fields, nlohmann::ordered_json& json) {
  FieldJson arrays = FieldJson::array();
  for (const FieldArray& array : fields.arrays) arrays.push_back(json_of(array));
  FieldJson axes = FieldJson::array();
  for (const FieldArray& axis : fields.axes) {
    axes.push_back(json_of(axis));
    if (axis.values.empty()) continue;
    axes.back()["first"] = axis.values.front();
    axes.back()["last"] = axis.values.back();
  }
  json["grid"] = fields.shape;
  json["fields"] = std::move(arrays);
  json["axes"] = std::move(axes);
  json["remarks"] = fields.remarks;
}

std::string first_field_of(const FieldSet& fields) {
  if (fields.arrays.empty()) return {};
  const FieldArray& array = fields.arrays.front();
  for (std::size_t d = 0; d < array.shape.size(); ++d) {
    if (array.shape[d] == 0) return {};
  }
  std::string name = array.name;
  if (array.num_fields() == 1) return name;
  for (std::size_t d = 0; d < array.shape.size(); ++d) name += d == 0 ? "[0" : ",0";
  return name + ']';
}

std::optional<FieldSet> fields_elsewhere(const FileName& file, const SiteTable& table) {
  const auto fields_at = [&](std::size_t num_points, const WantedPlaces& places) {
    try {
      return std::optional(FieldFile(file, {}, num_points, {}, {}, places).fields());
    } catch (const FileError&) {
      return std::optional<FieldSet>();  // it has none
    }
  };
  if (table.sites.empty() || fields_at(table.sites.size(), {table.positions})) return std::nullopt;
  return fields_at(0, {});
}

}  // namespace rondel::cli
