// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Coordinates that are read from files: units, orders of dimensions, and places that are repeated.
#include "formats/cf_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "formats/mpas_places.h"
#include "io/bad_value.h"
#include "support/random.h"
#include "unit/io/classic_file.h"
#include "unit/io/support.h"

namespace rondel::test::of_degrees {
namespace {

using Doubles = std::vector<double>;
using Shape = std::vector<std::uint64_t>;
using Sizes = std::vector<std::size_t>;
using formats::UsualUnits;
using io::NetcdfReader;
using io::NetcdfType;
using Texts = std::vector<std::pair<std::string, std::string>>;

constexpr double degrees_per_radian = 180 / std::numbers::pi;

// A classic file with its reader.
struct OpenFile {
  std::string bytes;
  NetcdfReader reader;

  explicit OpenFile(const ClassicFile& file) : bytes(file.bytes()), reader(bytes) {}
  [[nodiscard]] const io::VariableInFile& at(std::string_view name) const {
    return reader.require(name);
  }
};

TEST(cf_reader, headers_have_names_and_texts) {
  ClassicFile file;
  file.dimensions = {{"x", 3}, {"y", 2}};
  file.variables = {classic_variable("v", NetcdfType::int16, {1, 0}, {1, 2, 3, 4, 5, 6},
                                     {{"units", "K"}, {"b", "c"}}),
                    classic_variable("t", NetcdfType::text, {0}, {65, 66, 67})};
  file.variables[0].attributes.push_back({"n", NetcdfType::int32, {}, {4}});
  const OpenFile open(file);
  const std::vector<VariableHeader> headers = formats::headers_of(open.reader);
  ASSERT_EQ(headers.size(), 2U);
  EXPECT_EQ(headers[0].name, "v");
  EXPECT_TRUE(headers[0].is_number);
  EXPECT_EQ(headers[0].dimensions, (std::vector<std::string>{"y", "x"}));
  EXPECT_EQ(headers[0].shape, (Shape{2, 3}));
  EXPECT_EQ(headers[0].texts, (Texts{{"units", "K"}, {"b", "c"}}));
  EXPECT_FALSE(headers[1].is_number);
}

TEST(cf_reader, degrees_are_of_units_relatives_or_what_is_usual) {
  ClassicFile file;
  file.dimensions = {{"x", 2}};
  const auto add = [&](const std::string& name, const std::string& units) {
    file.variables.push_back(classic_variable(name, NetcdfType::float64, {0}, {1, -2},
                                              units.empty() ? Texts{} : Texts{{"units", units}}));
  };
  add("plain", "");
  add("lonCell", "");
  add("in_radians", "radians");
  add("west", "degrees_west");
  add("meters", "m");
  add("blank", " ");
  file.variables.push_back(classic_variable("rotated", NetcdfType::float64, {0}, {1, -2},
                                            {{"standard_name", "grid_longitude"}}));
  file.variables.push_back(
      classic_variable("packed", NetcdfType::int16, {0}, {10, -1}, {{"units", "degrees"}}));
  file.variables.back().attributes.push_back({"scale_factor", NetcdfType::float64, {}, {0.5}});
  file.variables.back().attributes.push_back({"_FillValue", NetcdfType::int16, {}, {-1}});
  const OpenFile open(file);
  // The first value of the variable, which is 1 in its unit.
  const auto first = [&](const char* name, UsualUnits usual = UsualUnits::of_name,
                         std::initializer_list<const io::VariableInFile*> relatives = {}) {
    const Doubles values = formats::degrees_of(open.reader, open.at(name), usual, relatives);
    EXPECT_EQ(values.size(), 2U);
    EXPECT_EQ(values[1], -2 * values[0]);
    return values[0];
  };
  const auto* const radians = &open.at("in_radians");
  const auto* const west = &open.at("west");
  const auto* const blank = &open.at("blank");
  EXPECT_EQ(first("plain"), 1);
  EXPECT_EQ(first("lonCell"), degrees_per_radian);
  EXPECT_EQ(first("in_radians"), degrees_per_radian);
  EXPECT_EQ(first("west"), -1);
  EXPECT_EQ(first("plain", UsualUnits::radians), degrees_per_radian);
  EXPECT_EQ(first("plain", UsualUnits::radians, {blank, nullptr}), degrees_per_radian);
  EXPECT_EQ(first("lonCell", UsualUnits::degrees), 1);
  EXPECT_EQ(first("in_radians", UsualUnits::degrees), degrees_per_radian);
  EXPECT_EQ(first("plain", UsualUnits::of_name, {nullptr, radians}), degrees_per_radian);
  EXPECT_EQ(first("plain", UsualUnits::degrees, {nullptr, radians}), degrees_per_radian);
  EXPECT_EQ(first("plain", UsualUnits::of_name, {west}), -1);
  EXPECT_EQ(first("plain", UsualUnits::of_name, {nullptr, west}), 1);
  EXPECT_EQ(first("plain", UsualUnits::of_name, {blank, west}), 1);
  EXPECT_THROW(first("meters"), io::BadValue);
  EXPECT_THROW(first("rotated"), io::BadValue);
  EXPECT_THROW(first("rotated", UsualUnits::degrees), io::BadValue);
  const Doubles packed = formats::degrees_of(open.reader, open.at("packed"));
  EXPECT_EQ(packed[0], 5);
  EXPECT_TRUE(std::isnan(packed[1]));
  EXPECT_TRUE(std::isnan(formats::meant_numbers(open.reader, open.at("packed"))[1]));
}

TEST(cf_reader, meshes_in_the_plane_are_refused) {
  ClassicFile file;
  file.dimensions = {{"x", 1}};
  file.variables = {classic_variable("lon", NetcdfType::float64, {0}, {1})};
  for (const char* const answer : {"YES", "NO"}) {
    file.attributes = {{"on_a_sphere", NetcdfType::text, answer, {}}};
    const OpenFile open(file);
    const std::string expected =
        answer[0] == 'N' ? "the mesh is in the plane: on_a_sphere is NO" : "";
    EXPECT_EQ(refused([&] { formats::require_sphere(open.reader); }), expected);
    EXPECT_EQ(refused([&] { (void)formats::degrees_of(open.reader, open.at("lon")); }), expected);
  }
}

TEST(cf_reader, arrays_are_transposed_in_every_order) {
  for (const Shape& shape : {Shape{4}, Shape{2, 3}, Shape{2, 3, 4}, Shape{3, 1, 2, 2}}) {
    std::uint64_t size = 1;
    for (const std::uint64_t length : shape) size *= length;
    Doubles values(size);
    std::iota(values.begin(), values.end(), 0.0);
    Sizes order(shape.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    do {
      const Doubles found = formats::transposed(shape, order, values);
      ASSERT_EQ(found.size(), size);
      io::VariableInFile variable;
      variable.shape = shape;
      Sizes wanted;
      for (std::size_t d = 0; d < shape.size(); ++d) {
        variable.dimensions.push_back(7 * d + 3);
        wanted.push_back(7 * order[d] + 3);
      }
      EXPECT_EQ(formats::in_order(variable, wanted, values), found);
      for (std::size_t k = 0; k < size; ++k) {
        Sizes at(shape.size());
        std::size_t rest = k;
        for (std::size_t w = shape.size(); w-- > 0; rest /= shape[order[w]]) {
          at[order[w]] = rest % shape[order[w]];
        }
        std::size_t place = 0;
        for (std::size_t d = 0; d < shape.size(); ++d) place = place * shape[d] + at[d];
        EXPECT_EQ(found[k], static_cast<double>(place));
      }
    } while (std::ranges::next_permutation(order).found);
  }
  EXPECT_TRUE(formats::transposed(Shape{0, 2}, {1, 0}, {}).empty());
}

// Longitudes and latitudes along these dimensions, with these values.
struct Places {
  std::vector<io::NetcdfDimension> dimensions;
  Sizes of_lon;
  Sizes of_lat;
  Doubles lon;
  Doubles lat;

  [[nodiscard]] formats::PlaceArrays read() const {
    ClassicFile file;
    file.dimensions = dimensions;
    file.variables = {classic_variable("lon", NetcdfType::float64, of_lon, lon),
                      classic_variable("lat", NetcdfType::float64, of_lat, lat)};
    const OpenFile open(file);
    return formats::places_of(open.reader, open.at("lon"), open.at("lat"));
  }
};

void expect_places(const formats::PlaceArrays& found, const Sizes& dimensions, const Shape& shape,
                   const Sizes& repeated, const Doubles& lon, const Doubles& lat) {
  EXPECT_EQ(found.dimensions, dimensions);
  EXPECT_EQ(found.shape, shape);
  EXPECT_EQ(found.repeated, repeated);
  EXPECT_EQ(found.lon, lon);
  EXPECT_EQ(found.lat, lat);
}

TEST(cf_reader, places_are_those_of_the_longitudes) {
  expect_places(Places{{{"n", 3}}, {0}, {0}, {1, 2, 3}, {4, 5, 6}}.read(), {0}, {3}, {}, {1, 2, 3},
                {4, 5, 6});
  // Latitudes with their dimensions in the other order.
  expect_places(
      Places{{{"y", 2}, {"x", 3}}, {0, 1}, {1, 0}, {1, 2, 3, 1, 2, 4}, {5, 8, 6, 9, 7, 10}}.read(),
      {0, 1}, {2, 3}, {}, {1, 2, 3, 1, 2, 4}, {5, 6, 7, 8, 9, 10});
  EXPECT_EQ(refused([] {
              (void)Places{{{"n", 3}, {"m", 2}}, {0}, {1}, {1, 2, 3}, {4, 5}}.read();
            }),
            "variable \"lat\" has 2 values instead of 3");
}

TEST(cf_reader, places_that_are_repeated_are_read_once) {
  // Along time, which comes first: equal at 3 times.
  const Doubles lon = {1, 2, 1, 2};
  const Doubles lat = {5, 5, 6, 6};
  const auto repeat = [](const Doubles& values, std::size_t times) {
    Doubles all;
    for (std::size_t i = 0; i < times; ++i) all.insert(all.end(), values.begin(), values.end());
    return all;
  };
  Places grid{
      {{"time", 3}, {"y", 2}, {"x", 2}}, {0, 1, 2}, {0, 1, 2}, repeat(lon, 3), repeat(lat, 3)};
  expect_places(grid.read(), {1, 2}, {2, 2}, {0}, lon, lat);
  for (const bool of_lon : {false, true}) {  // they change at the last time
    Places moving = grid;
    (of_lon ? moving.lon : moving.lat).back() += 1;
    EXPECT_EQ(refused([&] { (void)moving.read(); }),
              "\"lon\" and \"lat\": longitudes and latitudes change along 'time'");
  }
  grid.lon[3] = grid.lon[7] = grid.lon[11] = std::numeric_limits<double>::quiet_NaN();
  const formats::PlaceArrays missing = grid.read();
  EXPECT_EQ(missing.shape, (Shape{2, 2}));
  EXPECT_TRUE(std::isnan(missing.lon[3]));
  // One time only.
  expect_places(Places{{{"time", 1}, {"y", 2}, {"x", 2}}, {0, 1, 2}, {0, 1, 2}, lon, lat}.read(),
                {1, 2}, {2, 2}, {0}, lon, lat);
  // A track that stays where it is has as many places as times.
  expect_places(Places{{{"time", 3}}, {0}, {0}, {1, 1, 1}, {2, 2, 2}}.read(), {0}, {3}, {},
                {1, 1, 1}, {2, 2, 2});
  // Of a track of several points the places change along time.
  expect_places(Places{{{"time", 2}, {"n", 2}}, {0, 1}, {0, 1}, {1, 2, 3, 4}, {5, 6, 7, 8}}.read(),
                {0, 1}, {2, 2}, {}, {1, 2, 3, 4}, {5, 6, 7, 8});
  // Time is the last dimension, or one of levels is in the middle.
  expect_places(Places{{{"y", 2}, {"x", 2}, {"time", 2}},
                       {0, 1, 2},
                       {0, 1, 2},
                       {1, 1, 2, 2, 3, 3, 4, 4},
                       {5, 5, 6, 6, 7, 7, 8, 8}}
                    .read(),
                {0, 1}, {2, 2}, {2}, {1, 2, 3, 4}, {5, 6, 7, 8});
  expect_places(Places{{{"y", 2}, {"level", 2}, {"x", 2}},
                       {0, 1, 2},
                       {0, 1, 2},
                       {1, 2, 1, 2, 3, 4, 3, 4},
                       {5, 6, 5, 6, 7, 8, 7, 8}}
                    .read(),
                {0, 2}, {2, 2}, {1}, {1, 2, 3, 4}, {5, 6, 7, 8});
  // Two dimensions are repeated, the first and the last one.
  expect_places(Places{{{"time", 2}, {"n", 2}, {"level", 2}},
                       {0, 1, 2},
                       {0, 1, 2},
                       {1, 1, 2, 2, 1, 1, 2, 2},
                       {5, 5, 6, 6, 5, 5, 6, 6}}
                    .read(),
                {1}, {2}, {0, 2}, {1, 2}, {5, 6});
}

// Longitudes and latitudes of a cell, in radians, and its point.
std::string refusal_of_cell(const Doubles& values, const std::string& kind = "Cell") {
  ClassicFile file;
  file.dimensions = {{"nCells", 2}};
  const char* const names[] = {"lon", "lat", "x", "y", "z"};
  const Doubles first = {0, 0, 6, 0, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    file.variables.push_back(
        classic_variable(names[i] + kind, NetcdfType::float64, {0}, {first[i], values[i]}));
  }
  const OpenFile open(file);
  return refused(
      [&] { (void)formats::places_of(open.reader, open.at("lon" + kind), open.at("lat" + kind)); });
}

TEST(cf_reader, places_of_mpas_are_those_of_its_points) {
  const double lon = 1.2;
  const double lat = -0.4;
  const double x = 3 * std::cos(lat) * std::cos(lon);
  const double y = 3 * std::cos(lat) * std::sin(lon);
  const double z = 3 * std::sin(lat);
  for (const char* const kind : {"Cell", "Edge", "Vertex"}) {
    EXPECT_EQ(refusal_of_cell({lon, lat, x, y, z}, kind), "");
    const std::string said = refusal_of_cell({lon, lat, y, x, z}, kind);
    EXPECT_TRUE(said.starts_with("value 1 of \"lon" + std::string(kind))) << said;
  }
  EXPECT_EQ(refusal_of_cell({lon, lat, y, x, z}, "Other"), "");
  EXPECT_EQ(refusal_of_cell({lon + 5e-6, lat, x, y, z}), "");
  for (const double off : {2e-5, -2e-5}) {
    EXPECT_NE(refusal_of_cell({lon + off, lat, x, y, z}), "");
    EXPECT_NE(refusal_of_cell({lon, lat + off, x, y, z}), "");
    EXPECT_NE(refusal_of_cell({lon, lat, x, y, z + 3 * off}), "");
  }
  EXPECT_EQ(refusal_of_cell({lon, lat, 0, 0, 0}), "");
  EXPECT_NE(refusal_of_cell({lon, lat, -x, -y, -z}), "");
}

}  // namespace
}  // namespace rondel::test::of_degrees
