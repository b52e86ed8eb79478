// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Units, coordinates, lines of axes and missing values, case by case. Tests in Python compare the units with UDUNITS and whole files
// with other readers.

#include "rondel/conventions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "formats/cf_reader.h"
#include "formats/cf_values.h"
#include "io/bad_value.h"
#include "rondel/error.h"

namespace rondel::test {
namespace {

using Doubles = std::vector<double>;
using Texts = std::vector<std::pair<std::string, std::string>>;
constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

VariableHeader header(const std::string& name, const std::vector<std::string>& dimensions,
                      const Texts& texts = {}) {
  return {name, true, dimensions, std::vector<std::uint64_t>(dimensions.size(), 4), texts};
}

// The pairs of highest rank, as "lon/lat bounds/bounds".
std::vector<std::string> best(const std::vector<VariableHeader>& headers,
                              const CoordinateQuery& query = {}) {
  std::vector<std::string> found;
  int rank = 0;
  for (const CoordinatePair& pair : find_coordinates(headers, query)) {
    if (!found.empty() && pair.rank < rank) break;
    rank = pair.rank;
    found.push_back(headers[pair.lon].name + "/" + headers[pair.lat].name);
    if (pair.lon_bounds != CoordinatePair::none && pair.lat_bounds != CoordinatePair::none) {
      found.back() += " " + headers[pair.lon_bounds].name + "/" + headers[pair.lat_bounds].name;
    }
  }
  return found;
}

TEST(conventions, units_have_the_spellings_of_udunits) {
  for (const char* text : {"degrees", "degree", "Degrees", "DEGREES_EAST", "degree_north",
                           "degreeN", "degrees_E", "arcdeg", "arc_degree", " degrees ", "deg"}) {
    EXPECT_EQ(degrees_per_unit(text), 1) << text;
  }
  for (const char* text : {"radian", "radians", "Radian", "RADIANS", "rad"}) {
    EXPECT_EQ(degrees_per_unit(text), 57.29577951308232) << text;
  }
  EXPECT_EQ(degrees_per_unit("degrees_west"), -1);
  // RAD is not the symbol; the others are no angles.
  for (const char* text : {"", "RAD", "rads", "degC", "degrees_celsius", "K", "m", "1", "degF"}) {
    EXPECT_FALSE(degrees_per_unit(text).has_value()) << text;
  }
}

TEST(conventions, what_has_no_units_has_those_of_its_convention) {
  EXPECT_NEAR(degrees_per_unit(header("lonCell", {"nCells"})), 57.3, 0.1);
  EXPECT_NEAR(degrees_per_unit(header("vlat", {"vertex"}, {{"units", " "}})), 57.3, 0.1);
  EXPECT_EQ(degrees_per_unit(header("lon", {"lon"})), 1);
  const VariableHeader radians = header("clon", {"cell"}, {{"units", "radian"}});
  const VariableHeader* const of_bounds[] = {&radians};
  EXPECT_NEAR(degrees_per_unit(header("clon_bnds", {"cell", "nv"}), of_bounds), 57.3, 0.1);
  const VariableHeader own = header("clon_bnds", {"cell", "nv"}, {{"units", "degrees"}});
  EXPECT_EQ(degrees_per_unit(own, of_bounds), 1);
  EXPECT_THROW((void)degrees_per_unit(header("x", {"x"}, {{"units", "m"}})), InvalidInput);
}

TEST(conventions, what_has_no_units_has_those_of_the_first_relative_with_some) {
  const VariableHeader none = header("lon_corners", {"cell", "nv"});
  const VariableHeader lon = header("lon", {"cell"});
  const VariableHeader blank = header("lon", {"cell"}, {{"units", " "}});
  const VariableHeader west = header("lon", {"cell"}, {{"units", "degrees_west"}});
  const VariableHeader radians = header("lat", {"cell"}, {{"units", "radians"}});
  const VariableHeader meters = header("lat", {"cell"}, {{"units", "m"}});
  const auto unit = [&](const VariableHeader* first, const VariableHeader* second) {
    const VariableHeader* const relatives[] = {first, second};
    return degrees_per_unit(none, relatives);
  };
  EXPECT_EQ(unit(nullptr, nullptr), 1);
  EXPECT_EQ(unit(&lon, &blank), 1);
  for (const VariableHeader* const first : {&lon, &blank}) {
    EXPECT_NEAR(unit(first, &radians), 57.3, 0.1);
  }
  EXPECT_NEAR(unit(nullptr, &radians), 57.3, 0.1);
  EXPECT_EQ(unit(&west, &radians), -1);  // corners are west as the centers are
  EXPECT_EQ(unit(nullptr, &west), 1);    // latitudes are not
  EXPECT_THROW((void)unit(&lon, &meters), InvalidInput);
}

TEST(conventions, coordinates_are_found_by_attributes_then_names) {
  const Texts east = {{"units", "degrees_east"}};
  const Texts north = {{"units", "degrees_north"}};
  EXPECT_EQ(best({header("y", {"y"}, north), header("x", {"x"}, east)}),
            (std::vector<std::string>{"x/y"}));
  EXPECT_EQ(best({header("nav_lon", {"y", "x"}), header("nav_lat", {"x", "y"})}),
            (std::vector<std::string>{"nav_lon/nav_lat"}));
  // Units or a standard name deny what a name says.
  EXPECT_TRUE(best({header("lon", {"n"}, {{"units", "m"}}), header("lat", {"n"})}).empty());
  EXPECT_TRUE(
      best({header("lon", {"n"}, {{"standard_name", "grid_longitude"}}), header("lat", {"n"})})
          .empty());
  // Coordinates on other dimensions do not belong together.
  EXPECT_TRUE(best({header("lon", {"y", "x"}), header("lat", {"y"})}).empty());
  EXPECT_EQ(best({header("lon", {"n"}), header("lat", {"n"}), header("longitude", {"n"})}),
            (std::vector<std::string>{"lon/lat", "longitude/lat"}));
  EXPECT_EQ(best({header("a", {"n"}), header("b", {"n"})}, {"a", "b", ""}),
            (std::vector<std::string>{"a/b"}));
  EXPECT_THROW((void)find_coordinates({}, {"a", "", ""}), InvalidInput);
}

// Attributes of both coordinates say more than names, and standard names more than units.
TEST(conventions, coordinates_are_ranked_by_what_says_that_they_are_some) {
  const Texts east = {{"units", "degrees_east"}};
  const Texts north = {{"units", "degrees_north"}};
  const Texts x_axis = {{"_CoordinateAxisType", "Lon"}};
  const Texts y_axis = {{"_CoordinateAxisType", "Lat"}};
  const Texts longitude = {{"standard_name", "longitude"}};
  const Texts latitude = {{"standard_name", "latitude"}};
  const auto best_of = [](const Texts& lon, const Texts& lat, const Texts& a, const Texts& b) {
    return best({header("lon", {"j", "i"}, lon), header("lat", {"j", "i"}, lat),
                 header("a", {"y", "x"}, a), header("b", {"y", "x"}, b)});
  };
  using DimensionNames = std::vector<std::string>;
  EXPECT_EQ(best_of({}, {}, east, north), (DimensionNames{"a/b"}));
  EXPECT_EQ(best_of({}, {}, x_axis, y_axis), (DimensionNames{"a/b"}));
  EXPECT_EQ(best_of({}, {}, east, {}), (DimensionNames{"lon/lat"}));
  EXPECT_EQ(best_of(east, north, longitude, latitude), (DimensionNames{"a/b"}));
  EXPECT_EQ(best_of(longitude, latitude, east, north), (DimensionNames{"lon/lat"}));
  EXPECT_EQ(best_of(east, {}, longitude, latitude), (DimensionNames{"a/b"}));
  EXPECT_EQ(best_of(x_axis, y_axis, east, north), (DimensionNames{"lon/lat", "a/b"}));
  EXPECT_EQ(best_of(north, east, {}, {}), (DimensionNames{"lat/lon"}));  // whatever their names are
}

TEST(conventions, listed_coordinates_come_before_axes_that_pretend) {
  const Texts east = {{"units", "degrees_east"}};
  const Texts north = {{"units", "degrees_north"}};
  std::vector<VariableHeader> headers = {
      header("Xdim", {"Xdim"}, east), header("Ydim", {"Ydim"}, north),
      header("lons", {"nf", "Ydim", "Xdim"}, east), header("lats", {"nf", "Ydim", "Xdim"}, north),
      header("T", {"time", "nf", "Ydim", "Xdim"})};
  EXPECT_EQ(best(headers), (std::vector<std::string>{"Xdim/Ydim"}));
  headers.back().texts.emplace_back("coordinates", "lons lats");
  EXPECT_EQ(best(headers), (std::vector<std::string>{"lons/lats"}));
  headers.push_back(header("corner_lons", {"nf", "YCdim", "XCdim"}, east));
  headers.push_back(header("corner_lats", {"nf", "YCdim", "XCdim"}, north));
  EXPECT_EQ(best(headers), (std::vector<std::string>{"lons/lats corner_lons/corner_lats"}));
  // A variable on a staggered grid has the coordinates of that grid.
  headers.push_back(header("U", {"Ydim", "Xdim"}));
  EXPECT_EQ(best(headers, {"", "", "U"}), (std::vector<std::string>{"Xdim/Ydim"}));
}

TEST(conventions, bounds_that_are_not_there_are_told) {
  std::vector<std::string> remarks;
  const std::vector<VariableHeader> headers = {header("lon", {"lon"}, {{"bounds", "lon_bnds"}}),
                                               header("lat", {"lat"})};
  const auto pairs = find_coordinates(headers, {}, &remarks);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].lon_bounds, CoordinatePair::none);
  EXPECT_EQ(remarks, (std::vector<std::string>{"there is no variable 'lon_bnds', which the "
                                               "attribute bounds of 'lon' names"}));
}

