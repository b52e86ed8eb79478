// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons and lines of GeoJSON, kind by kind, and every way in which a geometry can be wrong (RFC 7946, section 3.1).
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "io/geojson_polygons.h"
#include "unit/io/support.h"

namespace rondel::test {
namespace {

using io::FeatureKinds;
using map::PolygonFeatures;
using Ring = std::vector<LonLat>;
using Lines = std::vector<std::vector<LonLat>>;

std::string file_of(const std::string& text) {
  static const TemporaryDirectory directory;
  return directory.with("features.geojson", text);
}

std::string feature(const std::string& geometry) {
  return R"({"type": "Feature", "properties": {}, "geometry": )" + geometry + "}";
}

std::string geometry(const std::string& type, const std::string& coordinates) {
  return R"({"type": ")" + type + R"(", "coordinates": )" + coordinates + "}";
}

// The first feature of a file with a feature that has no place behind it.
PolygonFeatures read(const std::string& text, FeatureKinds kinds = FeatureKinds::all) {
  const std::string path = file_of(R"({"type": "FeatureCollection", "features": [)" +
                                   feature(text) + ",\n" + feature("null") + "]}");
  PolygonFeatures features = io::read_polygon_features({path}, kinds);
  EXPECT_EQ(features.files.front().name, path);
  EXPECT_EQ(features.rings.size(), 2U);
  EXPECT_EQ(features.lines.size(), 2U);
  EXPECT_TRUE(features.rings.at(1).empty() && features.lines.at(1).empty());
  return features;
}

// The message for a geometry, without the file and its place in it; empty if there is none.
std::string refusal_of_features(const std::string& text, FeatureKinds kinds = FeatureKinds::all) {
  const std::string message = message_of([&] { (void)read(text, kinds); });
  const std::string start = file_of("") + ":1: feature 0: ";
  EXPECT_TRUE(message.empty() || message.starts_with(start)) << message;
  return message.substr(std::min(message.size(), start.size()));
}

const std::string square = "[[0,0],[9,0],[9,9],[0,9],[0,0]]";
const std::string hole = "[[2,2],[2,4],[4,4],[2,2]]";
const Ring square_ring = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};
const Ring hole_ring = {{2, 2}, {2, 4}, {4, 4}};

TEST(geojson_features, have_the_rings_of_their_polygons) {
  const std::string polygon = "[" + square + "," + hole + "]";
  const std::string collection = R"({"type": "GeometryCollection", "geometries": [)" +
                                 geometry("Polygon", polygon) + "," +
                                 geometry("MultiPolygon", "[" + polygon + "]") + "]}";
  for (const FeatureKinds kinds : {FeatureKinds::all, FeatureKinds::polygons}) {
    for (const auto& [text, times] :
         {std::pair(geometry("Polygon", polygon), 1U),
          std::pair(geometry("MultiPolygon", "[" + polygon + "," + polygon + "]"), 2U),
          std::pair(collection, 2U)}) {
      const PolygonFeatures features = read(text, kinds);
      const auto& rings = features.rings.at(0);
      ASSERT_EQ(rings.size(), 2 * times);
      for (std::size_t k = 0; k < rings.size(); ++k) {
        EXPECT_EQ(rings[k].positions, k % 2 == 0 ? square_ring : hole_ring);
        EXPECT_EQ(rings[k].is_hole, k % 2 == 1);
        EXPECT_FALSE(rings[k].is_turn);
      }
      EXPECT_TRUE(features.lines.at(0).empty());
    }
  }
}

// A ring that ends whole turns away from its beginning goes around a pole.
TEST(geojson_features, may_go_around_a_pole) {
  const auto ring = [](const std::string& last) {
    return read(geometry("Polygon", "[[[-180,60],[-60,60],[60,60]," + last + "]]")).rings[0].at(0);
  };
  EXPECT_TRUE(ring("[180,60]").is_turn);
  EXPECT_TRUE(ring("[540,60]").is_turn);
  EXPECT_FALSE(ring("[-180,60]").is_turn);
  EXPECT_TRUE(
      read(geometry("Polygon", "[[[10,60],[130,60],[250,60],[370,60]]]")).rings[0][0].is_turn);
  EXPECT_EQ(ring("[180,60]").positions, (Ring{{-180, 60}, {-60, 60}, {60, 60}}));
  for (const auto& [last, place] :
       {std::pair{"[180,61]", "180 61"}, {"[179,60]", "179 60"}, {"[-180,59]", "-180 59"}}) {
    EXPECT_EQ(refusal_of_features(
                  geometry("Polygon", "[[[-180,60],[-60,60],[60,60]," + std::string(last) + "]]")),
              "a ring that is not closed, from -180 60 to " + std::string(place) +
                  "; --invalid repair (invalid='repair' in Python) closes it");
  }
}

TEST(geojson_features, have_lines_and_points_where_these_are_wanted) {
  const std::string line = "[[1,2],[3,4,500],[5,6]]";
  const std::vector<LonLat> along = {{1, 2}, {3, 4}, {5, 6}};
  for (const auto& [text, lines] :
       {std::pair(geometry("Point", "[1,2]"), Lines{{{1, 2}}}),
        std::pair(geometry("MultiPoint", "[[1,2],[3,4]]"), Lines{{{1, 2}}, {{3, 4}}}),
        std::pair(geometry("LineString", line), Lines{along}),
        std::pair(geometry("MultiLineString", "[" + line + "," + line + "]"),
                  Lines{along, along})}) {
    const PolygonFeatures features = read(text);
    EXPECT_EQ(features.lines.at(0), lines) << text;
    EXPECT_TRUE(features.rings.at(0).empty());
    EXPECT_NE(refusal_of_features(text, FeatureKinds::polygons), "") << text;
  }
  EXPECT_EQ(refusal_of_features(geometry("Point", "[1,2]"), FeatureKinds::polygons),
            R"(type "Point" where a Polygon is needed)");
}

TEST(geojson_features, are_refused_with_what_is_wrong) {
  EXPECT_EQ(refusal_of_features(geometry("Circle", "[1,2]")),
            R"(type "Circle" where a geometry is needed)");
  EXPECT_EQ(refusal_of_features(geometry("Polygon", "7")),
            "Polygon without an array of coordinates");
  EXPECT_EQ(refusal_of_features(geometry("Polygon", "{}")),
            "Polygon without an array of coordinates");
  for (const char* const type : {"MultiPolygon", "MultiPoint", "MultiLineString"}) {
    EXPECT_EQ(refusal_of_features(geometry(type, "{}")),
              std::string(type) + " without an array of coordinates");
  }
  EXPECT_EQ(refusal_of_features(geometry("MultiPolygon", "[7]")),
            "Polygon without an array of coordinates");
  EXPECT_EQ(refusal_of_features(geometry("Polygon", "[7]")), "a ring that is no array");
  EXPECT_EQ(refusal_of_features(geometry("Polygon", "[[[0,0],[1,0],[0,0]]]")),
            "a ring of 3 positions");
  EXPECT_EQ(refusal_of_features(geometry("Polygon", "[[]]")), "a ring of 0 positions");
  EXPECT_EQ(refusal_of_features(geometry("Polygon", "[[[0,0],[1,0],[1,1],[0,1]]]")),
            "a ring that is not closed, from 0 0 to 0 1; --invalid repair (invalid='repair' in "
            "Python) closes it");
  EXPECT_EQ(refusal_of_features(geometry("LineString", "{}")), "a line that is no array");
  EXPECT_EQ(refusal_of_features(geometry("LineString", "[[1,2]]")), "a line of 1 positions");
  EXPECT_EQ(refusal_of_features(geometry("MultiLineString", "[[[1,2],[3,4]],[[1,2]]]")),
            "a line of 1 positions");
  EXPECT_EQ(refusal_of_features(R"({"type": "GeometryCollection", "geometries": 7})"),
            "GeometryCollection without members");
  for (const char* const wrong : {"7", "[1]", R"(["1",2])", R"([1,"2"])", "[null,2]", "{}"}) {
    const std::string message =
        refusal_of_features(geometry("MultiPoint", "[[1,2]," + std::string(wrong) + "]"));
    EXPECT_TRUE(message.ends_with(" are not [lon, lat]")) << message;
  }
  EXPECT_NE(refusal_of_features(geometry("Point", "[1,91]")), "");
}

TEST(geojson_features, are_in_a_file_that_has_some) {
  const auto message = [](const std::string& text) {
    return message_of([&] { (void)io::read_polygon_features({file_of(text)}, FeatureKinds::all); });
  };
  EXPECT_EQ(message(""), file_of("") + ": the file is empty");
  EXPECT_EQ(message(R"({"type": "FeatureCollection"})"),
            file_of("") + R"(:1: FeatureCollection without an array "features")");
  EXPECT_EQ(message(R"({"type": "FeatureCollection", "features": [7]})"),
            file_of("") + ":1: features has members that are not objects");
  EXPECT_EQ(message("{\"type\": \"FeatureCollection\",\n\"features\": [\n{\"type\": \"Point\"}]}"),
            file_of("") + R"(:3: feature 0: type "Point" where a Feature is needed)");
  EXPECT_EQ(message(R"({"type": "Feature", "properties": {}})"), file_of("") + ":1: no geometry");
  // A bare geometry is a file, too.
  const std::string path = file_of(geometry("Polygon", "[" + square + "]"));
  EXPECT_EQ(io::read_polygon_features({path}, FeatureKinds::all).rings.size(), 1U);
}

}  // namespace
}  // namespace rondel::test
