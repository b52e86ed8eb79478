// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Columns of tables: which ones hold coordinates, their cells, and tables as text.
#include <algorithm>
#include <cstdint>

#include "io/bad_value.h"
#include "io/column_text.h"
#include "io/csv_columns.h"
#include "io/csv_records.h"
#include "io/site_formats.h"
#include "unit/io/support.h"

namespace rondel::test::of_columns {
namespace {

using Names = std::vector<std::string>;

// The message of the BadValue that `action` throws, and its line where it has one; empty if it throws none.
template <class Action>
std::string refused(const Action& action) {
  try {
    action();
  } catch (const io::BadValue& bad) {
    return (bad.line() == 0 ? "" : std::to_string(bad.line()) + ": ") + bad.what();
  }
  return {};
}

// "lonlat 0 1" or "xyz 0 1 2", with " r3" for a radius; otherwise the message.
std::string columns_of(const Names& header, const ReadOptions& options = {}) {
  std::string text;
  const std::string message = refused([&] {
    const io::CoordinateColumns found = io::find_columns(header, options);
    text = found.is_lonlat ? "lonlat" : "xyz";
    for (std::size_t i = 0; i < (found.is_lonlat ? 2U : 3U); ++i) {
      text += " " + std::to_string(found.columns[i]);
    }
    if (found.radius) text += " r" + std::to_string(*found.radius);
  });
  return message.empty() ? text : message;
}

ReadOptions named(const std::string& lon, const std::string& lat) {
  ReadOptions options;
  options.lon = lon;
  options.lat = lat;
  return options;
}

TEST(csv_columns, of_values_are_those_without_coordinates) {
  const auto values = [](const Names& header, const ReadOptions& options = {}) {
    SiteTable table;
    for (const std::string& name : header) table.columns.push_back(io::make_column(name));
    return value_columns(table, options);
  };
  EXPECT_EQ(values({"id", "LON", "depth", "latitude"}), (Names{"id", "depth"}));
  EXPECT_EQ(values({"x", "depth", "y", "z", "lon"}), (Names{"depth", "lon"}));
  EXPECT_EQ(values({"a", "b", "depth", "lon"}, named("b", "a")), (Names{"depth", "lon"}));
  EXPECT_EQ(values({"depth", "lon"}), (Names{"depth", "lon"}));
  EXPECT_EQ(values({"lon", "lat", "lng"}), (Names{"lon", "lat", "lng"}));
  EXPECT_EQ(values({}), Names{});
}

TEST(csv_columns, are_found_by_usual_names) {
  for (const char* const lon : {"lon", "lng", "long", "longitude", "LON", "Longitude"}) {
    for (const char* const lat : {"lat", "latitude", "LATITUDE"}) {
      EXPECT_EQ(columns_of({lon, lat}), "lonlat 0 1");
      EXPECT_EQ(columns_of({"id", lat, "x", lon}), "lonlat 3 1");
    }
  }
  EXPECT_EQ(columns_of({"Z", "y", "X"}), "xyz 2 1 0");
  EXPECT_EQ(columns_of({"lon", "x", "y", "z"}), "xyz 1 2 3");
  EXPECT_EQ(columns_of({"x", "y", "lon", "lat"}), "lonlat 2 3");
  EXPECT_EQ(
      columns_of({"lon", "lat", "x", "y", "z"}),
      "columns for both longitude, latitude and x, y, z; name those to read; found: lon, lat, "
      "x, y, z");
  EXPECT_EQ(columns_of({"a", "b"}),
            "no columns for longitude and latitude (lon, lat) or for x, y, z; found: a, b");
  EXPECT_EQ(columns_of({"lon", "b"}), "no column for the latitude (lat, latitude); found: lon, b");
  EXPECT_EQ(columns_of({"a", "lat"}),
            "no column for the longitude (lon, lng, long, longitude); found: a, lat");
  EXPECT_EQ(columns_of({"column_1", "lat"}),
            "no column for the longitude (lon, lng, long, longitude); found: column_1, lat; "
            "a column without a name is called by its position");
  EXPECT_EQ(columns_of({"x", "z"}), "no column for the y coordinate (y); found: x, z");
  EXPECT_EQ(columns_of({"X", "b", "y"}),
            "no column for the z coordinate (z); found: X, b, y; if they are longitude and "
            "latitude: --lon X --lat y");
  EXPECT_EQ(columns_of({"x", "lon"}), "no column for the latitude (lat, latitude); found: x, lon");
}

TEST(csv_columns, are_those_that_are_named) {
  EXPECT_EQ(columns_of({"a", "b"}, named("b", "a")), "lonlat 1 0");
  EXPECT_EQ(columns_of({"A", "b"}, named(" a ", "B")), "lonlat 0 1");
  EXPECT_EQ(columns_of({"A", "a", "b"}, named("a", "b")), "lonlat 1 2");
  EXPECT_EQ(columns_of({"a", "A", "b"}, named("A", "b")), "lonlat 1 2");
  EXPECT_EQ(columns_of({"lat", "b", "x", "y", "z"}, named("b", "")), "lonlat 1 0");
  EXPECT_EQ(columns_of({"a", "b"}, named("c", "b")), "no column \"c\"; found: a, b");
  EXPECT_EQ(columns_of({"a", "b"}, named("a", "")),
            "no column for the latitude (lat, latitude); found: a, b");
  EXPECT_EQ(columns_of({"a", "b", "a"}, named("a", "b")),
            "two columns have the same name: \"a\" (column 1) and \"a\" (column 3)");
  EXPECT_EQ(columns_of({"b", "A", "a", "lat"}, named("aA", "")),
            "no column \"aA\"; found: b, A, a, lat");
  EXPECT_EQ(columns_of({"AB", "b", "aB"}, named("ab", "b")),
            "more than one column may be the longitude: \"AB\" (column 1) and \"aB\" (column 3); "
            "name one of them");
  EXPECT_EQ(columns_of({"lon", "LNG", "long", "lat"}),
            "more than one column may be the longitude: \"lon\" (column 1), \"LNG\" (column 2) and "
            "\"long\" (column 3); name one of them");
  EXPECT_EQ(columns_of({"lon", "lat", "lon"}),
            "more than one column may be the longitude: \"lon\" (column 1) and \"lon\" (column 3)");
  ReadOptions both = named("a", "");
  both.z = "z";
  EXPECT_EQ(columns_of({"a", "z"}, both),
            "columns are named both for longitude, latitude and for x, y, z");
  ReadOptions xyz;
  xyz.y = "b";
  EXPECT_EQ(columns_of({"lon", "lat", "b", "x", "z"}, xyz), "xyz 3 2 4");
  ReadOptions circle;
  circle.radius = "R";
  EXPECT_EQ(columns_of({"lon", "lat", "q", "r"}, circle), "lonlat 0 1 r3");
  EXPECT_EQ(columns_of({"lon", "lat", "q"}, circle), "no column \"R\"; found: lon, lat, q");
  EXPECT_EQ(columns_of({"lon", "lat", "radius"}), "lonlat 0 1");
}

TEST(csv_columns, that_are_missing_have_a_hint) {
  const auto hint = [](const Names& header) {
    const std::string message = columns_of(header);
    return message.substr(message.rfind("found: ") + 7);
  };
  EXPECT_EQ(hint({"# made by", "b"}), "# made by, b; a table has no lines of comments");
  EXPECT_EQ(hint({"1", "2.5"}), "1, 2.5; the first line must name the columns");
  EXPECT_EQ(hint({"1", "b"}), "1, b");
  EXPECT_EQ(hint({"lon;lat"}), "lon;lat; is the delimiter \";\"? (--delimiter)");
  EXPECT_EQ(hint({"lon|lat"}), "lon|lat; is the delimiter \"|\"? (--delimiter)");
  EXPECT_EQ(hint({"lon,lat"}), "lon,lat; is the delimiter \",\"? (--delimiter)");
  EXPECT_EQ(hint({"lon\tlat"}), "lon?lat; is the delimiter a tab? (--delimiter)");
  EXPECT_EQ(hint({"lon"}), "lon");
  EXPECT_EQ(hint({"a;b", "c"}), "a;b, c");
  Names many;
  std::string first;
  for (int i = 0; i < 30; ++i) {
    many.push_back("c" + std::to_string(i));
    first += (i == 0 ? "" : ", ") + many.back();
  }
  EXPECT_EQ(hint(many), first);
  many.emplace_back("more");
  EXPECT_EQ(hint(many), first + ", ...");
}

TEST(csv_columns, of_all_coordinates_may_be_lacking) {
  const auto has = [](const Names& header, const ReadOptions& options = {}) {
    return io::has_coordinates(header, options);
  };
  EXPECT_TRUE(has({"lon", "lat"}));
  EXPECT_TRUE(has({"x", "a", "z", "y"}));
  EXPECT_FALSE(has({"lon", "x", "y"}));
  EXPECT_FALSE(has({"a"}));
  EXPECT_TRUE(has({"a"}, named("b", "")));
  ReadOptions z;
  z.z = "c";
  EXPECT_TRUE(has({"a"}, z));
}

TEST(csv_columns, have_different_names) {
  EXPECT_EQ(io::column_names({" a ", "", "\t", "b"}), (Names{"a", "column_2", "column_3", "b"}));
  EXPECT_EQ(io::find_column({"a", "b", "A"}, " b "), std::optional<std::size_t>(1));
  EXPECT_EQ(io::find_column({"a", "b"}, "B"), std::nullopt);
  EXPECT_EQ(refused([] {
              (void)io::find_column({"a", "b", "b", "b"}, "b");
            }),
            "two columns have the same name: \"b\" (column 2) and \"b\" (column 3)");
  EXPECT_EQ(refused([] { io::require_different_names({"a", "b", "A"}); }), "");
  EXPECT_NE(refused([] { io::require_different_names({"c", "a", "c"}); }), "");
  EXPECT_TRUE(io::is_comment(" \t#x"));
  EXPECT_FALSE(io::is_comment("x#"));
}

TEST(csv_records, are_of_utf_8) {
  EXPECT_EQ(io::table_text("\xEF\xBB\xBF"
                           "a"),
            "a");
  EXPECT_EQ(io::table_text("\xEF\xBB"), "\xEF\xBB");
  for (const char* const text : {"\xFF\xFE"
                                 "a",
                                 "\xFE\xFF"
                                 "a"}) {
    EXPECT_EQ(refused([&] { (void)io::table_text(text); }), "the file is UTF-16, not UTF-8");
  }
}

TEST(csv_records, end_where_the_text_does) {
  io::CsvRecords records("ab;\"c\"\"\"\r\n\nd\n", ';');
  EXPECT_EQ(records.position(), 0U);
  EXPECT_TRUE(records.next());
  EXPECT_EQ(records.fields().size(), 2U);
  EXPECT_EQ(records.fields()[1], "c\"");
  EXPECT_EQ(records.position(), 10U);
  EXPECT_EQ(records.line(), 1U);
  EXPECT_TRUE(records.next());
  EXPECT_EQ(records.fields()[0], "d");
  EXPECT_EQ(records.position(), 13U);
  EXPECT_EQ(records.line(), 3U);
  EXPECT_FALSE(records.next());
  EXPECT_TRUE(records.fields().empty());
  EXPECT_EQ(records.line(), 4U);
  EXPECT_EQ(refused([] { io::CsvRecords("\"a", ',').next(); }), "a quoted field does not end");
  EXPECT_EQ(refused([] { io::CsvRecords("\"a\"\"", ',').next(); }), "a quoted field does not end");
  EXPECT_EQ(refused([] { io::CsvRecords("\"a\"b\n", ',').next(); }),
            "text behind the closing quote of a field");
  EXPECT_EQ(refused([] { io::CsvRecords("a\rb", ',').next(); }), "lines end with CR alone, not LF");
  EXPECT_EQ(refused([] { io::CsvRecords("a\r,b", ',').next(); }),
            "lines end with CR alone, not LF");
}

// Reads a table, or returns the message.
std::string message_of_table(const std::string& text, io::ReadJob job = {}, bool is_tsv = false) {
  SiteTable table;
  table.name = "a.csv";
  return refused([&] { (is_tsv ? io::read_tsv : io::read_csv)(text, job, table); });
}

TEST(csv_reader, names_lines_that_are_wrong) {
  EXPECT_EQ(message_of_table("lon,lat\n1,2\n"), "");
  EXPECT_EQ(message_of_table("lon,lat\n1,2\n\n3\n"), "4: 1 field where the header has 2");
  EXPECT_EQ(message_of_table("lon,lat\n1,2,3\n"), "2: 3 fields where the header has 2");
  EXPECT_EQ(message_of_table("lon,lat\n1,5,2,5\n"),
            "2: 4 fields where the header has 2; is the comma both delimiter and decimal point?");
  EXPECT_EQ(message_of_table("lon,lat\n# 1\n"),
            "2: 1 field where the header has 2; a table has no lines of comments");
  EXPECT_EQ(message_of_table("lon,lat\n# by ship, in May, 2001\n"),
            "2: 3 fields where the header has 2; a table has no lines of comments");
  EXPECT_EQ(message_of_table("lon,lat\n1,2\n3,x\n"), "3: latitude \"x\" is not a number");
  EXPECT_EQ(message_of_table("x,y,z\n1,,3\n"), "2: y is empty");
  EXPECT_EQ(message_of_table("lon,lat,a,a\n1,2,3,4\n"),
            "1: two columns have the same name: \"a\" (column 3) and \"a\" (column 4)");
  EXPECT_EQ(message_of_table("\xFF\xFE"
                             "l"),
            "1: the file is UTF-16, not UTF-8");
  EXPECT_EQ(message_of_table("lon\tlat\n1\t2\n", {}, true), "");
  io::ReadJob semicolon;
  semicolon.delimiter = ';';
  EXPECT_EQ(message_of_table("lon;lat\n1;2\n", semicolon), "");
  EXPECT_EQ(message_of_table("lon;lat\n1;2\n", semicolon, true), "");
}

TEST(csv_reader, drops_columns_without_names_and_texts) {
  io::ReadJob job;
  job.keep_columns = true;
  const auto names_of = [&](const std::string& text) {
    SiteTable table;
    io::read_csv(text, job, table);
    Names names;
    for (const Column& column : table.columns) names.push_back(column.name);
    return names;
  };
  EXPECT_EQ(names_of("lon,lat,\n1,2,\n3,4, \n"), (Names{"lon", "lat"}));
  EXPECT_EQ(names_of("lon,lat,\n1,2,\n3,4,a\n"), (Names{"lon", "lat", "column_3"}));
  EXPECT_EQ(names_of(",lon,lat,e\n0,1,2,\n1,3,4,\n"), (Names{"column_1", "lon", "lat", "e"}));
}

TEST(column_text, is_utf_8_without_zeros) {
  EXPECT_EQ(io::make_column("a").name, "a");
  EXPECT_TRUE(io::make_column("a").is_numeric);
  EXPECT_EQ(refused([] { (void)io::make_column("\xFF"); }), "the name of a column is not UTF-8");
  EXPECT_NE(refused([] { (void)io::make_column(std::string_view("a\0", 2)); }), "");
  Column column = io::make_column("a");
  for (const char* const cell : {"1", "", "-2.5e3"}) io::append_cell(column, cell);
  EXPECT_TRUE(column.is_numeric);
  io::append_cell(column, "x");
  EXPECT_FALSE(column.is_numeric);
  io::append_cell(column, "7");
  EXPECT_FALSE(column.is_numeric);
  EXPECT_EQ(column.text, "1-2.5e3x7");
  EXPECT_EQ(column.ends, (std::vector<std::uint64_t>{1, 1, 7, 8, 9}));
  EXPECT_EQ(column.cell(0), "1");
  EXPECT_EQ(column.cell(2), "-2.5e3");
  EXPECT_EQ(refused([&] { io::append_cell(column, "\x80"); }),
            "the text in column \"a\" is not UTF-8");
  EXPECT_EQ(refused([&] { io::append_cell(column, std::string_view("\0", 1)); }),
            "the text in column \"a\" has the character \\u0000, at which texts end in other "
            "formats");
}

TEST(column_text, is_a_table_that_is_read_again) {
  const auto field = [](const char* text, char separator) {
    std::string out = "-";
    io::append_csv_field(out, text, separator);
    return out;
  };
  EXPECT_EQ(field("a b", ','), "-a b");
  EXPECT_EQ(field("a,b", ','), "-\"a,b\"");
  EXPECT_EQ(field("a,b", '\t'), "-a,b");
  EXPECT_EQ(field("a\tb", '\t'), "-\"a\tb\"");
  EXPECT_EQ(field("a\"b", ','), "-\"a\"\"b\"");
  EXPECT_EQ(field("\r", ','), "-\"\r\"");
  EXPECT_EQ(field("\n", ','), "-\"\n\"");
  std::vector<Column> columns = {io::make_column("n"), io::make_column("t,")};
  for (const char* const cell : {"1", "", "3"}) io::append_cell(columns[0], cell);
  for (const char* const cell : {"a\"\n", "b", ""}) io::append_cell(columns[1], cell);
  const std::string text = io::csv_of(columns);
  EXPECT_EQ(text, "n,\"t,\"\n1,\"a\"\"\n\"\n\"\",b\n3,\"\"\n");
  EXPECT_EQ(io::csv_of({}), "");
  const std::vector<Column> again = io::columns_of_csv(text, 3);
  ASSERT_EQ(again.size(), 2U);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(again[c].name, columns[c].name);
    EXPECT_EQ(again[c].is_numeric, columns[c].is_numeric);
    EXPECT_EQ(again[c].text, columns[c].text);
    EXPECT_EQ(again[c].ends, columns[c].ends);
  }
  EXPECT_TRUE(io::columns_of_csv("", 7).empty());
  EXPECT_EQ(refused([&] { (void)io::columns_of_csv(text, 2); }), "3 rows for 2 cells");
  EXPECT_EQ(refused([] { (void)io::columns_of_csv("a,b\n1,2\n3\n", 2); }),
            "1 fields in row 1 of 2 columns");
}

}  // namespace
}  // namespace rondel::test::of_columns