TEST(conventions, places_repeat_along_time) {
  const auto repeated = [](const std::vector<std::string>& names,
                           const std::vector<std::uint64_t>& shape, const Doubles& lon,
                           const Doubles& lat) {
    return repeated_dimensions(names, shape, lon, lat);
  };
  using Answers = std::vector<bool>;
  const Doubles lon = {0, 1, 0, 1, 0, 1, 0, 1};
  const Doubles lat = {5, 5, 6, 6, 5, 5, 6, 6};
  EXPECT_EQ(repeated({"Time", "y", "x"}, {2, 2, 2}, lon, lat), (Answers{true, false, false}));
  EXPECT_EQ(
      repeated({"y", "x", "Time"}, {2, 2, 2}, {0, 0, 1, 1, 0, 0, 1, 1}, {5, 5, 5, 5, 6, 6, 6, 6}),
      (Answers{false, false, true}));
  // A face of a cube is no time, also if there is one only.
  EXPECT_EQ(repeated({"nf", "y", "x"}, {1, 2, 2}, {0, 1, 0, 1}, {5, 5, 6, 6}),
            (Answers{false, false, false}));
  EXPECT_EQ(repeated({"time", "n"}, {1, 2}, {0, 1}, {5, 5}), (Answers{true, false}));
  // A track moves; a grid that does is refused.
  EXPECT_EQ(repeated({"time", "n"}, {2, 1}, {0, 1}, {5, 5}), (Answers{false, false}));
  EXPECT_THROW((void)repeated({"Time", "y", "x"}, {2, 2, 2}, {0, 1, 0, 1, 0, 1, 0, 2}, lat),
               InvalidInput);
  const Doubles few(4);
  EXPECT_THROW((void)repeated({"y", "x"}, {2, 2}, lon, lat), InvalidInput);
  EXPECT_THROW((void)repeated({"y", "x"}, {2, 2}, few, lat), InvalidInput);
  EXPECT_THROW((void)repeated({"y", "x"}, {2, 2}, lon, few), InvalidInput);
  EXPECT_THROW((void)repeated({"y"}, {2, 2}, few, few), InvalidInput);
}

