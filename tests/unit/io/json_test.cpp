// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Trees of JSON, the items of GeoJSON documents, and properties as columns.
#include <cstdint>
#include <nlohmann/json.hpp>

#include "io/bad_value.h"
#include "io/geojson_items.h"
#include "io/geojson_writer.h"
#include "io/json_tree.h"
#include "unit/io/support.h"

namespace rondel::test::of_json {
namespace {

using io::JsonTree;

struct Seen {
  std::vector<std::string> starts;   // "depth member"
  std::vector<std::string> objects;  // "depth member text"
};

// The tree of a text; objects in members called "taken" are removed from it.
JsonTree tree_of(const std::string& text, Seen* seen = nullptr) {
  const auto start = [seen](std::size_t depth, const std::string& member) {
    if (seen != nullptr) seen->starts.push_back(std::to_string(depth) + " " + member);
  };
  const auto end = [seen](std::size_t depth, const std::string& member, const JsonTree& object) {
    if (seen != nullptr) {
      seen->objects.push_back(std::to_string(depth) + " " + member + " " + object.text());
    }
    return member == "taken";
  };
  io::JsonTreeBuilder builder({start, end});
  nlohmann::json::sax_parse(text, &builder);
  return builder.root();
}

TEST(json_tree, has_the_text_that_it_was_made_of) {
  for (const char* const text :
       {"null", "true", "false", "-7", "18446744073709551615", "0.5", R"("a\"b")", "[]", "{}",
        "[1]", "[1,[],{}]", R"({"a":1,"b":[true,null],"c":{"d":"e"}})",
        "123456789012345678901234567890", "[-99999999999999999999]"}) {
    EXPECT_EQ(tree_of(text).text(), text);
  }
  EXPECT_EQ(tree_of("[1e30]").text(), "[1e+30]");
  EXPECT_EQ(tree_of(" [ 1 , 2 ] ").text(), "[1,2]");
}

TEST(json_tree, knows_its_kind) {
  const JsonTree root =
      tree_of(R"({"n":null,"i":-3,"w":123456789012345678901,"s":"t","a":[4,5],"o":{}})");
  EXPECT_TRUE(root.member("n").is_null());
  EXPECT_TRUE(root.member("none").is_null());
  EXPECT_FALSE(root.member("n").is_number());
  EXPECT_EQ(root.member("i").number(), -3);
  EXPECT_TRUE(root.member("w").is_number());
  EXPECT_EQ(root.member("w").number(), 123456789012345678901.0);
  EXPECT_FALSE(root.member("w").is_string());
  EXPECT_TRUE(root.member("s").is_string());
  EXPECT_FALSE(root.member("s").is_number());
  EXPECT_EQ(root.member("s").string(), "t");
  EXPECT_TRUE(root.member("a").is_array());
  ASSERT_EQ(root.member("a").items.size(), 2U);
  EXPECT_EQ(root.member("a").items[1].number(), 5);
  EXPECT_FALSE(root.member("o").is_array() || root.member("o").is_null());
  EXPECT_EQ(root.members.size(), 6U);
}

TEST(json_tree, keeps_the_order_of_members) {
  const std::string text = R"({"name":1,"Zone":{"b":2,"a":3},"code":4})";
  EXPECT_EQ(tree_of(text).text(), text);
  EXPECT_TRUE(tree_of(text).has_member("code"));
  EXPECT_FALSE(tree_of(text).has_member("a"));
}

TEST(json_tree, tells_of_objects_with_their_depth_and_member) {
  Seen seen;
  const JsonTree root = tree_of(R"({"a":{"b":[{"c":1}]},"taken":[{"d":2},3,{"e":4}]})", &seen);
  EXPECT_EQ(seen.starts, (std::vector<std::string>{"0 ", "1 a", "3 a", "2 taken", "2 taken"}));
  EXPECT_EQ(seen.objects,
            (std::vector<std::string>{"3 a {\"c\":1}", "1 a {\"b\":[{\"c\":1}]}",
                                      "2 taken {\"d\":2}", "2 taken {\"e\":4}",
                                      "0  {\"a\":{\"b\":[{\"c\":1}]},\"taken\":[3]}"}));
  EXPECT_EQ(root.text(), R"({"a":{"b":[{"c":1}]},"taken":[3]})");
}

TEST(json_tree, refuses_what_is_no_json_or_too_deep) {
  EXPECT_EQ(refused([] { tree_of(R"({"a":1,"b":2,"a":3})"); }), "two members \"a\" of one object");
  EXPECT_EQ(refused([] { tree_of(R"([{"a":1},{"a":3}])"); }), "");
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_EQ(refused([&] { tree_of(nested(512)); }), "");
  EXPECT_EQ(refused([&] { tree_of(nested(513)); }), "values nested more than 512 deep");
  const std::string message = refused([] { tree_of("[1,]"); });
  EXPECT_TRUE(message.starts_with("not JSON: ")) << message;
  EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
  EXPECT_EQ(message.find("parse error at"), std::string::npos) << message;
  EXPECT_NE(message.find("syntax error"), std::string::npos) << message;
}

// What a document has, one line an item: the line of the text, the number, the geometry's type and the feature's id; or the message
// with its line.
std::string items_of(const std::string& text) {
  std::string found;
  io::GeoJsonItems items(text);
  const auto add = [&](const std::string& what, const JsonTree& feature) {
    found += std::to_string(items.line()) + " " + std::to_string(items.number()) + " " + what +
             (feature.is_null() ? "" : " " + feature.member("id").text()) + "\n";
  };
  const auto on_geometry = [&](const JsonTree& geometry, const JsonTree& feature) {
    add(io::geojson_type(geometry), feature);
  };
  const auto on_unlocated = [&](const JsonTree& feature) { add("nowhere", feature); };
  const std::string message = refused([&] { items.read({on_geometry, on_unlocated}); });
  if (message.empty()) {
    EXPECT_EQ(items.num_bytes_read(), text.size());
  } else {
    found += std::to_string(items.line()) + ": " + message;
  }
  return found;
}

const std::string point = R"({"type":"Point","coordinates":[1,2]})";

std::string feature_of(const std::string& geometry, const std::string& id = "7") {
  return R"({"type":"Feature","id":)" + id + R"(,"properties":{},"geometry":)" + geometry + "}";
}
std::string features_of(const std::string& items, const std::string& rest = "") {
  return R"({"type":"FeatureCollection",)" + rest + R"("features":[)" + items + "]}";
}

TEST(geojson_items, are_features_and_geometries) {
  EXPECT_EQ(items_of(point), "1 0 Point\n");
  EXPECT_EQ(items_of("\n" + feature_of(point)), "1 0 Point 7\n");
  EXPECT_EQ(items_of(features_of("")), "");
  EXPECT_EQ(items_of(features_of("\n" + feature_of(point) + ",\n\n" + feature_of("null", "\"a\"") +
                                 "," + feature_of(R"({"type":"Polygon","coordinates":[]})") + "," +
                                 feature_of(R"({"type":"Polygon"})"))),
            "2 0 Point 7\n4 1 nowhere \"a\"\n4 2 nowhere 7\n4 3 Polygon 7\n");
  EXPECT_EQ(
      items_of(R"({"type":"GeometryCollection","geometries":[)" + point + ",\n" + point + "]}"),
      "1 0 Point\n2 1 Point\n");
}

TEST(geojson_items, are_refused_where_they_are) {
  EXPECT_EQ(items_of(R"({"type":"FeatureCollection"})"),
            "1: FeatureCollection without an array \"features\"");
  EXPECT_EQ(items_of(R"({"type":"GeometryCollection","geometries":3})"),
            "1: GeometryCollection without an array \"geometries\"");
  EXPECT_EQ(items_of(features_of("3")), "1: features has members that are not objects");
  EXPECT_EQ(items_of(features_of("\n" + point)),
            "2: feature 0: type \"Point\" where a Feature is needed");
  EXPECT_EQ(items_of(features_of(feature_of(point) + ",\n{\"type\":\"Feature\"}")),
            "1 0 Point 7\n2: feature 1: no geometry");
  EXPECT_EQ(items_of(features_of(feature_of(point) + ",\n{\"type\":5}")),
            "1 0 Point 7\n2: feature 1: type \"\" where a Feature is needed");
  EXPECT_EQ(items_of(features_of(feature_of(point) + ",\n{\"a\":1,\n\"a\":2}")),
            "1 0 Point 7\n2: feature 1: two members \"a\" of one object");
  EXPECT_EQ(items_of("{\"type\":1,\n\"type\":2}"), "1: two members \"type\" of one object");
  const std::string broken = items_of(features_of(feature_of(point) + ",\n{\"a\":1,\n\n]"));
  EXPECT_TRUE(broken.starts_with("1 0 Point 7\n4: not JSON: ")) << broken;
}

TEST(geojson_items, are_in_degrees) {
  const auto is_known = [](const std::string& crs) {
    return items_of(R"({"type":"Point","crs":)" + crs + R"(,"coordinates":[1,2]})") ==
           "1 0 Point\n";
  };
  const auto named = [](const std::string& name) {
    return R"({"type":"name","properties":{"name":")" + name + "\"}}";
  };
  EXPECT_TRUE(is_known("null"));
  for (const char* const name :
       {"urn:ogc:def:crs:OGC:1.3:CRS84", "CRS84h", "CRS83", "WGS84", "EPSG:4326", "4979",
        "http://www.opengis.net/def/crs/EPSG/0/4269", "urn#4258", "IAU_2015:30100", "IAU2000:49902",
        "urn:ogc:def:crs:IAU::100"}) {
    EXPECT_TRUE(is_known(named(name))) << name;
  }
  for (const char* const name : {"EPSG:3857", "EPSG:14326", "CRS84x", "", "IAU_2015:30110",
                                 "IAU:00", "IAU:02", "IAU_2015:30101", "EPSG:30100", "4326:x"}) {
    EXPECT_FALSE(is_known(named(name))) << name;
  }
  EXPECT_TRUE(is_known(R"({"type":"EPSG","properties":{"code":4326}})"));
  EXPECT_FALSE(is_known(R"({"type":"EPSG","properties":{"code":3857}})"));
  EXPECT_TRUE(is_known(R"({"type":"link","properties":{"href":"http://x/4326"}})"));
  EXPECT_TRUE(is_known(R"({"properties":{"name":"EPSG:4326","code":3857}})"));
  EXPECT_TRUE(is_known("\"EPSG:4326\""));
  EXPECT_FALSE(is_known("\"EPSG:3857\""));
  // Wherever it is, also before the positions.
  const std::string bad = R"("crs":{"properties":{"name":"EPSG:3857"}},)";
  const std::string message = R"(the member "crs" names "EPSG:3857")";
  EXPECT_NE(items_of(features_of(feature_of(point), bad)).find(message), std::string::npos);
  EXPECT_EQ(items_of(features_of(feature_of(point), bad)).find("Point"), std::string::npos);
  EXPECT_TRUE(items_of(features_of("{" + bad + feature_of(point).substr(1)))
                  .starts_with("1: feature 0: " + message));
  EXPECT_TRUE(items_of(features_of(feature_of("{" + bad + point.substr(1))))
                  .starts_with("1: feature 0: " + message));
}

// The columns of features, whose text is their properties; "none" is for a row without a feature.
struct Properties {
  std::vector<Column> columns;
  Column ids;

  explicit Properties(const std::vector<std::string>& features, std::size_t forgotten = 99) {
    io::PropertyColumns collector(columns, ids);
    for (std::size_t row = 0; row < features.size(); ++row) {
      if (features[row] != "none") collector.add(tree_of(features[row]), row);
      if (row == forgotten) collector.forget_ids(row);
    }
    collector.finish(features.size());
  }
  // The cells of a column, as JSON.
  [[nodiscard]] std::string json(std::size_t c) const {
    std::string text;
    for (std::size_t row = 0; row < columns[c].ends.size(); ++row) {
      text += row == 0 ? "" : " ";
      io::append_value(text, columns[c], row);
    }
    return columns[c].name + ": " + text;
  }
};

TEST(geojson_properties, are_columns_of_json) {
  const Properties all({R"({"properties":{"a":1,"b":"x"}})", "none",
                        R"({"properties":{"b":"","c":[1,{"d":null}]}})",
                        R"({"properties":{"a":null,"b":"7"}})", R"({"properties":null})",
                        R"({"properties":{"a":2.5,"m":"t"}})", R"({"properties":{"m":3}})"});
  ASSERT_EQ(all.columns.size(), 4U);
  EXPECT_EQ(all.json(0), "a: 1 null null null null 2.5 null");
  EXPECT_EQ(all.json(1), "b: \"x\" null \"\" \"7\" null null null");
  EXPECT_EQ(all.json(2), "c: null null [1,{\"d\":null}] null null null null");
  EXPECT_EQ(all.json(3), "m: null null null null null \"t\" 3");
  EXPECT_TRUE(all.columns[0].is_numeric);
  EXPECT_TRUE(all.columns[0].is_json.empty());
  EXPECT_FALSE(all.columns[1].is_numeric);
  EXPECT_FALSE(all.columns[2].is_numeric);
  EXPECT_FALSE(all.columns[3].is_numeric);
  EXPECT_EQ(all.columns[1].is_json,
            (std::vector<bool>{false, true, false, false, true, true, true}));
  EXPECT_EQ(all.columns[3].is_json, (std::vector<bool>{true, true, true, true, true, false, true}));
  EXPECT_TRUE(all.ids.ends.empty());
  // Only texts that are not empty, and nulls: the kind of the column says it.
  const Properties texts({R"({"properties":{"t":"a"}})", R"({"properties":{"t":null}})"});
  EXPECT_TRUE(texts.columns[0].is_json.empty());
  EXPECT_EQ(texts.json(0), "t: \"a\" null");
  EXPECT_EQ(io::unquoted(tree_of("\"a\"")), "a");
  EXPECT_EQ(io::unquoted(tree_of("[\"a\"]")), "[\"a\"]");
}

TEST(geojson_properties, ids_are_those_of_their_rows) {
  const auto id_texts = [](const Properties& all, std::size_t count) {
    std::string text;
    for (std::size_t row = 0; row < count; ++row) {
      // {"type":"Feature","id":ID,"properties":{
      std::string feature;
      io::begin_feature(feature, row == 0, all.ids, row);
      const std::size_t begin = feature.find(R"("id":)");
      if (begin != std::string::npos) {
        text += feature.substr(begin, feature.find(R"("properties")") - begin);
      }
      text += ';';
    }
    return text;
  };
  const std::vector<std::string> features = {"none", R"({"id":"a"})", "none", R"({"id":-3})",
                                             R"({"id":null})"};
  const Properties all(features);
  EXPECT_EQ(id_texts(all, 6), ";\"id\":\"a\",;;\"id\":-3,;;;");
  EXPECT_TRUE(all.ids.is_numeric);
  EXPECT_EQ(all.ids.ends.size(), 5U);
  EXPECT_EQ(id_texts(Properties(features, 3), 5), ";\"id\":\"a\",;;;;");
  EXPECT_EQ(id_texts(Properties(features, 1), 5), ";;;\"id\":-3,;;");
  const std::vector<std::string> first = {R"({"id":1})", R"({"id":2})"};
  EXPECT_EQ(id_texts(Properties(first, 0), 2), ";\"id\":2,;");
  EXPECT_EQ(id_texts(Properties(first, 1), 2), "\"id\":1,;;");
}

TEST(geojson_properties, have_free_keys) {
  std::vector<Column> columns(3);
  columns[0].name = "a\"";
  columns[1].name = "area";
  columns[2].name = "b";
  EXPECT_EQ(io::property_keys(columns, {"area"}),
            (std::vector<std::string>{",\"a\\\"\":", ",\"area_\":", ",\"b\":"}));
  Column column{"n", true, "1", {1, 1}, {}};
  std::string text;
  for (std::size_t row = 0; row < 2; ++row) io::append_value(text += ' ', column, row);
  EXPECT_EQ(text, " 1 null");
  column.is_numeric = false;
  text.clear();
  for (std::size_t row = 0; row < 2; ++row) io::append_value(text += ' ', column, row);
  EXPECT_EQ(text, " \"1\" null");
  column.is_json = {true, false};
  text.clear();
  for (std::size_t row = 0; row < 2; ++row) io::append_value(text += ' ', column, row);
  EXPECT_EQ(text, " 1 \"\"");
}

}  // namespace
}  // namespace rondel::test::of_json
