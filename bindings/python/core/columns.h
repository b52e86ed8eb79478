// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Properties of cells as the columns of a table.
#pragma once

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "rondel/io.h"

namespace rondel::python {

// A name and cells, which are texts or JSON, or empty for null.
using ColumnIn = std::tuple<std::string, std::vector<std::string>>;

inline std::vector<Column> make_columns(const std::vector<ColumnIn>& columns,
                                        bool are_json = true) {
  std::vector<Column> made;
  for (const auto& [name, cells] : columns) {
    Column column{.name = name, .is_numeric = are_json, .text = {}, .ends = {}};
    for (const std::string& cell : cells) {
      column.text += cell;
      column.ends.push_back(column.text.size());
    }
    made.push_back(std::move(column));
  }
  return made;
}

}  // namespace rondel::python
