// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "column_values.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string_view>

#include "command.h"

namespace rondel::cli {

std::vector<double> column_values(const SiteTable& table, const std::string& name,
                                  const std::string& option) {
  const auto column = std::ranges::find(table.columns, name, &Column::name);
  if (column == table.columns.end()) {
    throw UsageError(option + ": " + table.name + " has no column '" + name + "'");
  }
  if (!column->is_numeric)
    throw UsageError(option + ": column '" + name + "' has other cells than numbers");
  std::vector<double> values;
  std::uint64_t begin = 0;
  for (const std::uint64_t end : column->ends) {
    const std::string_view cell = std::string_view(column->text).substr(begin, end - begin);
    double value = std::numeric_limits<double>::quiet_NaN();
    std::from_chars(cell.data(), cell.data() + cell.size(), value);
    values.push_back(value);
    begin = end;
  }
  return values;
}

}  // namespace rondel::cli
