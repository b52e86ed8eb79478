// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Readers of sites: what good files mean, and what is said of bad ones.
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>

#include "io/npy_header.h"
#include "unit/io/support.h"

namespace rondel::test {
namespace {

std::vector<std::string> cells(const Column& column) {
  std::vector<std::string> result;
  std::uint64_t start = 0;
  for (const std::uint64_t end : column.ends) {
    result.push_back(column.text.substr(start, end - start));
    start = end;
  }
  return result;
}

TEST(read_sites, every_good_file_holds_the_octahedron) {
  const auto files = files_in(corpus / "good");
  EXPECT_EQ(files.size(), 20U);
  for (const auto& file : files) {
    const SiteTable table = read_sites(file.string());
    EXPECT_EQ(table.sites, octahedron) << file;
    EXPECT_EQ(table.name, file.string());
    EXPECT_TRUE(table.columns.empty()) << file;
    EXPECT_EQ(table.positions.size(), table.is_lonlat() ? 6U : 0U) << file;
  }
}

TEST(read_sites, says_what_is_wrong_with_every_bad_file) {
  expect_messages(corpus / "bad", [](const std::string& file) {
    ReadOptions options;
    options.keep_columns = true;
    read_sites(file, options);
  });
}

TEST(read_sites, a_file_without_sites_is_an_answer) {
  const auto files = files_in(corpus / "none");
  EXPECT_EQ(files.size(), 6U);
  ReadOptions options;
  options.keep_columns = true;
  for (const auto& file : files) {
    const SiteTable table = read_sites(file.string(), options);
    EXPECT_TRUE(table.sites.empty() && table.positions.empty() && table.lines.empty()) << file;
    EXPECT_EQ(table.num_unlocated, file.stem() == "null_geometry" ? 1U : 0U);
  }
}

// Writes rows of three numbers of any type, which read_sites must give back as doubles.
template <class Number>
void expect_rows(const std::string& path, std::string_view dtype,
                 const std::vector<std::array<Number, 3>>& rows) {
  std::ofstream file(path, std::ios::binary);
  file << io::make_npy_header(dtype, std::array<std::uint64_t, 2>{rows.size(), 3});
  std::vector<Point> expected;
  for (const auto& [x, y, z] : rows) {
    expected.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
    for (const Number value : {x, y, z}) {
      std::array<char, sizeof value> bytes{};
      io::store(value, bytes.data());
      file.write(bytes.data(), bytes.size());
    }
  }
  file.close();
  EXPECT_EQ(read_sites(path).sites, expected) << dtype;
}

TEST(read_sites, numbers_of_arrays_become_doubles_exactly) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.npy");
  expect_rows<float>(path, "<f4", {{0.1F, -1.5e-40F, 3e38F}});
  expect_rows<std::int8_t>(path, "|i1", {{-128, 0, 127}, {1, 2, 3}});
  expect_rows<std::uint8_t>(path, "|u1", {{255, 0, 1}});
  expect_rows<std::int16_t>(path, "<i2", {{-32768, 0, 32767}});
  expect_rows<std::uint16_t>(path, "<u2", {{65535, 0, 1}});
  expect_rows<std::int32_t>(path, "<i4", {{-2147483647, 0, 7}});
  expect_rows<std::uint32_t>(path, "<u4", {{4294967295U, 0, 7}});
  constexpr std::int64_t exact = (std::int64_t{1} << 53) - 1;
  expect_rows<std::int64_t>(path, "<i8",
                            {{-1024 * exact, exact, std::numeric_limits<std::int64_t>::min()}});
  expect_rows<std::uint64_t>(path, "<u8", {{2048 * std::uint64_t{exact}, 0, 1}});
}

TEST(read_sites, reads_the_format_and_the_delimiter_that_are_named) {
  const TemporaryDirectory directory;
  const std::string file = directory.with("a.txt", "lon;lat\n1;2\n");
  ReadOptions options;
  options.delimiter = ';';
  EXPECT_EQ(read_sites({file, "CSV"}, options).positions.at(0), (LonLat{1, 2}));
  EXPECT_EQ(message_of([&] { read_sites(file, options); }),
            file + ": a delimiter is named, but .txt files have none");
  EXPECT_EQ(message_of([&] {
              read_sites({file, "xlsx"});
            }),
            file +
                ": unknown format \"xlsx\"; sites are read from .csv .tsv .xyz .txt .npy "
                ".geojson .gpkg .fgb .shp .parquet");
}

TEST(read_sites, counts_features_without_a_place) {
  const TemporaryDirectory directory;
  const SiteTable table =
      read_sites(directory.with("a.geojson", R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"a":1},"geometry":null},
{"type":"Feature","properties":{"a":2},"geometry":{"type":"Point","coordinates":[1,2]}},
{"type":"Feature","properties":{"a":3},"geometry":{"type":"Point","coordinates":[]}}]})"));
  EXPECT_EQ(table.positions, (std::vector<LonLat>{{1, 2}}));
  EXPECT_EQ(table.num_unlocated, 2U);
  EXPECT_EQ(table.where(0), table.name + ":3");
}

