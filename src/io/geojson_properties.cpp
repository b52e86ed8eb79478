// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/geojson_properties.h"

#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace rondel::io {
namespace {

// Returns the text in quotes, with the escapes of JSON.
std::string json_string(std::string_view text) { return nlohmann::json(text).dump(); }

}  // namespace

std::vector<std::string> property_keys(std::span<const Column> columns,
                                       std::set<std::string> taken) {
  std::vector<std::string> keys;
  for (const Column& column : columns) keys.push_back(column.name);
  keys = free_names(std::move(keys), std::move(taken));
  for (std::string& key : keys) key = "," + json_string(key) + ":";
  return keys;
}

void append_value(std::string& out, const Column& column, std::size_t row) {
  const std::string_view text = column.cell(row);
  const bool is_json =
      column.is_json.empty() ? column.is_numeric || text.empty() : column.is_json[row];
  if (!is_json) {
    out += json_string(text);
  } else {
    out += text.empty() ? "null" : text;
  }
}

void append_id(std::string& out, const Column& ids, std::size_t row) {
  if (row >= ids.ends.size() || ids.cell(row).empty()) return;
  out += R"("id":)";
  out += ids.cell(row);
  out += ',';
}

}  // namespace rondel::io
