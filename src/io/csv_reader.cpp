// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
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

std::string_view without_bom(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    throw BadValue("the file is UTF-16, not UTF-8");
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  return bytes;
}

// Every line may be a site, and a site takes at least four bytes: "1,2\n".
std::size_t most_sites(std::string_view text) {
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  return std::min(lines, text.size() / 4 + 1);
}

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

void read_rows(CsvRecords& records, std::string_view text, const ReadJob& options,
               SiteTable& table) {
  const CoordinateColumns coordinates = find_columns(records.fields(), options);
  const std::size_t width = records.fields().size();
  if (options.keep_columns) {
    for (const auto name : records.fields()) table.columns.push_back(make_column(trim(name)));
  }
  SiteCollector collector(table, options);
  collector.reserve(most_sites(text.substr(records.position())), coordinates.is_lonlat);
  const auto [a, b, c] = coordinates.columns;
  while (records.next()) {
    const auto& fields = records.fields();
    require_width(records, width);
    if (coordinates.is_lonlat) {
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
}

void read_delimited(std::string_view bytes, char usual_delimiter, const ReadJob& options,
                    SiteTable& table) {
  const char delimiter = options.delimiter != '\0' ? options.delimiter : usual_delimiter;
  CsvRecords records({}, delimiter);
  at_line_of(records, [&] {
    const std::string_view text = without_bom(bytes);
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