TEST(read_sites, refuses_geojson_whose_crs_is_not_in_degrees) {
  const TemporaryDirectory directory;
  const std::string point = R"({"type":"Point","coordinates":[1,2]})";
  const auto message = [&](const std::string& crs, bool is_last) {
    const std::string features =
        R"("features":[{"type":"Feature","properties":{},"geometry":)" + point + "}]";
    const std::string text =
        R"({"type":"FeatureCollection",)" +
        (is_last ? features + R"(,"crs":)" + crs : R"("crs":)" + crs + "," + features) + "}";
    const std::string file = directory.with("a.geojson", text);
    return message_of([&] { read_sites(file); });
  };
  const auto named = [](const std::string& name) {
    return R"({"type":"name","properties":{"name":")" + name + R"("}})";
  };
  for (const bool is_last : {false, true}) {
    for (const char* name :
         {"urn:ogc:def:crs:OGC:1.3:CRS84", "urn:ogc:def:crs:EPSG::4326", "EPSG:4979", "EPSG:4269",
          "http://www.opengis.net/def/crs/EPSG/0/4258", "urn:ogc:def:crs:IAU:2015:30100"}) {
      EXPECT_EQ(message(named(name), is_last), "") << name;
    }
    EXPECT_EQ(message("null", is_last), "");
    EXPECT_EQ(message(R"({"type":"EPSG","properties":{"code":4326}})", is_last), "");
    for (const char* name : {"urn:ogc:def:crs:EPSG::3857", "EPSG:4807", "EPSG:14326",
                             "urn:ogc:def:crs:IAU:2015:30110"}) {
      EXPECT_NE(message(named(name), is_last).find('"' + std::string(name) + '"'),
                std::string::npos)
          << name;
    }
    EXPECT_NE(message(R"({"type":"EPSG","properties":{"code":25832}})", is_last).find("25832"),
              std::string::npos);
    EXPECT_NE(message(R"("EPSG:3857")", is_last).find("EPSG:3857"), std::string::npos);
  }
  const std::string bare = directory.with(
      "b.geojson", R"({"type":"Point","crs":)" + named("EPSG:3857") + R"(,"coordinates":[1,2]})");
  EXPECT_NE(message_of([&] { read_sites(bare); }).find("EPSG:3857"), std::string::npos);
}

// CR alone once made one record of the whole text, which was the header, so that no row was left.
TEST(read_sites, refuses_lines_that_end_with_cr_alone) {
  const TemporaryDirectory directory;
  const std::string what = ": lines end with CR alone, not LF";
  const std::pair<const char*, const char*> texts[] = {
      {"lon,lat,v\r10,5,1\r10,20,1\r", ":1"},
      {"v,lon,lat\r1,10,5\r", ":1"},
      {"\"lon\",\"lat\",\"v\"\r10,5,1\r", ":1"},
      {"\r\rlon,lat\r1,2\r", ":1"},
      {"lon,lat,v\n10,5,1\r10,20,1\r", ":2"},
      {"lon,lat,v\r\n10,5,1\r\n10,20,one\rtwo\r\n", ":3"},
  };
  for (const auto& [text, line] : texts) {
    const std::string file = directory.with("a.csv", text);
    EXPECT_EQ(message_of([&] { read_sites(file); }), file + line + what) << text;
  }
  const std::string points = directory.with("a.xyz", "# three numbers\r1 0 0\r0 1 0\r");
  EXPECT_EQ(message_of([&] { read_sites(points); }), points + ":1" + what);
}