using DimensionNames = std::vector<std::string>;
using DimensionLengths = std::vector<std::uint64_t>;

// Returns the names of the dimensions of records, or those of the dimension along which cells
// change with "moves along" before it.
DimensionNames records_of(const DimensionNames& dimensions, const DimensionLengths& shape,
                          const DimensionNames& places, const DimensionLengths& lengths,
                          const Doubles& values, const DimensionNames& repeated = {}) {
  DimensionNames found;
  try {
    const std::vector<bool> are_records =
        record_dimensions({dimensions, shape, places, lengths, repeated}, values);
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
      if (are_records[d]) found.push_back(dimensions[d]);
    }
  } catch (const InvalidInput& error) {
    found.push_back("moves along " + dimensions[error.index()]);
  }
  return found;
}

// Returns the values of an array of these lengths at each of its indices.
Doubles values_of_array(const DimensionLengths& shape,
                        const std::function<double(const std::vector<std::size_t>&)>& value) {
  Doubles values;
  std::vector<std::size_t> at(shape.size(), 0);
  for (bool is_over = false; !is_over;) {
    values.push_back(value(at));
    is_over = true;
    for (std::size_t d = shape.size(); is_over && d-- > 0;) {
      at[d] = at[d] + 1 < shape[d] ? at[d] + 1 : 0;
      is_over = at[d] == 0;
    }
  }
  return values;
}

TEST(conventions, bounds_of_axes_repeat_in_any_order_of_dimensions) {
  const DimensionNames axis = {"lat"};
  const auto bounds = [](std::size_t cell, std::size_t corner) {
    return static_cast<double>(10 * cell + 10 * corner);
  };
  EXPECT_EQ(
      records_of({"time", "lat", "bnds"}, {2, 3, 2}, axis, {3},
                 values_of_array({2, 3, 2}, [&](const auto& at) { return bounds(at[1], at[2]); })),
      DimensionNames{"time"});
  EXPECT_EQ(
      records_of({"lat", "bnds", "t"}, {3, 2, 2}, axis, {3},
                 values_of_array({3, 2, 2}, [&](const auto& at) { return bounds(at[0], at[1]); })),
      DimensionNames{"t"});
  // DimensionNames that are none of time: bounds never repeat along the corners.
  EXPECT_EQ(
      records_of({"bnds", "level", "lat"}, {2, 2, 3}, axis, {3},
                 values_of_array({2, 2, 3}, [&](const auto& at) { return bounds(at[2], at[0]); })),
      DimensionNames{"level"});
  EXPECT_EQ(records_of({"member", "time", "lat", "bnds"}, {2, 1, 3, 2}, axis, {3},
                       values_of_array({2, 1, 3, 2},
                                       [&](const auto& at) { return bounds(at[2], at[3]); })),
            (DimensionNames{"member", "time"}));
  // Lines between cells, one more than these, on a dimension of their own.
  EXPECT_EQ(
      records_of({"time", "lines"}, {2, 4}, axis, {3},
                 values_of_array({2, 4}, [](const auto& at) { return 10.0 * double(at[1]); })),
      DimensionNames{"time"});
  // Two dimensions are those of cells and corners, whatever their names are.
  EXPECT_EQ(records_of({"lat", "time"}, {3, 2}, axis, {3}, {0, 1, 1, 2, 2, 3}), DimensionNames{});
}

TEST(conventions, bounds_that_change_along_records_are_refused) {
  const auto moving = [](std::size_t record, std::size_t cell, std::size_t corner) {
    return static_cast<double>(10 * cell + 10 * corner + record);
  };
  for (const std::string name : {"time", "member"}) {
    EXPECT_EQ(
        records_of({name, "lat", "bnds"}, {2, 3, 2}, {"lat"}, {3},
                   values_of_array({2, 3, 2},
                                   [&](const auto& at) { return moving(at[0], at[1], at[2]); })),
        DimensionNames{"moves along " + name});
  }
  // A record that is missing is another one; records that are all missing are the same.
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(records_of({"time", "x", "v"}, {2, 1, 3}, {"x"}, {1}, {0, 1, 2, 0, none, 2}),
            DimensionNames{"moves along time"});
  EXPECT_EQ(records_of({"time", "x", "v"}, {2, 1, 3}, {"x"}, {1}, {0, none, 2, 0, none, 2}),
            DimensionNames{"time"});
}

