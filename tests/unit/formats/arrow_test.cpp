// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays of Arrow that are written by hand here, and those of the library. The Python tests read and write them by pyarrow.

#include "rondel/arrow.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <limits>
#include <string>
#include <vector>

#include "rondel/error.h"
#include "rondel/regions.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

// Arrays whose memory is that of the test.
class HandMade {
 public:
  struct Field {
    ArrowSchema schema = {};
    ArrowArray array = {};
    std::array<const void*, 2> buffers = {};
    std::vector<ArrowSchema*> schemas;
    std::vector<ArrowArray*> arrays;
  };

  Field& field(const char* format, std::int64_t length, const void* values = nullptr) {
    Field& made = fields_.emplace_back();
    made.schema.format = format;
    made.schema.name = "";
    made.schema.release = [](ArrowSchema*) {};
    made.array.release = [](ArrowArray*) {};
    made.array.length = length;
    made.buffers[1] = values;
    made.array.buffers = made.buffers.data();
    made.array.n_buffers = values == nullptr ? 1 : 2;
    return made;
  }
  static Field& with_children(Field& parent, const std::vector<Field*>& children) {
    for (Field* const child : children) {
      parent.schemas.push_back(&child->schema);
      parent.arrays.push_back(&child->array);
    }
    parent.schema.children = parent.schemas.data();
    parent.array.children = parent.arrays.data();
    parent.schema.n_children = parent.array.n_children = static_cast<std::int64_t>(children.size());
    return parent;
  }
  // Names the type; the text lives as long as this object.
  void name(Field& field, const std::string& type, const std::string& metadata = "") {
    std::string& text = texts_.emplace_back();
    const auto append = [&](const std::string& part) {
      const auto size = static_cast<std::int32_t>(part.size());
      text.append(reinterpret_cast<const char*>(&size), sizeof size);
      text += part;
    };
    const std::int32_t pairs = 2;
    text.append(reinterpret_cast<const char*>(&pairs), sizeof pairs);
    append("ARROW:extension:metadata");
    append(metadata);
    append("ARROW:extension:name");
    append(type);
    field.schema.metadata = text.data();
  }

 private:
  std::deque<Field> fields_;
  std::deque<std::string> texts_;
};

const std::vector<double> triangle_numbers = {0, 0, 10, 0, 0, 10, 0, 0};

TEST(arrow, polygons_go_out_and_come_back) {
  LonLatMultiPolygons given;
  // Two polygons, the second with a hole; nothing; one polygon.
  given.offsets = {0, 2, 2, 3};
  given.rows.offsets = {0, 1, 3, 4};
  given.rows.rows.offsets = {0, 4, 8, 12, 16};
  for (int i = 0; i < 16; ++i) given.rows.rows.values.push_back({i * 1.0, -i * 0.5});
  ArrowSchema schema = {};
  ArrowArray array = {};
  export_arrow(given, PolygonEdges::geodesic, schema, array);
  EXPECT_EQ(array.length, 3);
  EXPECT_EQ(import_arrow(schema, array), given);
  // A library takes the polygons out, and releases the rest before them.
  ArrowArray polygons = *array.children[0];
  array.children[0]->release = nullptr;
  array.release(&array);
  EXPECT_EQ(array.release, nullptr);
  EXPECT_EQ(polygons.length, 3);
  EXPECT_EQ(static_cast<const std::int32_t*>(polygons.buffers[1])[3], 4);
  polygons.release(&polygons);
  schema.release(&schema);
  EXPECT_EQ(schema.release, nullptr);
}

TEST(arrow, what_was_released_is_refused) {
  LonLatMultiPolygons given;
  given.offsets = {0, 1};
  given.rows.offsets = {0, 1};
  given.rows.rows.offsets = {0, 4};
  given.rows.rows.values = {{0, 0}, {10, 0}, {0, 10}, {0, 0}};
  ArrowSchema schema = {};
  ArrowArray array = {};
  export_arrow(given, PolygonEdges::lonlat, schema, array);
  ArrowArray polygons = *array.children[0];  // which a library moves out
  array.children[0]->release = nullptr;
  const auto message = [&] {
    return thrown_message<InvalidInput>([&] { return import_arrow(schema, array); });
  };
  EXPECT_EQ(message(), "the array of Arrow was released");
  polygons.release(&polygons);
  array.release(&array);
  EXPECT_EQ(message(), "the array of Arrow was released");
  schema.release(&schema);
  EXPECT_EQ(message(), "the array of Arrow was released");
  EXPECT_EQ(thrown_message<InvalidInput>([&] { return import_arrow_geometries(schema, array); }),
            "the array of Arrow was released");
  EXPECT_THROW(import_arrow({}, {}), InvalidInput);
}