TEST(read_sites, reads_cr_in_quotes_and_before_lf) {
  const TemporaryDirectory directory;
  ReadOptions options;
  options.keep_columns = true;
  const SiteTable table = read_sites(
      directory.with("a.csv", "lon,lat,v\r\r\n\r\r\n1,2,\"a\rb\"\r\r\n3,4,\"c\"\r\n5,6,d\r"),
      options);
  EXPECT_EQ(table.positions, (std::vector<LonLat>{{1, 2}, {3, 4}, {5, 6}}));
  EXPECT_EQ(cells(table.columns[2]), (std::vector<std::string>{"a\rb", "c", "d"}));
  EXPECT_EQ(table.where(0), table.name + ":3");
}

TEST(read_sites, names_the_line_of_every_site) {
  const std::map<std::string, std::pair<std::string, std::string>> first_and_last = {
      {"plain.csv", {":2", ":7"}},          {"bom_crlf_no_final_newline.csv", {":2", ":12"}},
      {"empty_lines.csv", {":5", ":15"}},   {"comments.xyz", {":3", ":8"}},
      {"xyz.npy", {": row 0", ": row 5"}},  {"features.geojson", {":3", ":8"}},
      {"multipoint.geojson", {":1", ":1"}},
  };
  for (const auto& [name, expected] : first_and_last) {
    const SiteTable table = read_sites((corpus / "good" / name).string());
    EXPECT_EQ(table.where(0), table.name + expected.first);
    EXPECT_EQ(table.where(5), table.name + expected.second);
  }
}

TEST(read_sites, names_the_feature_where_a_line_has_several) {
  const TemporaryDirectory directory;
  const auto point = [](const std::string& properties) {
    return R"({"type":"Feature","properties":{)" + properties +
           R"(},"geometry":{"type":"MultiPoint","coordinates":[[1,2],[3,4]]}})";
  };
  const std::string begin = R"({"type":"FeatureCollection","features":[)";
  const std::string unlocated = R"({"type":"Feature","properties":{},"geometry":null})";
  const SiteTable table = read_sites(
      directory.with("a.geojson", begin + unlocated + "," + point("") + "," + point("") + "]}"));
  ASSERT_EQ(table.sites.size(), 4U);
  EXPECT_EQ(table.where(1), table.name + ":1: feature 1");
  EXPECT_EQ(table.where(2), table.name + ":1: feature 2");
  EXPECT_EQ(table.selection({false, false, false, true}).where(0), table.name + ":1: feature 2");
  const SiteTable one = read_sites(directory.with("b.geojson", begin + point("") + "]}"));
  EXPECT_EQ(one.where(1), one.name + ":1");
  const std::string twice =
      directory.with("c.geojson", begin + point("") + ",\n" + point(R"("v":1,"v":1)") + "]}");
  EXPECT_EQ(message_of([&] { read_sites(twice); }),
            twice + ":2: feature 1: two members \"v\" of one object");
  const std::string root = directory.with("d.geojson", "{\"type\":1,\n\"type\":2}");
  EXPECT_NE(message_of([&] { read_sites(root); }).find("two members \"type\" of one object"),
            std::string::npos);
}

TEST(read_sites, a_selection_keeps_lines_and_columns) {
  for (const char* name : {"plain.csv", "empty_lines.csv", "xyz.npy", "features.geojson"}) {
    ReadOptions options;
    options.keep_columns = true;
    const SiteTable table = read_sites((corpus / "good" / name).string(), options);
    std::vector<bool> keep(table.sites.size(), false);
    keep[1] = keep[4] = true;
    const SiteTable selected = table.selection(keep);
    ASSERT_EQ(selected.sites.size(), 2U) << name;
    EXPECT_EQ(selected.positions.size(), table.is_lonlat() ? 2U : 0U) << name;
    for (const std::size_t i : {0U, 1U}) {
      const std::size_t from = i == 0 ? 1 : 4;
      EXPECT_EQ(selected.sites[i], table.sites[from]);
      EXPECT_EQ(selected.where(i), table.where(from));
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        EXPECT_EQ(cells(selected.columns[c]).at(i), cells(table.columns[c]).at(from));
      }
    }
  }
}