TEST(conventions, bounds_of_curvilinear_grids_repeat) {
  const DimensionNames places = {"y", "x"};
  const DimensionLengths lengths = {2, 3};
  const auto corner = [](std::size_t y, std::size_t x, std::size_t v) {
    return static_cast<double>(100 * y + 10 * x + v);
  };
  EXPECT_EQ(
      records_of({"y", "x", "v", "time"}, {2, 3, 4, 2}, places, lengths,
                 values_of_array({2, 3, 4, 2},
                                 [&](const auto& at) { return corner(at[0], at[1], at[2]); })),
      DimensionNames{"time"});
  // The coordinate repeats along a dimension, too: as it says, that counts no corners.
  EXPECT_EQ(records_of({"nf", "y", "x", "v"}, {2, 2, 3, 4}, places, lengths,
                       values_of_array({2, 2, 3, 4},
                                       [&](const auto& at) { return corner(at[1], at[2], at[3]); }),
                       {"nf"}),
            DimensionNames{"nf"});
  // The nodes of the grid have dimensions of their own, one longer, in either order.
  const auto node = [](const auto& at) { return static_cast<double>(10 * at[1] + at[2]); };
  EXPECT_EQ(records_of({"time", "xq", "yq"}, {2, 4, 3}, places, lengths,
                       values_of_array({2, 4, 3}, node)),
            DimensionNames{"time"});
  EXPECT_EQ(records_of({"level", "yq", "xq"}, {2, 3, 4}, places, lengths,
                       values_of_array({2, 3, 4}, node)),
            DimensionNames{"level"});
  EXPECT_EQ(records_of({"yq", "xq"}, {3, 4}, places, lengths, Doubles(12)), DimensionNames{});
  EXPECT_THROW((void)record_dimensions({places, lengths, places, lengths, {}}, Doubles(5)),
               InvalidInput);
  EXPECT_THROW((void)record_dimensions({places, {}, places, lengths, {}}, Doubles(1)),
               InvalidInput);
}

TEST(conventions, sums_over_cells_are_told_by_cell_methods) {
  for (const char* const text :
       {"area: sum", "time: mean area: sum", "area: sum time: maximum", "lat: lon: sum",
        "lat: sum lon: sum", "longitude: latitude: sum", "time: mean (interval: 1 hour) x: y: sum",
        "ncells: sum", "area: sum where land (comment: area: mean)", "area: mean area: Sum"}) {
    EXPECT_TRUE(are_sums_over_cells(text)) << text;
  }
  for (const char* const text :
       {"", "time: sum", "area: mean", "lat: sum", "lon: sum lat: mean", "area: sum area: mean",
        "area: mean (comment: area: sum)", "lat: lon: mean time: sum", "area: sum lat: lon: mean",
        "sum", "area:"}) {
    EXPECT_FALSE(are_sums_over_cells(text)) << text;
  }
  // Dimensions that have names of their own.
  const std::vector<std::string> places = {"row", "column"};
  EXPECT_TRUE(are_sums_over_cells("row: column: sum", places));
  EXPECT_FALSE(are_sums_over_cells("row: sum", places));
  EXPECT_FALSE(are_sums_over_cells("row: column: sum"));
  EXPECT_TRUE(are_sums_over_cells("row: sum", {places.data(), 1}));
}

TEST(conventions, cell_methods_say_what_was_done_last) {
  EXPECT_EQ(with_cell_method("", "mean"), "area: mean");
  EXPECT_EQ(with_cell_method("time: mean", "mean"), "time: mean area: mean");
  EXPECT_EQ(with_cell_method("area: maximum", "mean"), "area: maximum area: mean");
  EXPECT_EQ(with_cell_method("area: sum", "mean"), "area: sum area: mean");
  EXPECT_EQ(with_cell_method("area: sum", "sum"), "area: sum");
  EXPECT_EQ(with_cell_method("lat: lon: mean time: maximum", "mean"),
            "lat: lon: mean time: maximum");
  EXPECT_EQ(with_cell_method("area: mode", "mode"), "area: mode");
}

using io::NetcdfAttribute;
using io::NetcdfType;

Doubles meant(NetcdfType type, std::vector<NetcdfAttribute> attributes, Doubles values) {
  formats::ValueRules({"v", type, {}, std::move(attributes)}).apply(values);
  return values;
}
NetcdfAttribute numbers(const char* name, NetcdfType type, Doubles values) {
  return {name, type, {}, std::move(values)};
}

void expect_same(const Doubles& found, const Doubles& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(found[i] == wanted[i] || (std::isnan(found[i]) && std::isnan(wanted[i])))
        << i << ": " << found[i] << " instead of " << wanted[i];
  }
}

TEST(conventions, missing_values_of_any_type) {
  const double single = static_cast<double>(1e20F);
  expect_same(meant(NetcdfType::float32, {numbers("missing_value", NetcdfType::float64, {1e20})},
                    {1, single}),
              {1, not_there});
  expect_same(meant(NetcdfType::float64, {numbers("missing_value", NetcdfType::float32, {single})},
                    {1, 1e20, single}),
              {1, not_there, not_there});
  expect_same(meant(NetcdfType::int16, {numbers("missing_value", NetcdfType::float64, {-9, -8})},
                    {-9, -8, -7, -32767}),
              {not_there, not_there, -7, not_there});
  expect_same(meant(NetcdfType::int16, {{"missing_value", NetcdfType::text, "-99", {}}}, {-99, 1}),
              {not_there, 1});
  expect_same(meant(NetcdfType::float32, {}, {static_cast<double>(9.9692099683868690e+36F)}),
              {not_there});
  expect_same(meant(NetcdfType::float32, {numbers("_FillValue", NetcdfType::float32, {-1})},
                    {static_cast<double>(9.9692099683868690e+36F), -1}),
              {static_cast<double>(9.9692099683868690e+36F), not_there});
  expect_same(meant(NetcdfType::int8, {}, {-127}), {-127});
}

// NC_FILL_SHORT and so on of netcdf.h; bytes have none, as all of their values are in use.
TEST(conventions, what_nobody_wrote_is_missing) {
  const auto expect = [](NetcdfType type, double fill, double near) {
    expect_same(meant(type, {}, {fill, near, 1}), {not_there, near, 1});
    expect_same(meant(type, {numbers("_FillValue", type, {near})}, {fill, near, 1}),
                {fill, not_there, 1});
  };
  expect(NetcdfType::int16, -32767, -32768);
  expect(NetcdfType::int32, -2147483647.0, -2147483648.0);
  expect(NetcdfType::uint16, 65535, 65534);
  expect(NetcdfType::uint32, 4294967295.0, 4294967294.0);
  expect(NetcdfType::float32, 9.9692099683868690e+36, 9.9692099683868690e+35);
  expect(NetcdfType::float64, 9.9692099683868690e+36, 9.9692099683868690e+35);
  for (const NetcdfType type : {NetcdfType::int8, NetcdfType::uint8}) {
    expect_same(meant(type, {}, {-127, 0, 255}), {-127, 0, 255});
  }
}