TEST(arrow, nothing_is_an_array) {
  ArrowSchema schema = {};
  ArrowArray array = {};
  export_arrow({}, PolygonEdges::lonlat, schema, array);
  EXPECT_EQ(array.length, 0);
  EXPECT_EQ(import_arrow(schema, array), LonLatMultiPolygons{});
  array.release(&array);
  schema.release(&schema);
}

LonLatGeometries some_geometries() {
  LonLatGeometries given;
  // Two points and a line; nothing; a line; a point beside a polygon.
  given.lines.offsets = {0, 3, 3, 4, 5};
  given.lines.rows.offsets = {0, 1, 4, 5, 7, 8};
  for (int i = 0; i < 8; ++i) given.lines.rows.values.push_back({i * 1.0, -i * 0.5});
  given.polygons.offsets = {0, 0, 0, 0, 1};
  given.polygons.rows.offsets = {0, 1};
  given.polygons.rows.rows.offsets = {0, 4};
  given.polygons.rows.rows.values = {{0, 0}, {10, 0}, {0, 10}, {0, 0}};
  return given;
}

TEST(arrow, points_lines_and_polygons_go_out_and_come_back) {
  const LonLatGeometries given = some_geometries();
  const auto gone_through = [&](ArrowParts parts) {
    ArrowSchema schema = {};
    ArrowArray array = {};
    export_arrow(given, parts, PolygonEdges::geodesic, schema, array);
    EXPECT_EQ(array.length, 4);
    LonLatGeometries found = import_arrow_geometries(schema, array);
    array.release(&array);
    schema.release(&schema);
    EXPECT_EQ(found.polygons.size(), 4U);
    EXPECT_EQ(found.lines.size(), 4U);
    return found;
  };
  const LonLatGeometries points = gone_through(ArrowParts::points);
  EXPECT_EQ(points.lines.offsets, (std::vector<std::uint64_t>{0, 2, 2, 2, 3}));
  EXPECT_EQ(points.lines.rows.offsets, (std::vector<std::uint64_t>{0, 1, 2, 3}));
  EXPECT_EQ(points.lines.rows.values, (std::vector<LonLat>{{0, 0}, {4, -2}, {7, -3.5}}));
  const LonLatGeometries lines = gone_through(ArrowParts::lines);
  EXPECT_EQ(lines.lines.offsets, (std::vector<std::uint64_t>{0, 1, 1, 2, 2}));
  EXPECT_EQ(lines.lines.rows.offsets, (std::vector<std::uint64_t>{0, 3, 5}));
  EXPECT_EQ(lines.lines.rows.values.back(), (LonLat{6, -3}));
  EXPECT_TRUE(lines.polygons.rows.rows.values.empty());
  EXPECT_EQ(gone_through(ArrowParts::polygons).polygons, given.polygons);
  LonLatGeometries wrong = given;
  wrong.lines.offsets.back() = 9;
  ArrowSchema schema = {};
  ArrowArray array = {};
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              export_arrow(wrong, ArrowParts::lines, PolygonEdges::lonlat, schema, array);
            }),
            "the offsets of the geometries do not fit");
}

TEST(arrow, single_points_and_lines_are_taken) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  HandMade made;
  const std::vector<double> numbers = {5, 5, 1, 2, nan, nan, 3, 4, 7, 8};
  auto& values = made.field("g", 10, numbers.data());
  auto& points = HandMade::with_children(made.field("+w:2", 4), {&values});
  points.array.offset = 1;
  // The last of the four points after the first position is null.
  const std::uint8_t there = 0b01111;
  points.buffers[0] = &there;
  points.array.null_count = 1;
  made.name(points, "geoarrow.point");
  const LonLatGeometries found = import_arrow_geometries(points.schema, points.array);
  EXPECT_EQ(found.lines.offsets, (std::vector<std::uint64_t>{0, 1, 1, 2, 2}));
  EXPECT_EQ(found.lines.rows.values, (std::vector<LonLat>{{1, 2}, {3, 4}}));
  EXPECT_EQ(found.polygons.size(), 4U);

  // A line of two positions, one without any, and one of a single position.
  const std::vector<std::int32_t> ends = {0, 2, 2, 3};
  auto& plain_values = made.field("g", 8, triangle_numbers.data());
  auto& places = HandMade::with_children(made.field("+w:2", 4), {&plain_values});
  auto& lines = HandMade::with_children(made.field("+l", 3, ends.data()), {&places});
  made.name(lines, "geoarrow.linestring");
  const LonLatGeometries of_lines = import_arrow_geometries(lines.schema, lines.array);
  EXPECT_EQ(of_lines.lines.offsets, (std::vector<std::uint64_t>{0, 1, 1, 2}));
  EXPECT_EQ(of_lines.lines.rows.offsets, (std::vector<std::uint64_t>{0, 2, 3}));
  EXPECT_EQ(of_lines.lines.rows.values.back(), (LonLat{0, 10}));
  made.name(lines, "geoarrow.wkb");
  EXPECT_EQ(thrown_message<InvalidInput>(
                [&] { (void)import_arrow_geometries(lines.schema, lines.array); }),
            "the array of Arrow has the type geoarrow.wkb, not geoarrow.point, "
            "geoarrow.linestring, geoarrow.polygon, or one of several of them");
}

