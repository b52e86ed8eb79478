// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which places the variables of a netCDF file have: those that their dimensions and their own attributes name, and no others.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/netcdf_writer.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/read_cells.h"
#include "support/thrown.h"
#include "unit/io/support.h"

namespace rondel::test {
namespace {

using io::NetcdfType;
using Numbers = std::vector<double>;
using Texts = std::vector<std::pair<std::string, std::string>>;

struct PlacedVariable {
  std::string name;
  std::vector<std::size_t> dimensions;
  Texts attributes;
  Numbers values;
};

struct PlacedFile {
  std::vector<std::pair<std::string, std::uint64_t>> dimensions;
  std::vector<PlacedVariable> variables;
  Texts attributes = {};

  void write(const std::string& path) const {
    io::AtomicFile file(path);
    io::NetcdfWriter out(file);
    for (const auto& [name, length] : dimensions) out.add_dimension(name, length);
    for (const auto& [name, text] : attributes) {
      out.add_attribute({name, NetcdfType::text, text, {}});
    }
    for (const PlacedVariable& variable : variables) {
      std::vector<io::NetcdfAttribute> texts;
      for (const auto& [name, text] : variable.attributes) {
        texts.push_back({name, NetcdfType::text, text, {}});
      }
      out.add_variable({variable.name, NetcdfType::float64, variable.dimensions, texts});
    }
    out.begin({});
    for (const PlacedVariable& variable : variables) out.write<double>(variable.values);
    out.finish();
    file.commit();
  }
};

const Texts east = {{"units", "degrees_east"}};
const Texts north = {{"units", "degrees_north"}};

// t on (lat, lon), u on (lat, lon_u), which is as long, and v, whose axis has the numbers of lon.
PlacedFile staggered_file() {
  return {{{"lat", 2}, {"lon", 3}, {"lon_u", 3}, {"lon_v", 3}},
          {{"lat", {0}, north, {-10, 10}},
           {"lon", {1}, east, {0, 10, 20}},
           {"lon_u", {2}, east, {5, 15, 25}},
           {"lon_v", {3}, east, {360, 10, -340}},
           {"t", {0, 1}, {}, {1, 2, 3, 4, 5, 6}},
           {"u", {0, 2}, {}, {11, 12, 13, 14, 15, 16}},
           {"v", {0, 3}, {}, {21, 22, 23, 24, 25, 26}}}};
}

// Two kinds of points along the same dimensions, as POP has them; each variable says which ones are its own, but for depth.
PlacedFile paired_file() {
  const std::vector<std::size_t> grid = {0, 1};
  return {{{"y", 2}, {"x", 2}},
          {{"TLONG", grid, east, {0, 10, 0, 10}},
           {"TLAT", grid, north, {0, 0, 10, 10}},
           {"ULONG", grid, east, {5, 15, 5, 15}},
           {"ULAT", grid, north, {5, 5, 15, 15}},
           {"UVEL", grid, {{"coordinates", "ULONG ULAT"}}, {1, 2, 3, 4}},
           {"TEMP", grid, {{"coordinates", "TLONG TLAT"}}, {5, 6, 7, 8}},
           {"depth", grid, {}, {9, 9, 9, 9}}}};
}

std::vector<std::string> names_of(const FieldSet& fields) {
  std::vector<std::string> names;
  for (const FieldArray& array : fields.arrays) names.push_back(array.name);
  return names;
}

// A field without time whose coordinates have one, as WRF has them, on a square with its dimensions
// in the other order.
PlacedFile turned_file(const Numbers& later_lon) {
  Numbers lon = {0, 10, 1, 11};
  lon.insert(lon.end(), later_lon.begin(), later_lon.end());
  return {{{"Time", 2}, {"x", 2}, {"y", 2}},
          {{"XLONG", {0, 1, 2}, east, lon},
           {"XLAT", {0, 1, 2}, north, {0, 1, 10, 11, 0, 1, 10, 11}},
           {"HGT", {2, 1}, {{"coordinates", "XLONG XLAT"}}, {1, 2, 3, 4}}}};
}

class FieldPlaces : public testing::Test {
 protected:
  [[nodiscard]] std::string path() const { return directory_.file("f.nc"); }