TEST(conventions, valid_ranges_are_of_packed_numbers) {
  expect_same(meant(NetcdfType::float32, {numbers("valid_max", NetcdfType::float32, {5})}, {5, 6}),
              {5, not_there});
  expect_same(meant(NetcdfType::int16,
                    {numbers("valid_range", NetcdfType::int16, {0, 10}),
                     numbers("scale_factor", NetcdfType::float64, {0.5})},
                    {-1, 4, 11}),
              {not_there, 2, not_there});
  // Limits of the type of scale_factor are those of unpacked numbers.
  expect_same(meant(NetcdfType::int16,
                    {numbers("valid_range", NetcdfType::float64, {0, 10}),
                     numbers("scale_factor", NetcdfType::float64, {0.5})},
                    {-1, 4, 20, 21}),
              {not_there, 2, 10, not_there});
}

TEST(conventions, odd_attributes_are_told) {
  const auto remark = [](NetcdfType type, std::vector<io::NetcdfAttribute> attributes) {
    return formats::ValueRules({"v", type, {}, std::move(attributes)}).remark();
  };
  EXPECT_EQ(remark(NetcdfType::float32, {numbers("valid_range", NetcdfType::float32, {0, 10})}),
            "");
  EXPECT_EQ(
      remark(NetcdfType::float32, {numbers("valid_range", NetcdfType::float32, {10, 0})}),
      "variable \"v\": attribute valid_range is more than the largest valid number: all values "
      "are missing");
  EXPECT_EQ(remark(NetcdfType::int8, {numbers("_Unsigned", NetcdfType::int32, {1})}),
            "variable \"v\": attribute _Unsigned is not heeded: it is neither \"true\" nor "
            "\"false\"");
  // Both are told.
  const std::string several = remark(
      NetcdfType::int8,
      {{"_Unsigned", NetcdfType::text, "yes", {}}, {"scale_factor", NetcdfType::text, "2", {}}});
  EXPECT_NE(several.find("; attribute "), std::string::npos) << several;
  const auto refusal = [&](const NetcdfAttribute& attribute) {
    try {
      return remark(NetcdfType::int16, {attribute});
    } catch (const io::BadValue& error) {
      return std::string(error.what());
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* name : {"scale_factor", "add_offset"}) {
    const std::string start = "variable \"v\": attribute " + std::string(name);
    EXPECT_EQ(refusal(numbers(name, NetcdfType::float64, {nan})), start + " is not finite");
    EXPECT_EQ(refusal(numbers(name, NetcdfType::float64, {2, 3})),
              start + " has 2 numbers instead of one");
    EXPECT_EQ(refusal({name, NetcdfType::text, "two", {}}),
              start + " is the text \"two\" and no number");
    EXPECT_EQ(refusal(numbers(name, NetcdfType::float64, {2})), "");
  }
}

TEST(conventions, unsigned_and_packed_numbers) {
  expect_same(meant(NetcdfType::int8,
                    {{"_Unsigned", NetcdfType::text, "true", {}},
                     numbers("_FillValue", NetcdfType::int8, {-1})},
                    {-56, 1, -1}),
              {200, 1, not_there});
  expect_same(meant(NetcdfType::uint8, {{"_Unsigned", NetcdfType::text, "false", {}}}, {200}),
              {-56});
  expect_same(meant(NetcdfType::int16,
                    {{"scale_factor", NetcdfType::text, " 0.5 ", {}},
                     numbers("add_offset", NetcdfType::float32, {10})},
                    {4}),
              {12});
  const io::NetcdfVariable two{
      "v", NetcdfType::int16, {}, {numbers("scale_factor", NetcdfType::float64, {1, 2})}};
  EXPECT_THROW(formats::ValueRules{two}, io::BadValue);
  const io::NetcdfVariable word{
      "v", NetcdfType::int16, {}, {{"add_offset", NetcdfType::text, "none", {}}}};
  EXPECT_THROW(formats::ValueRules{word}, io::BadValue);
}

// Every type of integers, by the highest bit, which "_Unsigned" gives another meaning.
TEST(conventions, integers_of_every_type_may_be_unsigned) {
  const auto expect = [](NetcdfType type, NetcdfType other, double size) {
    const auto read = [&](NetcdfType of, const char* word, double value) {
      return meant(of,
                   {{"_Unsigned", NetcdfType::text, word, {}},
                    numbers("_FillValue", of, {of == type ? -5 : 5.0})},
                   {value, 7});
    };
    expect_same(read(type, "true", -size / 4), {size * 3 / 4, 7});
    expect_same(read(type, "TRUE", -5), {not_there, 7});
    expect_same(read(type, "false", -size / 4), {-size / 4, 7});
    expect_same(read(other, "false", size * 3 / 4), {-size / 4, 7});
    expect_same(read(other, "true", size * 3 / 4), {size * 3 / 4, 7});
  };
  expect(NetcdfType::int8, NetcdfType::uint8, 0x1p8);
  expect(NetcdfType::int16, NetcdfType::uint16, 0x1p16);
  expect(NetcdfType::int32, NetcdfType::uint32, 0x1p32);
  expect(NetcdfType::int64, NetcdfType::uint64, 0x1p64);
  for (const NetcdfType type : {NetcdfType::float32, NetcdfType::float64}) {
    expect_same(meant(type, {{"_Unsigned", NetcdfType::text, "true", {}}}, {-1}), {-1});
  }
}

TEST(conventions, dimensions_in_another_order) {
  Doubles values;
  for (double value = 0; value < 24; ++value) values.push_back(value);
  const std::vector<std::uint64_t> shape = {2, 3, 4};
  const Doubles found = formats::transposed(shape, {2, 0, 1}, values);
  for (std::size_t k = 0; k < 24; ++k) {
    const std::size_t of_2 = k / 6;
    const std::size_t of_0 = k / 3 % 2;
    const std::size_t of_1 = k % 3;
    EXPECT_EQ(found[k], static_cast<double>((of_0 * 3 + of_1) * 4 + of_2));
  }
}

TEST(conventions, of_one_variable_are_those_of_its_own_attribute) {
  VariableHeader own = header("temp", {"y", "x"});
  own.texts.emplace_back("coordinates", "TLONG TLAT");
  const std::vector<VariableHeader> headers = {
      header("TLONG", {"y", "x"}, {{"units", "degrees_east"}}),
      header("TLAT", {"y", "x"}, {{"units", "degrees_north"}}),
      header("ULONG", {"y", "x"}, {{"units", "degrees_east"}}),
      header("ULAT", {"y", "x"}, {{"units", "degrees_north"}}),
      own,
      header("depth", {"y", "x"})};
  const auto lons_of = [&](std::size_t variable) {
    std::vector<std::size_t> lons;
    for (const CoordinatePair& pair : coordinates_of(headers, variable)) lons.push_back(pair.lon);
    return lons;
  };
  EXPECT_EQ(lons_of(4), std::vector<std::size_t>{0});
  EXPECT_EQ(lons_of(2).front(), 2U);
  // Crossed pairs, as ULONG and TLAT, are behind the others.
  const std::vector<CoordinatePair> of_depth = coordinates_of(headers, 5);
  ASSERT_EQ(of_depth.size(), 4U);
  EXPECT_EQ(of_depth[0].lat, of_depth[0].lon + 1);
  EXPECT_EQ(of_depth[1].lat, of_depth[1].lon + 1);
  EXPECT_GT(of_depth[1].rank, of_depth[2].rank);
  EXPECT_THROW((void)coordinates_of(headers, 6), InvalidInput);
}

// A search that looks at all variables for each of them takes minutes here.
TEST(conventions, files_have_thousands_of_variables) {
  std::vector<VariableHeader> headers = {header("lon", {"lon"}, {{"units", "degrees_east"}}),
                                         header("lat", {"lat"}, {{"units", "degrees_north"}}),
                                         header("nav_lon", {"y", "x"}),
                                         header("nav_lat", {"y", "x"}),
                                         header("lon_bnds", {"lon", "two"}),
                                         header("lat_bnds", {"lat", "two"})};
  std::vector<std::size_t> wanted;
  for (std::size_t k = 0; k < 6000; ++k) {
    wanted.push_back(headers.size());
    const std::string name = "f" + std::to_string(k);
    if (k % 3 == 0) headers.push_back(header(name, {"time", "lat", "lon"}));
    if (k % 3 == 1)
      headers.push_back(header(name, {"y", "x"}, {{"coordinates", "nav_lat nav_lon"}}));
    if (k % 3 == 2) headers.push_back(header(name, {"level"}));
  }
  const std::vector<std::vector<CoordinatePair>> pairs = coordinates_of(headers, wanted);
  ASSERT_EQ(pairs.size(), wanted.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    ASSERT_EQ(pairs[k].size(), k % 3 == 2 ? 0U : 1U) << k;
    if (k % 3 == 2) continue;
    const CoordinatePair& pair = pairs[k].front();
    EXPECT_EQ(pair.lon, k % 3 == 0 ? 0U : 2U);
    EXPECT_EQ(pair.lat, pair.lon + 1);
    EXPECT_EQ(pair.lon_bounds, k % 3 == 0 ? 4U : CoordinatePair::none);
    EXPECT_EQ(pair.is_listed, k % 3 == 1);
  }
  // The questions of one variable and of several have one answer.
  const std::vector<CoordinatePair> alone = coordinates_of(headers, wanted[1]);
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_EQ(alone.front().rank, pairs[1].front().rank);
  EXPECT_THROW((void)coordinates_of(headers, std::vector<std::size_t>{headers.size()}),
               InvalidInput);
}

TEST(conventions, values_without_time_have_coordinates_that_repeat_along_it) {
  const std::vector<VariableHeader> headers = {
      header("XLONG", {"Time", "y", "x"}, {{"units", "degree_east"}}),
      header("XLAT", {"Time", "y", "x"}, {{"units", "degree_north"}}),
      header("HGT", {"y", "x"}),
      header("ZNU", {"x"}),
      header("T2", {"Time", "y", "x"}),
      header("lon", {"Time"}, {{"units", "degree_east"}}),
      header("lat", {"Time"}, {{"units", "degree_north"}}),
      header("depth", {"level", "x"})};
  for (const std::size_t variable : {2U, 4U}) {
    const std::vector<CoordinatePair> pairs = coordinates_of(headers, variable);
    ASSERT_FALSE(pairs.empty());
    const auto is_of_grid = [](const CoordinatePair& pair) {
      return pair.lon == 0 && pair.lat == 1;
    };
    EXPECT_TRUE(std::ranges::any_of(pairs, is_of_grid)) << variable;
    // A track in time is no place of a field without time.
    const bool has_track =
        std::ranges::any_of(pairs, [](const auto& pair) { return pair.lon == 5; });
    EXPECT_EQ(has_track, variable == 4) << variable;
  }
  EXPECT_TRUE(coordinates_of(headers, 3).empty());
  EXPECT_TRUE(coordinates_of(headers, 7).empty());
}

TEST(conventions, rotated_coordinates_have_no_unit) {
  VariableHeader rotated = header("rlon", {"rlon"}, {{"units", "degrees_east"}});
  rotated.texts.emplace_back("standard_name", "grid_longitude");
  EXPECT_THROW((void)degrees_per_unit(rotated), InvalidInput);
  EXPECT_TRUE(is_planar(Texts{{"title", ""}, {"on_a_sphere", "NO      "}}));
  EXPECT_FALSE(is_planar(Texts{{"on_a_sphere", "YES"}}));
}

// The names of the variables of a file that describe its grid.
std::string parts_of(const std::vector<std::string>& names) {
  std::vector<VariableHeader> headers;
  headers.reserve(names.size());
  for (const std::string& name : names) headers.push_back(header(name, {"n"}));
  const std::vector<bool> are_parts = parts_of_grids(headers);
  std::string parts;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (are_parts[i]) parts += (parts.empty() ? "" : " ") + names[i];
  }
  return parts;
}