TEST(arrow, levels_begin_where_they_say) {
  // Three polygons of a ring each, of which the last two are a part of longer arrays.
  HandMade made;
  const std::vector<std::int64_t> polygons = {7, 7, 1, 2, 3};
  const std::vector<std::int32_t> rings = {9, 9, 0, 4, 8};
  std::vector<double> x = {-1, -1};
  std::vector<double> y = {-1};
  for (int i = 0; i < 8; ++i) {
    x.push_back(i);
    y.push_back(10 + i);
  }
  auto& numbers_x = made.field("g", 8, x.data());
  numbers_x.array.offset = 2;
  auto& numbers_y = made.field("g", 8, y.data());
  numbers_y.array.offset = 1;
  auto& places = HandMade::with_children(made.field("+s", 8), {&numbers_x, &numbers_y});
  auto& row = HandMade::with_children(made.field("+l", 3, rings.data()), {&places});
  row.array.offset = 1;
  auto& all = HandMade::with_children(made.field("+L", 2, polygons.data()), {&row});
  all.array.offset = 2;
  made.name(all, "geoarrow.polygon");
  const LonLatMultiPolygons found = import_arrow(all.schema, all.array);
  EXPECT_EQ(found.offsets, (std::vector<std::uint64_t>{0, 1, 2}));
  EXPECT_EQ(found.rows.offsets, (std::vector<std::uint64_t>{0, 1, 2}));
  EXPECT_EQ(found.rows.rows.offsets, (std::vector<std::uint64_t>{0, 4, 8}));
  EXPECT_EQ(found.rows.rows.values.front(), (LonLat{0, 10}));
  EXPECT_EQ(found.rows.rows.values.back(), (LonLat{7, 17}));
}

// A polygon whose parts a test changes.
struct OnePolygon {
  HandMade made;
  std::vector<std::int32_t> offsets = {0, 1};
  std::vector<std::int32_t> ends = {0, 4};
  HandMade::Field& numbers = made.field("g", 8, triangle_numbers.data());
  HandMade::Field& places = HandMade::with_children(made.field("+w:2", 4), {&numbers});
  HandMade::Field& rings = HandMade::with_children(made.field("+l", 1, ends.data()), {&places});
  HandMade::Field& all = HandMade::with_children(made.field("+l", 1, offsets.data()), {&rings});
  OnePolygon() { made.name(all, "geoarrow.polygon"); }
  [[nodiscard]] std::string message() const {
    return thrown_message<InvalidInput>([&] { (void)import_arrow(all.schema, all.array); });
  }
};

TEST(arrow, what_does_not_fit_is_refused) {
  EXPECT_EQ(OnePolygon().message(), "");
  {
    OnePolygon one;
    one.made.name(one.all, "geoarrow.point");
    EXPECT_EQ(one.message(),
              "the array of Arrow has the type geoarrow.point, not geoarrow.polygon or "
              "geoarrow.multipolygon");
    one.all.schema.metadata = nullptr;
    EXPECT_EQ(one.message(), "the array of Arrow has no type of GeoArrow");
  }
  {
    OnePolygon one;
    one.ends = {0, 5};
    EXPECT_EQ(one.message(), "the array of Arrow has offsets that do not fit");
    one.ends = {-1, 4};
    EXPECT_EQ(one.message(), "the array of Arrow has offsets that do not fit");
    one.ends = {0, -4};
    EXPECT_EQ(one.message(), "the array of Arrow has offsets that do not fit");
  }
  {
    OnePolygon one;
    one.numbers.array.length = 7;
    EXPECT_EQ(one.message(), "the array of Arrow lacks coordinates");
    one.numbers.schema.format = "f";
    EXPECT_EQ(one.message(), "the array of Arrow has coordinates that are no doubles");
    one.places.schema.format = "u";
    EXPECT_EQ(one.message(), "the array of Arrow has the format 'u' where a position is needed");
    one.rings.schema.format = "u";
    EXPECT_EQ(one.message(), "the array of Arrow has the format 'u' where a list is needed");
  }
  {
    OnePolygon one;
    one.all.array.n_children = 0;
    EXPECT_EQ(one.message(), "the array of Arrow lacks its elements");
    one.all.array.n_buffers = 1;
    EXPECT_EQ(one.message(), "the array of Arrow lacks a buffer");
  }
  {
    OnePolygon one;
    const std::uint8_t none = 0;
    one.all.buffers[0] = &none;
    one.all.array.null_count = -1;
    EXPECT_EQ(one.message(), "the array of Arrow has a null that is a list of something");
    one.offsets = {0, 0};
    EXPECT_EQ(one.message(), "");
  }
}