TEST(read_sites, lists_lines_only_where_they_do_not_follow_each_other) {
  EXPECT_TRUE(read_sites((corpus / "good/plain.csv").string()).lines.empty());
  EXPECT_TRUE(read_sites((corpus / "good/comments.xyz").string()).lines.empty());
  const SiteTable table = read_sites((corpus / "good/empty_lines.csv").string());
  EXPECT_EQ(table.lines, (std::vector<std::uint64_t>{5, 7, 9, 11, 13, 15}));
}

TEST(read_sites, finds_columns_by_chosen_names) {
  const TemporaryDirectory directory;
  const std::string file =
      directory.with("a.csv", "lon,lat,East,north,up,x,y,z\n9,9,1,2,3,4,5,6\n");
  ReadOptions options;
  options.lon = "north";
  options.lat = "UP";
  EXPECT_EQ(read_sites(file, options).positions.at(0), (LonLat{2, 3}));
  options = {};
  options.x = "east";
  EXPECT_EQ(read_sites(file, options).sites[0], (Point{1, 5, 6}));
  options.x = "west";
  EXPECT_EQ(message_of([&] { read_sites(file, options); }),
            file + ":1: no column \"west\"; found: lon, lat, East, north, up, x, y, z");
  options.lat = "north";
  EXPECT_EQ(message_of([&] { read_sites(file, options); }),
            file + ":1: columns are named both for longitude, latitude and for x, y, z");
}

TEST(read_sites, prefers_the_exact_name_to_one_that_differs_in_case) {
  const TemporaryDirectory directory;
  const std::string file = directory.with("a.csv", "A,a,lat\n1,2,3\n");
  ReadOptions options;
  options.lon = "a";
  EXPECT_EQ(read_sites(file, options).positions.at(0), (LonLat{2, 3}));
}

TEST(read_sites, refuses_names_of_columns_where_there_are_none) {
  ReadOptions options;
  options.x = "x";
  const std::string file = (corpus / "good/xyz.npy").string();
  EXPECT_EQ(message_of([&] { read_sites(file, options); }),
            file + ": columns are named, but .npy files have no names for columns");
}

TEST(read_sites, keeps_columns_as_text) {
  const TemporaryDirectory directory;
  const std::string file = directory.with(
      "a.csv", "lon,lat,id,name,height,none\n1,+2,007,\"a \"\"b\"\"\",-1.5e3,\n3,4,8,,,\n");
  ReadOptions options;
  options.keep_columns = true;
  const SiteTable table = read_sites(file, options);
  ASSERT_EQ(table.columns.size(), 6U);
  EXPECT_EQ(cells(table.columns[1]), (std::vector<std::string>{"+2", "4"}));
  EXPECT_EQ(cells(table.columns[2]), (std::vector<std::string>{"007", "8"}));
  EXPECT_EQ(cells(table.columns[3]), (std::vector<std::string>{"a \"b\"", ""}));
  EXPECT_EQ(cells(table.columns[4]), (std::vector<std::string>{"-1.5e3", ""}));
  std::vector<bool> is_numeric;
  for (const Column& column : table.columns) is_numeric.push_back(column.is_numeric);
  EXPECT_EQ(is_numeric, (std::vector<bool>{true, false, false, false, true, true}));
}

TEST(read_sites, turns_properties_into_columns) {
  const TemporaryDirectory directory;
  const std::string file = directory.with("a.geojson",
                                          R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"a":1},"geometry":{"type":"Point","coordinates":[1,2]}},
{"type":"Feature","properties":{"b":"7","a":2.5,"c":null},"geometry":{"type":"Point","coordinates":[1,2]}},
{"type":"Feature","properties":null,"geometry":{"type":"MultiPoint","coordinates":[[1,2],[3,4]]}}]})");
  ReadOptions options;
  options.keep_columns = true;
  const SiteTable table = read_sites(file, options);
  ASSERT_EQ(table.columns.size(), 3U);
  EXPECT_EQ(cells(table.columns[0]), (std::vector<std::string>{"1", "2.5", "", ""}));
  EXPECT_EQ(cells(table.columns[1]), (std::vector<std::string>{"", "7", "", ""}));
  EXPECT_TRUE(table.columns[0].is_numeric);
  EXPECT_FALSE(table.columns[1].is_numeric);
  EXPECT_EQ(cells(table.columns[2]), (std::vector<std::string>{"", "", "", ""}));
}