TEST(conventions, variables_of_grids_are_no_fields) {
  EXPECT_EQ(parts_of({"tas", "lonCell", "latCell", "elementMask", "atmo.lon", "coordx"}), "");
  const auto expect_all = [](const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : " ") + name;
    std::vector<std::string> with_field = names;
    with_field.emplace_back("tas");
    EXPECT_EQ(parts_of(with_field), all);
  };
  expect_all({"elementConn", "nodeCoords", "numElementConn", "centerCoords", "elementMask"});
  expect_all({"grid_corner_lon", "grid_corner_lat", "grid_center_lon", "grid_center_lat",
              "grid_imask", "grid_dims"});
  expect_all({"grid_center_lon", "grid_center_lat", "grid_imask", "grid_dims"});
  expect_all({"vertex_of_cell", "clon", "clat", "vlon", "vlat", "edge_vertices", "edge_index"});
  expect_all({"verticesOnCell", "xCell", "yEdge", "zVertex", "lonCell", "latEdge", "lonVertex",
              "boundaryVertex", "cellsOnEdge", "cellsOnVertex", "nEdgesOnCell"});
  expect_all({"indexToCellID", "latCell"});
  EXPECT_EQ(parts_of({"verticesOnCell", "lonCells", "xtimeCell", "Cell", "zmid"}),
            "verticesOnCell");
  for (const std::string grid : {"t", "u", "v", "w", "f"}) {
    expect_all({"glam" + grid, "gphi" + grid});
  }
  EXPECT_EQ(parts_of({"glamt", "gphiu", "glamx", "gphix", "glamtt", "gphitt"}), "");
  // OASIS: a prefix for each grid.
  expect_all({"atm.lon", "atm.lat", "atm.clo", "atm.cla", "atm.msk", "atm.ang"});
  EXPECT_EQ(parts_of({"atm.lon", "atm.clo", "atm.cla", "ocn.lat", "ocn.msk"}), "");
  EXPECT_EQ(parts_of({"atm.lon", "atm.lat", "atm.sst", "lon"}), "atm.lon atm.lat");
  expect_all({"connect1", "connect2", "coord", "coordx", "global_id1", "edge_type1", "eb_prop1",
              "elem_num_map"});
  EXPECT_EQ(parts_of({"coordx", "eb_prop1", "tas"}), "");
  // A topology of UGRID, and what it names.
  std::vector<VariableHeader> headers = {header("mesh", {},
                                                {{"cf_role", "mesh_topology"},
                                                 {"node_coordinates", "nx ny"},
                                                 {"face_node_connectivity", "faces"},
                                                 {"long_name", "tas"}}),
                                         header("nx", {"n"}), header("ny", {"n"}),
                                         header("faces", {"n"}), header("tas", {"n"})};
  EXPECT_EQ(parts_of_grids(headers), (std::vector<bool>{true, true, true, true, false}));
  headers[0].texts[0] = {"standard_name", "mesh_topology"};
  EXPECT_EQ(parts_of_grids(headers), (std::vector<bool>{true, true, true, true, false}));
  headers[0].texts[0] = {"cf_role", "timeseries_id"};
  EXPECT_EQ(parts_of_grids(headers), std::vector<bool>(5));
}