TEST(arrow, other_coordinates_are_refused) {
  const auto message_of = [](const std::string& metadata) {
    OnePolygon one;
    one.made.name(one.all, "geoarrow.polygon", metadata);
    return one.message();
  };
  for (const char* const known :
       {"{}", R"({"crs":null})", R"({"crs":"OGC:CRS84"})",
        R"({"crs":"EPSG:4326","edges":"planar"})",
        R"({"crs":{"type":"GeographicCRS","id":{"authority":"EPSG","code":4326}}})",
        R"({"crs":{"id":{"authority":"OGC","code":"CRS84"}}})"}) {
    EXPECT_EQ(message_of(known), "") << known;
  }
  for (const char* const other : {R"({"crs":"EPSG:3857"})", R"({"crs":3})", R"({"crs":{}})",
                                  R"({"crs":{"id":{"authority":"EPSG","code":3857}}})"}) {
    EXPECT_EQ(message_of(other), "the array of Arrow has another CRS than OGC:CRS84 or EPSG:4326")
        << other;
  }
  EXPECT_EQ(
      message_of("crs").find("the array of Arrow has metadata of its type that cannot be read"),
      0U);
}

TEST(arrow, polygons_become_cells) {
  const OnePolygon one;
  const LonLatMultiPolygons polygons = import_arrow(one.all.schema, one.all.array);
  const CellTable table = cells_of_polygons(polygons);
  EXPECT_NEAR(areas(table.cells)[0], 0.01519, 1e-4);
  const LonLatMultiPolygons drawn = multipolygons(region_polygons(table.cells), 1);
  EXPECT_EQ(drawn.size(), 1U);
  EXPECT_EQ(cells_of_polygons(drawn).facts.remarks.size(), 0U);
  LonLatMultiPolygons open = polygons;
  open.rows.rows.values.back() = {1, 1};
  EXPECT_EQ(thrown_message<InvalidInput>([&] { (void)cells_of_polygons(open); }),
            "feature 0: a ring that is not closed, from 0 0 to 1 1");
  EXPECT_EQ(cells_of_polygons(open, {.invalid = InvalidPolygons::repair}).facts.faults.size(), 1U);
  open.rows.rows.values.back() = {1, 91};
  EXPECT_EQ(thrown_message<InvalidInput>([&] { (void)cells_of_polygons(open); }),
            "feature 0: latitude 91 is outside [-90, 90]");
  open.rows.offsets.back() = 7;
  EXPECT_EQ(thrown_message<InvalidInput>([&] { (void)cells_of_polygons(open); }),
            "the offsets of the polygons do not fit");
  const LonLatMultiPolygons bow{{0, 1},
                                {{0, 1}, {{0, 5}, {{0, 0}, {10, 10}, {10, 0}, {0, 10}, {0, 0}}}}};
  EXPECT_EQ(thrown_message<InvalidInput>([&] { (void)cells_of_polygons(bow); }),
            "feature 0: ring 0 of part 0 crosses itself at 5 5");
  const LonLatMultiPolygons twice{
      {0, 1, 2},
      {{0, 1, 2}, {{0, 4, 8}, {{0, 0}, {9, 0}, {0, 9}, {0, 0}, {0, 0}, {9, 0}, {0, 9}, {0, 0}}}}};
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              (void)cells_of_polygons(twice, {.overlap = PolygonOverlap::error});
            }).substr(0, 28),
            "features 0 and 1 overlap at ");
  EXPECT_EQ(
      thrown_message<InvalidInput>([&] { (void)multipolygons(region_polygons(table.cells), 0); }),
      "the arrays of the owners do not fit together");
}

}  // namespace
}  // namespace rondel::test
