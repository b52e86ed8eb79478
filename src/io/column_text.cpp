// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/column_text.h"

#include "io/number.h"
#include "io/utf8.h"

namespace rondel::io {

Column make_column(std::string_view name) {
  if (!is_utf8(name)) throw BadValue("the name of a column is not UTF-8");
  Column column;
  column.name = name;
  column.is_numeric = true;
  return column;
}

void append_cell(Column& column, std::string_view cell) {
  if (!is_utf8(cell)) {
    throw BadValue("the text in column " + in_quotes(column.name) + " is not UTF-8");
  }
  if (column.is_numeric && !cell.empty()) column.is_numeric = is_json_number(cell);
  column.text += cell;
  column.ends.push_back(column.text.size());
}

}  // namespace rondel::io