// One text among numbers leaves the others numbers.
TEST(read_sites, tells_numbers_of_a_property_from_texts) {
  const TemporaryDirectory directory;
  const auto point = [](const std::string& properties) {
    return R"({"type":"Feature","properties":)" + properties +
           R"(,"geometry":{"type":"Point","coordinates":[1,2]}})";
  };
  const std::string file = directory.with(
      "a.geojson", R"({"type":"FeatureCollection","features":[)" + point(R"({"v":1,"n":5})") + "," +
                       point(R"({"v":"2","t":"3"})") + "," + point(R"({"v":null})") + "," +
                       point(R"({"v":4})") + "," + point("null") + "]}");
  ReadOptions options;
  options.keep_columns = true;
  const SiteTable table = read_sites(file, options);
  const auto column = [](const SiteTable& of, const char* name) {
    return *std::ranges::find(of.columns, name, &Column::name);
  };
  EXPECT_EQ(column(table, "v").is_json, (std::vector<bool>{true, false, true, true, true}));
  EXPECT_TRUE(column(table, "n").is_json.empty());
  EXPECT_TRUE(column(table, "t").is_json.empty());
  const SiteTable selected = table.selection({false, true, false, true, false});
  EXPECT_EQ(column(selected, "v").is_json, (std::vector<bool>{false, true}));
}

TEST(read_sites, keeps_ids_of_features_with_one_site) {
  const TemporaryDirectory directory;
  const auto feature = [](const std::string& id, const std::string& geometry) {
    return R"({"type":"Feature",)" + id + R"("properties":{},"geometry":)" + geometry + "}";
  };
  const std::string one = R"({"type":"Point","coordinates":[1,2]})";
  const std::string two = R"({"type":"MultiPoint","coordinates":[[1,2],[3,4]]})";
  const std::string file = directory.with(
      "a.geojson", R"({"type":"FeatureCollection","features":[)" + feature(R"("id":"a",)", one) +
                       "," + feature("", one) + "," + feature(R"("id":"b",)", two) + "," +
                       feature(R"("id":18446744073709551616,)", one) + "]}");
  ReadOptions options;
  options.keep_columns = true;
  const SiteTable table = read_sites(file, options);
  EXPECT_EQ(cells(table.ids),
            (std::vector<std::string>{R"("a")", "", "", "", "18446744073709551616"}));
  EXPECT_EQ(cells(table.selection({true, false, false, false, true}).ids),
            (std::vector<std::string>{R"("a")", "18446744073709551616"}));
  const std::string none = directory.with("b.geojson", feature("", one));
  EXPECT_TRUE(read_sites(none, options).ids.ends.empty());
}

TEST(read_sites, rows_without_coordinates_are_left_out) {
  const TemporaryDirectory directory;
  ReadOptions options;
  options.keep_columns = true;
  const SiteTable some =
      read_sites(directory.with("a.csv", "lon,lat,v\n1,2,3\n,,4\n5,6,\n, ,5\n"), options);
  ASSERT_EQ(some.sites.size(), 2U);
  EXPECT_EQ(some.num_unlocated, 2U);
  EXPECT_EQ(some.positions[1], (LonLat{5, 6}));
  EXPECT_EQ(some.where(1), some.name + ":4");
  ASSERT_EQ(some.columns.size(), 3U);
  EXPECT_EQ(some.columns[2].cell(0), "3");
  EXPECT_EQ(some.columns[2].cell(1), "");
  EXPECT_EQ(read_sites(directory.with("b.csv", "x,y,z\n,,\n")).num_unlocated, 1U);
}