TEST(conventions, areas_and_volumes_of_cells_are_known) {
  const std::vector<VariableHeader> headers = {
      header("tas", {"n"}, {{"cell_measures", "area: own volume: bulk"}}),
      header("own", {"n"}),
      header("bulk", {"n"}),
      header("named", {"n"}, {{"standard_name", "cell_area"}}),
      header("areaCell", {"n"}),
      header("TAREA", {"n"}),
      header("area", {"n"}, {{"units", "m^2"}}),
      header("area", {"n"}, {{"units", "1"}}),
      header("leaf_area", {"n"}, {{"units", "m2"}}),
      header("area:", {"n"})};
  EXPECT_EQ(are_measures_of_cells(headers),
            (std::vector<bool>{false, true, true, true, true, true, true, false, false, false}));
}

TEST(conventions, attributes_of_a_copy_name_what_is_there) {
  const auto name_of = [](const std::string& name) {
    return name == "lost" ? std::string() : name + "_";
  };
  EXPECT_EQ(with_names("coordinates", "lon lost  height", name_of), "lon_ height_");
  EXPECT_EQ(with_names("ancillary_variables", "lost", name_of), "");
  EXPECT_EQ(with_names("bounds", "time_bnds", name_of), "time_bnds_");
  EXPECT_EQ(with_names("climatology", "lost", name_of), "");
  EXPECT_EQ(with_names("formula_terms", "a: b ps: a", name_of), "a: b_ ps: a_");
  EXPECT_EQ(with_names("formula_terms", "a: b ps: lost", name_of), "");
  EXPECT_EQ(with_names("compress", "lev lat", name_of), "lev_ lat_");
  EXPECT_EQ(with_names("compress", "lev lost", name_of), "");
  EXPECT_EQ(with_names("units", "lev", name_of), "");
  EXPECT_FALSE(is_attribute_of_names("grid_mapping"));
}

