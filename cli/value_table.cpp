// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "value_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>

#include "query_job.h"

namespace rondel::cli {
namespace {

void append_number(std::string& text, double value) {
  std::array<char, 32> buffer{};
  text.append(buffer.data(),
              std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
}

void append_numbers(std::string& text, std::initializer_list<double> values, char separator) {
  for (const double& value : values) {
    if (&value != values.begin()) text += separator;
    append_number(text, value);
  }
}

}  // namespace

std::size_t ValueColumn::num_missing() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(values, [](double value) { return std::isnan(value); }));
}

std::string table_of(const SiteTable& targets, const std::vector<ValueColumn>& columns,
                     char separator) {
  std::string text = targets.is_lonlat() ? std::string("lon") + separator + "lat"
                                         : std::string("x") + separator + "y" + separator + "z";
  for (const ValueColumn& column : columns) {
    text += separator;
    append_field(text, column.name, separator);
  }
  text += '\n';
  for (std::size_t i = 0; i < targets.sites.size(); ++i) {
    if (targets.is_lonlat()) {
      append_numbers(text, {targets.positions[i].lon_deg, targets.positions[i].lat_deg}, separator);
    } else {
      append_numbers(text, {targets.sites[i].x, targets.sites[i].y, targets.sites[i].z}, separator);
    }
    for (const ValueColumn& column : columns) {
      text += separator;
      if (!std::isnan(column.values[i])) append_number(text, column.values[i]);
    }
    text += '\n';
  }
  return text;
}

void write_array(const std::string& path, const std::vector<ValueColumn>& columns,
                 std::vector<std::uint64_t> shape) {
  std::vector<double> all;
  for (const ValueColumn& column : columns)
    all.insert(all.end(), column.values.begin(), column.values.end());
  if (columns.size() > 1) shape.insert(shape.begin(), columns.size());
  write_numbers(path, all, shape);
}

}  // namespace rondel::cli