TEST(read_sites, may_lack_places) {
  const TemporaryDirectory directory;
  const auto read = [&](const std::string& text, bool may_lack = true) {
    ReadOptions options;
    options.may_lack_places = may_lack;
    return read_sites(directory.with("a.csv", text), options);
  };
  const SiteTable some = read("lon,lat,v\n1,2,3\n,,4\n5,6,\n");
  ASSERT_EQ(some.sites.size(), 3U);
  EXPECT_TRUE(std::isnan(some.sites[1].x) && std::isnan(some.positions[1].lat_deg));
  EXPECT_EQ(some.positions[2], (LonLat{5, 6}));
  EXPECT_EQ(some.where(2), some.name + ":4");
  EXPECT_TRUE(std::isnan(read("x,y,z\n1,2,3\n, ,\n").sites[1].z));
  EXPECT_TRUE(read("x,v\n1,3\n").sites.empty());
  EXPECT_TRUE(read("lat,v\n1,3\n").sites.empty());
  for (const char* text : {"lon,lat\n1,\n", "x,y,z\n,,1\n", "lon,lat\nnan,1\n"}) {
    EXPECT_THROW(read(text), FileError) << text;
  }
  EXPECT_THROW(read("lon,lat\n1,\n", false), FileError);
  EXPECT_THROW(read("x,v\n1,3\n", false), FileError);
}

TEST(columns, have_integers_that_are_no_doubles) {
  const auto is_wide = [](const std::string& text, bool is_numeric = true) {
    return Column{"a", is_numeric, "1" + text, {1, 1 + text.size()}}.has_wide_integers();
  };
  for (const char* text :
       {"9007199254740993", "-9007199254740993", "9938650116007493633", "18446744073709551615",
        "18446744073709551616", "-9223372036854775807", "1000000000000000000000000000000"}) {
    EXPECT_TRUE(is_wide(text)) << text;
    EXPECT_FALSE(is_wide(text, false)) << text;
  }
  for (const char* text : {"", "0", "-1", "9007199254740992", "9007199254740994",
                           "9223372036854775808", "-9223372036854775808", "18446744073709549568",
                           "0.10000000000000000001", "9007199254740993.5", "1e30"}) {
    EXPECT_FALSE(is_wide(text)) << text;
  }
}

TEST(free_names, give_way_with_underscores) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(free_names({"a", "b", "a", "a_", "a"}), (Names{"a", "b", "a_", "a__", "a___"}));
  EXPECT_EQ(free_names({"area", "Area"}, {"area"}), (Names{"area_", "Area"}));
  EXPECT_EQ(free_names({"Area", "x", "X"}, {"area"}, true), (Names{"Area_", "x", "X_"}));
  EXPECT_EQ(free_names({}, {"a"}), Names{});
}

TEST(read_sites, converts_radians) {
  const TemporaryDirectory directory;
  const double half_pi = std::numbers::pi / 2;
  const std::vector<LonLat> radians = {
      {half_pi, half_pi}, {-2 * half_pi, -std::nextafter(half_pi, 2)}, {0, 0.5}};
  write_sites(directory.file("a.csv"), std::vector<Point>(3), radians);
  ReadOptions options;
  options.radians = true;
  const SiteTable table = read_sites(directory.file("a.csv"), options);
  EXPECT_EQ(table.positions.at(0), (LonLat{90, 90}));
  EXPECT_EQ(table.positions.at(1), (LonLat{-180, -90}));
  EXPECT_NEAR(table.positions.at(2).lat_deg, 28.64788975654116, 1e-13);
  EXPECT_EQ(table.sites[0], (Point{0, 0, 1}));
  const std::string file = directory.with("b.csv", "lon,lat\n0,1.5707964\n");
  EXPECT_EQ(message_of([&] { read_sites(file, options); }),
            file + ":2: latitude 1.5707964 is outside [-pi/2, pi/2]");
}

TEST(read_sites, accepts_endings_in_capitals) {
  const TemporaryDirectory directory;
  EXPECT_EQ(read_sites(directory.with("A.B.CSV", "x,y,z\n1,2,3\n")).sites.size(), 1U);
}