TEST(conventions, attributes_of_places_and_of_values_are_told_apart) {
  for (const char* const name :
       {"featureType", "geospatial_lat_min", "geospatial_lon_max", "geospatial_bounds",
        "geospatial_lat_resolution", "nominal_resolution", "grid_label", "stagger", "MAP_PROJ",
        "DX", "WEST-EAST_GRID_DIMENSION", "SOUTH-NORTH_PATCH_END_STAG", "grid_mapping"}) {
    EXPECT_TRUE(is_attribute_of_places(name)) << name;
    EXPECT_FALSE(is_attribute_of_values(name)) << name;
  }
  for (const char* const name :
       {"dtype", "minimum", "maximum", "data_min", "valid_count", "unpacked_valid_range"}) {
    EXPECT_TRUE(is_attribute_of_values(name)) << name;
    EXPECT_FALSE(is_attribute_of_places(name)) << name;
  }
  for (const char* const name : {"geospatial_vertical_min", "BOTTOM-TOP_GRID_DIMENSION", "units",
                                 "valid", "flag_values", "description"}) {
    EXPECT_FALSE(is_attribute_of_places(name)) << name;
    EXPECT_FALSE(is_attribute_of_values(name)) << name;
  }
  for (const char* const name : {"flag_values", "flag_masks", "flag_meanings"}) {
    EXPECT_TRUE(is_attribute_of_flags(name)) << name;
  }
  EXPECT_FALSE(is_attribute_of_flags("flags"));
}

TEST(conventions, longitudes_count_from_the_meridian_of_their_grid_mapping) {
  const std::vector<VariableHeader> headers = {
      header("lat", {"lat"}),
      header("lon", {"lon"}),
      header("x", {"time", "lat", "lon"}, {{"grid_mapping", "crs"}}),
      header("rlon", {"rlon"}),
      header("y", {"rlat", "rlon"}, {{"grid_mapping", "own: rlon rlat"}}),
      header("crs", {}),
      header("own", {})};
  const auto remark = [&](const std::string& coordinate, double of_crs, double of_own) {
    const std::vector<std::pair<std::string, double>> meridians = {{"crs", of_crs},
                                                                   {"own", of_own}};
    return remark_on_meridian(headers, coordinate, meridians);
  };
  EXPECT_EQ(remark("lon", 0, 7), "");
  EXPECT_EQ(remark("rlon", 7, 0), "");
  EXPECT_EQ(remark("nothing", 7, 7), "");
  EXPECT_EQ(remark("lon", 106.5, 0),
            "the longitudes count from the meridian at 106.5 degrees east of Greenwich "
            "(longitude_of_prime_meridian of variable \"crs\"): add 106.5 to them, and set the "
            "attribute to 0 or remove it");
  EXPECT_NE(remark("rlon", 0, -17), "");
}

TEST(conventions, variables_depend_on_place_by_their_dimensions) {
  const std::vector<VariableHeader> headers = {
      header("mesh", {},
             {{"cf_role", "mesh_topology"},
              {"node_coordinates", "px py"},
              {"edge_node_connectivity", "ends"},
              {"face_node_connectivity", "faces"},
              {"face_dimension", "f"}}),
      header("px", {"p"}),
      header("py", {"p"}),
      header("ends", {"s", "two"}),
      header("faces", {"most", "f"}),
      header("of_nodes", {"time", "p"}),
      header("of_edges", {"s"}),
      header("of_faces", {"f"}),
      header("said", {"q"}, {{"mesh", "mesh"}, {"location", "edge"}}),
      header("time_bnds", {"time", "two"}),
      header("hyai", {"ilev"}),
      header("land", {"land"}, {{"compress", "time f"}}),
      header("of_land", {"time", "land"}),
      header("few", {"few"}, {{"compress", "time ilev"}}),
      header("of_few", {"few"}),
      header("crs", {})};
  EXPECT_EQ(are_at_places(headers),
            (std::vector<bool>{false, true, true, true, true, true, true, true, true, false, false,
                               true, true, false, false, false}));
  // Longitudes of a track have a time, which is no dimension of places; staggered axes are.
  const std::vector<VariableHeader> others = {
      header("lon", {"time"}),     header("lat", {"time"}),
      header("series", {"time"}),  header("u", {"xi_u"}),
      header("v", {"eta_v"}),      header("w", {"west_east_stag"}),
      header("nv", {"nVertices"}), header("second", {"ncells_2"}),
      header("q", {"yq"}),         header("yy", {"yy"}, {{"axis", "Y"}}),
      header("z", {"yy"}),         header("lev", {"lev"})};
  EXPECT_EQ(are_at_places(others), (std::vector<bool>{false, false, false, true, true, true, true,
                                                      true, true, true, true, false}));
}

TEST(conventions, planes_are_named_by_an_attribute) {
  EXPECT_TRUE(is_planar(Texts{{"on_a_sphere", "NO"}}));
  EXPECT_TRUE(is_planar(Texts{{"title", "no"}, {"on_a_sphere", " no  "}}));
  EXPECT_FALSE(is_planar(Texts{{"on_a_sphere", "YES"}}));
  EXPECT_FALSE(is_planar(Texts{{"title", "NO"}}));
  EXPECT_FALSE(is_planar(Texts{}));
}

}  // namespace
}  // namespace rondel::test