  [[nodiscard]] FieldSet read(const std::vector<std::string>& names,
                              std::uint64_t num_points = 0) const {
    return read_fields({path(), {}}, names, num_points);
  }
  [[nodiscard]] FieldSet read_at(const std::vector<std::string>& names,
                                 const std::vector<LonLat>& places) const {
    return FieldFile({path(), {}}, names, places.size(), {}, {}, {places, 1e-9}).fields();
  }
  // What is said; empty if it is read.
  template <typename Read>
  [[nodiscard]] std::string refusal(const Read& read) const {
    return thrown_message<FileError>(read);
  }

 private:
  TemporaryDirectory directory_;
};

using Names = std::vector<std::string>;

TEST_F(FieldPlaces, of_fields_without_time_may_repeat_along_time) {
  turned_file({0, 10, 1, 11}).write(path());
  for (const std::uint64_t num_points : {0U, 4U}) {
    const FieldSet fields = read({"HGT"}, num_points);
    ASSERT_EQ(fields.arrays.size(), 1U);
    EXPECT_EQ(fields.arrays[0].values, (Numbers{1, 3, 2, 4}));  // in the order of the places
    EXPECT_TRUE(fields.remarks.empty());
  }
  // Places that move have no field without time.
  turned_file({0, 10, 1, 12}).write(path());
  EXPECT_NE(refusal([&] { (void)read({"HGT"}); }), "");
}

TEST_F(FieldPlaces, of_another_grid_of_the_same_lengths_are_left_out_and_told) {
  staggered_file().write(path());
  const FieldSet all = read({});
  EXPECT_EQ(names_of(all), (Names{"t", "v"}));
  EXPECT_EQ(all.positions[1], (LonLat{10, -10}));
  EXPECT_EQ(all.remarks, Names{"left out, as they are at other places than lon and lat: "
                               "u (lon_u and lat)"});
  EXPECT_NE(all.remark_on_grids.find("that of lon and lat is read, not that of lon_u and lat"),
            std::string::npos)
      << all.remark_on_grids;
  const FieldSet one = read({"u"});
  EXPECT_EQ(names_of(one), Names{"u"});
  EXPECT_EQ(one.positions[1], (LonLat{15, -10}));
  EXPECT_TRUE(one.remark_on_grids.empty());
}

TEST_F(FieldPlaces, of_two_grids_are_an_error_that_names_both_in_any_order) {
  staggered_file().write(path());
  for (const Names& names : {Names{"t", "u"}, Names{"u", "t"}}) {
    for (const std::uint64_t num_points : {0U, 6U}) {
      const std::string text = refusal([&] { (void)read(names, num_points); });
      EXPECT_NE(text.find("\"t\""), std::string::npos) << text;
      EXPECT_NE(text.find("\"u\""), std::string::npos) << text;
      EXPECT_NE(text.find("lon_u and lat"), std::string::npos) << text;
    }
  }
  EXPECT_EQ(names_of(read({"v", "t"})), (Names{"v", "t"}));
}

TEST_F(FieldPlaces, are_those_of_the_own_attribute_coordinates) {
  paired_file().write(path());
  EXPECT_EQ(read({"TEMP"}).positions[0], (LonLat{0, 0}));
  EXPECT_EQ(read({"UVEL"}).positions[0], (LonLat{5, 5}));
  EXPECT_EQ(names_of(read({})), (Names{"UVEL", "depth"}));
  EXPECT_FALSE(refusal([&] { (void)read({"TEMP", "UVEL"}); }).empty());
  // The places that are wanted decide, whatever comes first.
  const std::vector<LonLat> places = {{0, 0}, {10, 0}, {0, 10}, {370, 10}};
  EXPECT_EQ(names_of(read_at({}, places)), (Names{"TEMP", "depth"}));
  EXPECT_EQ(read_at({}, places).positions[0], (LonLat{0, 0}));
  const std::string text = refusal([&] { (void)read_at({"UVEL"}, places); });
  EXPECT_NE(text.find("at ULONG and ULAT, and not at TLONG and TLAT as \"TEMP\""),
            std::string::npos)
      << text;
  EXPECT_FALSE(refusal([&] { (void)read_at({}, {{1, 0}, {11, 0}, {1, 10}, {11, 10}}); }).empty());
}

TEST_F(FieldPlaces, that_may_be_two_are_an_error_that_says_how_to_choose) {
  paired_file().write(path());
  const std::string text = refusal([&] { (void)read({"depth"}); });
  EXPECT_NE(text.find("may be at TLONG and TLAT, or at ULONG and ULAT; FILE.nc:"),
            std::string::npos)
      << text;
  EXPECT_EQ(read({"ULONG"}).positions[0], (LonLat{5, 5}));
  const FieldSet chosen = read_at({"depth"}, read({"TLONG"}).positions);
  EXPECT_EQ(chosen.positions[0], (LonLat{0, 0}));
  ASSERT_EQ(chosen.remarks.size(), 1U);
  EXPECT_NE(chosen.remarks[0].find("it is read at TLONG and TLAT"), std::string::npos);
}

TEST_F(FieldPlaces, of_a_mesh_in_the_plane_are_none) {
  PlacedFile file{
      {{"nCells", 2}},
      {{"lonCell", {0}, {}, {0, 0}}, {"latCell", {0}, {}, {0, 0}}, {"t", {0}, {}, {1, 2}}},
      {{"on_a_sphere", "NO              "}}};
  file.write(path());
  for (const Names& names : {Names{}, Names{"t"}}) {
    const std::string text = refusal([&] { read_netcdf_sites({path(), {}}, names, true); });
    EXPECT_NE(text.find("in the plane"), std::string::npos) << text;
  }
  file.attributes[0].second = "YES             ";
  file.write(path());
  EXPECT_EQ(names_of(read({})), Names{"t"});
}

TEST_F(FieldPlaces, of_rotated_and_projected_coordinates_are_none) {
  for (const std::string name : {"grid_", "projection_"}) {
    const bool is_grid = name == "grid_";
    Texts x = {{"units", "degrees_east"},
               {"standard_name", is_grid ? "grid_longitude" : "projection_x_coordinate"}};
    Texts y = {{"units", "degrees_north"},
               {"standard_name", is_grid ? "grid_latitude" : "projection_y_coordinate"}};
    PlacedFile file{
        {{"y", 2}, {"x", 2}},
        {{"y", {0}, y, {0, 10}}, {"x", {1}, x, {0, 10}}, {"t", {0, 1}, {}, {1, 2, 3, 4}}}};
    file.write(path());
    const std::string text = refusal([&] { (void)read({"t"}); });
    EXPECT_NE(text.find("rotated pole or a projection"), std::string::npos) << text;
    EXPECT_FALSE(refusal([&] { read_cells({path(), {}}); }).empty());
    // True ones beside them are taken.
    file.variables.push_back({"lon", {0, 1}, east, {50, 51, 52, 53}});
    file.variables.push_back({"lat", {0, 1}, north, {1, 2, 3, 4}});
    file.write(path());
    EXPECT_EQ(read({"t"}).positions[1], (LonLat{51, 2}));
  }
}

// The numbers of places along x, y and z say nothing where two of them fit.
TEST_F(FieldPlaces, by_lengths_are_an_error_where_several_fit) {
  const auto file_of = [&](std::vector<std::pair<std::string, std::uint64_t>> dimensions) {
    PlacedFile file{std::move(dimensions), {{"t", {}, {}, {}}}};
    std::size_t size = 1;
    for (std::size_t d = 0; d < file.dimensions.size(); ++d) {
      file.variables[0].dimensions.push_back(d);
      size *= file.dimensions[d].second;
    }
    file.variables[0].values.assign(size, 1.0);
    file.write(path());
  };
  file_of({{"x", 4}, {"y", 4}});
  const std::string text = refusal([&] { (void)read({}, 4); });
  EXPECT_NE(text.find("\"t\" may be those of x, or of y"), std::string::npos) << text;
  file_of({{"x", 4}, {"y", 6}, {"z", 4}});
  EXPECT_NE(refusal([&] { (void)read({"t"}, 24); }).find("x and y, or of y and z"),
            std::string::npos);
  // A shape, the name of cells, and an axis of times leave one answer.
  EXPECT_EQ(read_fields({path(), {}}, Names{"t"}, 24, {}, std::vector<std::uint64_t>{6, 4})
                .arrays[0]
                .dimensions,
            Names{"x"});
  file_of({{"cell", 4}, {"y", 4}});
  EXPECT_EQ(read({"t"}, 4).arrays[0].dimensions, Names{"y"});
  file_of({{"time", 4}, {"y", 4}});
  EXPECT_EQ(read({"t"}, 4).arrays[0].dimensions, Names{"time"});
  file_of({{"one", 1}, {"y", 4}, {"single", 1}});
  EXPECT_EQ(read({"t"}, 4).arrays[0].num_fields(), 1U);
}

TEST_F(FieldPlaces, by_lengths_are_along_the_same_dimensions_in_all_variables) {
  PlacedFile file{
      {{"x", 3}, {"y", 3}},
      {{"t", {0}, {}, {1, 2, 3}}, {"u", {1}, {}, {4, 5, 6}}, {"v", {0}, {}, {7, 8, 9}}}};
  file.write(path());
  const std::string text = refusal([&] { (void)read({}, 3); });
  EXPECT_NE(text.find("\"t\" along x and \"u\" along y"), std::string::npos) << text;
  EXPECT_FALSE(refusal([&] { (void)read({"u", "v"}, 3); }).empty());
  EXPECT_EQ(names_of(read({"v", "t"}, 3)), (Names{"v", "t"}));
  file.dimensions[1].first = "ncol";
  file.write(path());
  EXPECT_EQ(names_of(read({}, 3)), Names{"u"});
}

TEST_F(FieldPlaces, are_no_fields_where_they_describe_a_grid) {
  const Texts degrees = {{"units", "degrees"}};
  PlacedFile{{{"elementCount", 2}, {"coordDim", 2}, {"k", 3}},
             {{"nodeCoords", {0, 1}, degrees, {0, 0, 1, 1}},
              {"elementConn", {0, 2}, {}, {1, 2, 3, 1, 2, 3}},
              {"numElementConn", {0}, {}, {3, 3}},
              {"centerCoords", {0, 1}, degrees, {0, 0, 1, 1}},
              {"elementMask", {0}, {}, {1, 1}},
              {"elementArea", {0}, {}, {1, 1}},
              {"t", {0}, {}, {1, 2}}}}
      .write(path());
  EXPECT_EQ(names_of(read({}, 2)), Names{"t"});
  for (const char* name : {"numElementConn", "elementArea"}) {  // where it is named
    EXPECT_EQ(names_of(read({name}, 2)), Names{name});
  }
  PlacedFile{
      {{"nf", 2}, {"k", 3}},
      {{"mesh", {1}, {{"cf_role", "mesh_topology"}, {"face_node_connectivity", "fn"}}, {0, 0, 0}},
       {"fn", {0, 1}, {}, {0, 1, 2, 0, 1, 2}},
       {"t", {0}, {}, {1, 2}}}}
      .write(path());
  EXPECT_EQ(names_of(read({}, 2)), Names{"t"});
  PlacedFile{{{"y", 1}, {"x", 2}},
             {{"nav_lon", {0, 1}, {}, {0, 1}},
              {"nav_lat", {0, 1}, {}, {0, 1}},
              {"glamu", {0, 1}, {}, {0, 1}},
              {"gphiu", {0, 1}, {}, {0, 1}},
              {"glamx", {0, 1}, {}, {0, 1}}}}
      .write(path());
  EXPECT_EQ(names_of(read({})), Names{"glamx"});
}

}  // namespace
}  // namespace rondel::test