TEST(read_sites, names_each_coordinate_that_is_not_finite) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("sites.npy");
  const double nan = std::nan("");
  const std::array<Point, 3> bad = {{{nan, 0, 0}, {0, nan, 0}, {0, 0, nan}}};
  constexpr std::array names = {"x", "y", "z"};
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const std::array<Point, 2> sites = {{{1, 0, 0}, bad[i]}};
    write_sites(path, sites);
    EXPECT_EQ(message_of([&] { read_sites(path); }),
              path + ": row 1: " + names[i] + " nan is not finite");
  }
}

TEST(read_sites, says_why_a_file_cannot_be_opened) {
  const TemporaryDirectory directory;
  const std::string missing = directory.file("missing.csv");
  EXPECT_EQ(message_of([&] { read_sites(missing); }), missing + ": No such file or directory");
  const std::string folder = directory.file("folder.csv");
  std::filesystem::create_directory(folder);
  EXPECT_EQ(message_of([&] { read_sites(folder); }), folder + ": Is a directory");
}

TEST(read_sites, reads_a_pipe_to_its_end) {
  const TemporaryDirectory directory;
  std::string text = "x,y,z\n";
  for (int i = 0; i < 20000; ++i) text += std::to_string(i) + ",2,3\n";
  const std::string file = directory.with("a.csv", text);
  const std::string pipe = directory.file("pipe.csv");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  FILE* const writer = ::popen(("cat " + file + " > " + pipe).c_str(), "w");
  const SiteTable table = read_sites(pipe);
  ::pclose(writer);
  ASSERT_EQ(table.sites.size(), 20000U);
  EXPECT_EQ(table.sites[19999], (Point{19999, 2, 3}));
}

TEST(read_sites, reports_progress) {
  const TemporaryDirectory directory;
  std::string text = "x,y,z\n";
  for (int i = 0; i < 200000; ++i) text += "1,2,3\n";
  const std::string file = directory.with("a.csv", text);
  std::vector<double> fractions;
  const Progress progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "read");
    fractions.push_back(fraction);
  };
  read_sites(file, {}, {.progress = progress});
  ASSERT_EQ(fractions.size(), 3U);
  EXPECT_NEAR(fractions[0], 65536.0 / 200000, 1e-4);
  EXPECT_NEAR(fractions[2], 3 * 65536.0 / 200000, 1e-4);
}

TEST(write_sites, round_trips_every_format) {
  const TemporaryDirectory directory;
  const double tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<Point> sites = {
      {0.1, -1.0 / 3, 1e300}, {tiny, -1e-300, 0}, {1e22, 123456789, 5}};
  for (const char* const name : {"a.csv", "a.tsv", "a.xyz", "a.txt", "a.npy"}) {
    ASSERT_TRUE(can_write_sites(name));
    write_sites(directory.file(name), sites);
    EXPECT_EQ(read_sites(directory.file(name)).sites, sites) << name;
  }
  const std::vector<LonLat> positions = {{0.1, 1.0 / 3}, {-179.99999999999997, -90}};
  for (const char* const name : {"b.csv", "b.tsv", "b.npy"}) {
    write_sites(directory.file(name), std::vector<Point>(2), positions);
    EXPECT_EQ(read_sites(directory.file(name)).positions, positions) << name;
  }
}

TEST(write_sites, writes_a_header_and_shortest_digits) {
  const TemporaryDirectory directory;
  write_sites(directory.file("a.csv"), std::vector<Point>(1), std::vector<LonLat>{{0.1, -90}});
  EXPECT_EQ(read_all(directory.file("a.csv")), "lon,lat\n0.1,-90\n");
  write_sites(directory.file("a.tsv"), std::vector<Point>{{1, 2.5, 1e-300}});
  EXPECT_EQ(read_all(directory.file("a.tsv")), "x\ty\tz\n1\t2.5\t1e-300\n");
}

TEST(write_sites, lists_the_endings_that_it_knows) {
  EXPECT_FALSE(can_write_sites("a.off"));
  EXPECT_EQ(message_of([] { write_sites("a.off", {}); }),
            "a.off: unknown ending \".off\"; sites are written as .csv .tsv .xyz .txt .npy");
}

}  // namespace
}  // namespace rondel::test
