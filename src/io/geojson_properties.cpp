// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/geojson_properties.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace rondel::io {
namespace {

std::string json_string(std::string_view text) { return nlohmann::json(text).dump(); }

}  // namespace

std::vector<std::string> property_keys(std::span<const Column> columns,
                                       std::set<std::string> taken) {
  std::vector<std::string> keys;
  for (const Column& column : columns) {
    std::string name = column.name;
    while (!taken.insert(name).second) name += '_';
    std::string key = ",";
    key += json_string(name);
    key += ':';
    keys.push_back(std::move(key));
  }
  return keys;
}

void append_value(std::string& out, const Column& column, std::size_t row) {
  const std::uint64_t start = row == 0 ? 0 : column.ends[row - 1];
  const std::string_view text =
      std::string_view(column.text).substr(start, column.ends[row] - start);
  if (text.empty()) {
    out += "null";
  } else if (column.is_numeric || (!column.is_number.empty() && column.is_number[row])) {
    out += text;
  } else {
    out += json_string(text);
  }
}

}  // namespace rondel::io
