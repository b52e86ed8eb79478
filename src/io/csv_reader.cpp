// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/column_text.h"
#include "io/csv_columns.h"
#include "io/csv_records.h"
#include "io/number.h"
#include "io/site_collector.h"
#include "io/site_formats.h"
#include "rondel/error.h"

namespace rondel::io {
namespace {

// Returns an upper bound: every line may be a site, and a site takes at least four bytes: "1,2\n".
std::size_t max_num_sites(std::string_view text) {
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  return std::min(lines, text.size() / 4 + 1);
}

// Throws BadValue if a record has another number of fields than the header.
void require_width(const CsvRecords& records, std::size_t header) {
  const std::size_t found = records.fields().size();
  if (found == header) return;
  std::string hint;
  if (is_comment(records.fields().front())) {
    hint = "; a table has no lines of comments";
  } else if (found == 2 * header) {
    hint = "; is the comma both delimiter and decimal point?";
  }
  throw BadValue(std::to_string(found) + (found == 1 ? " field" : " fields") +
                 " where the header has " + std::to_string(header) + hint);
}

// Returns for each column whether it has a name.
std::vector<bool> named_columns(const std::vector<std::string_view>& header) {
  std::vector<bool> is_named;
  is_named.reserve(header.size());
  for (const std::string_view name : header) is_named.push_back(!trim(name).empty());
  return is_named;
}

// Drops columns with neither a name nor a text, which a comma at the end of each line makes.
void drop_empty_columns(const std::vector<bool>& is_named, SiteTable& table) {
  std::vector<Column> kept;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    Column& column = table.columns[i];
    if (is_named[i] || !trim(column.text).empty()) kept.push_back(std::move(column));
  }
  table.columns = std::move(kept);
}

// True if all coordinates are empty.
bool lacks_place(const std::vector<std::string_view>& fields,
                 const CoordinateColumns& coordinates) {
  const std::size_t count = coordinates.is_lonlat ? 2 : 3;
  return std::all_of(coordinates.columns.begin(), coordinates.columns.begin() + count,
                     [&](std::size_t column) { return trim(fields[column]).empty(); });
}

// Reads all rows into the table.
void read_rows(CsvRecords& records, std::string_view text, const ReadJob& options,
               SiteTable& table) {
  const std::vector<std::string> names = column_names(records.fields());
  const bool has_places = !options.may_lack_places || has_coordinates(names, options);
  if (!has_places && !options.keep_columns) return;
  const CoordinateColumns coordinates =
      has_places ? find_columns(names, options) : CoordinateColumns{};
  const std::size_t width = names.size();
  require_different_names(names);
  if (options.keep_columns) {
    for (const std::string& name : names) table.columns.push_back(make_column(name));
  }
  const std::vector<bool> is_named = named_columns(records.fields());
  SiteCollector collector(table, options);
  collector.reserve(max_num_sites(text.substr(records.position())), coordinates.is_lonlat);
  const auto [a, b, c] = coordinates.columns;
  while (records.next()) {
    const auto& fields = records.fields();
    require_width(records, width);
    const bool lacks = has_places && lacks_place(fields, coordinates);
    if (lacks && !options.may_lack_places) {
      ++table.num_unlocated;
      continue;
    }
    if (!has_places || lacks) {
      collector.add_unlocated(coordinates.is_lonlat, records.line());
    } else if (coordinates.is_lonlat) {
      const double lon = parse_number(fields[a], "longitude");
      const double lat = parse_number(fields[b], "latitude");
      collector.add_position(lon, lat, records.line());
    } else {
      collector.add_point({parse_number(fields[a], "x"), parse_number(fields[b], "y"),
                           parse_number(fields[c], "z")},
                          records.line());
    }
    if (coordinates.radius) {
      collector.make_circle(parse_number(fields[*coordinates.radius], "radius"));
    }
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      append_cell(table.columns[i], fields[i]);
    }
    collector.report_progress(records.position(), text.size());
  }
  drop_empty_columns(is_named, table);
}

// Reads a table with this delimiter, or with that of the options.
void read_delimited(std::string_view bytes, char usual_delimiter, const ReadJob& options,
                    SiteTable& table) {
  const char delimiter = options.delimiter != '\0' ? options.delimiter : usual_delimiter;
  CsvRecords records({}, delimiter);
  at_line_of(records, [&] {
    const std::string_view text = table_text(bytes);
    records = CsvRecords(text, delimiter);
    if (!records.next()) throw FileError(table.name + ": the file is empty");
    read_rows(records, text, options, table);
  });
}

}  // namespace

void read_csv(std::string_view bytes, const ReadJob& options, SiteTable& table) {
  read_delimited(bytes, ',', options, table);
}

void read_tsv(std::string_view bytes, const ReadJob& options, SiteTable& table) {
  read_delimited(bytes, '\t', options, table);
}

}  // namespace rondel::io
