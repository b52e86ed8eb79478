// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Names and units of CF and of models, names in groups, and which coordinates belong together.
#include "formats/cf_names.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "io/netcdf_groups.h"
#include "io/netcdf_header.h"
#include "rondel/conventions.h"
#include "unit/io/support.h"

namespace rondel::test::of_names {
namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;
using formats::CoordinateKind;

VariableHeader variable_of(const std::string& name, const std::vector<std::string>& dimensions,
                           const Texts& texts = {}) {
  return {name, true, dimensions, std::vector<std::uint64_t>(dimensions.size(), 4), texts};
}

TEST(dimensions_of_cells, are_those_of_the_name_or_the_length) {
  using Names = std::vector<std::string>;
  using Lengths = std::vector<std::uint64_t>;
  using Found = std::vector<std::size_t>;
  EXPECT_EQ(dimensions_of_cells(Names{"x", "ncol"}, Lengths{4, 4}, 4), Found{1});
  EXPECT_EQ(dimensions_of_cells(Names{"x", "ncol"}, Lengths{4, 3}, 4), Found{0});
  EXPECT_EQ(dimensions_of_cells(Names{"ncol", "x", "cell"}, Lengths{4, 4, 4}, 4), (Found{0, 2}));
  EXPECT_EQ(dimensions_of_cells(Names{"time", "x", "y"}, Lengths{4, 4, 4}, 4), (Found{1, 2}));
  EXPECT_EQ(dimensions_of_cells(Names{"time", "x"}, Lengths{4, 5}, 4), Found{0});
  EXPECT_EQ(dimensions_of_cells(Names{"x"}, Lengths{5}, 4), Found{});
}

TEST(is_same_place, measures_along_the_parallel) {
  EXPECT_TRUE(is_same_place({359.99995, 0}, {0, 0.00005}, 1e-4));
  EXPECT_FALSE(is_same_place({359.9998, 0}, {0, 0}, 1e-4));
  EXPECT_FALSE(is_same_place({0, 0.0002}, {0, 0}, 1e-4));
  EXPECT_TRUE(is_same_place({0.00019, 60}, {0, 60}, 1e-4));
  EXPECT_FALSE(is_same_place({0.00021, 60}, {0, 60}, 1e-4));
  EXPECT_TRUE(is_same_place({77, -90}, {-100, -90}, 1e-9));
  EXPECT_TRUE(is_same_place({NAN, 0}, {5, 6}, 0));
}

TEST(cf_units, have_all_their_spellings) {
  constexpr double radian = 180 / std::numbers::pi;
  const std::vector<std::pair<std::string, double>> singular = {{"degree", 1},
                                                                {"arc_degree", 1},
                                                                {"angular_degree", 1},
                                                                {"arcdeg", 1},
                                                                {"deg", 1},
                                                                {"radian", radian},
                                                                {"milliradian", radian / 1000},
                                                                {"microradian", radian / 1'000'000},
                                                                {"arc_minute", 1. / 60},
                                                                {"angular_minute", 1. / 60},
                                                                {"arcminute", 1. / 60},
                                                                {"arcmin", 1. / 60},
                                                                {"arc_second", 1. / 3600},
                                                                {"angular_second", 1. / 3600},
                                                                {"arcsecond", 1. / 3600},
                                                                {"arcsec", 1. / 3600},
                                                                {"grade", 0.9}};
  for (const auto& [name, degrees] : singular) {
    std::string upper = name;
    for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
    for (const std::string& text :
         {name, name + "s", upper, upper + "S", " " + name, name + "\t", "\r\n" + name + " "}) {
      EXPECT_EQ(degrees_per_unit(text), degrees) << text;
    }
    for (const std::string& text : {"x" + name, name + "ss", name + "_", name.substr(1)}) {
      EXPECT_EQ(degrees_per_unit(text), std::nullopt) << text;
    }
  }
  const std::vector<std::pair<std::string, double>> directions = {
      {"_north", 1}, {"_N", 1}, {"N", 1}, {"_east", 1},  {"_E", 1},  {"E", 1},
      {"_true", 1},  {"_T", 1}, {"T", 1}, {"_west", -1}, {"_W", -1}, {"W", -1}};
  for (const auto& [name, degrees] : directions) {
    EXPECT_EQ(degrees_per_unit("degree" + name), degrees) << name;
    EXPECT_EQ(degrees_per_unit("degrees" + name), degrees) << name;
    EXPECT_EQ(degrees_per_unit("degrees" + name + "s"), std::nullopt) << name;
  }
  EXPECT_EQ(degrees_per_unit("rad"), radian);
  EXPECT_EQ(degrees_per_unit("mrad"), radian / 1000);
  EXPECT_EQ(degrees_per_unit("urad"), radian / 1'000'000);
  EXPECT_EQ(degrees_per_unit("\xC2\xB0"), 1);
  for (const char* const text : {"", " ", "Rad", "MRAD", "degree_south", "degrees south", "S"}) {
    EXPECT_EQ(degrees_per_unit(text), std::nullopt) << text;
  }
  EXPECT_EQ(formats::lower_case("@AZ[`az{"), "@az[`az{");
  EXPECT_EQ(formats::without_blanks("\t a b\r\n"), "a b");
  EXPECT_EQ(formats::without_blanks(" \t"), "");
}

TEST(cf_names, of_longitudes_and_latitudes_come_in_pairs) {
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"lon", "lat"},
      {"longitude", "latitude"},
      {"lons", "lats"},
      {"longitudes", "latitudes"},
      {"nav_lon", "nav_lat"},
      {"lon_rho", "lat_rho"},
      {"TLONG", "TLAT"},
      {"TLON", "TLAT"},
      {"geolon", "geolat"},
      {"XLONG", "XLAT"},
      {"XLONG_M", "XLAT_M"},
      {"glamt", "gphit"},
      {"clon", "clat"},
      {"lonCell", "latCell"},
      {"grid_center_lon", "grid_center_lat"}};
  for (const auto& [lon, lat] : pairs) {
    EXPECT_TRUE(formats::is_known_name(lon, CoordinateKind::lon)) << lon;
    EXPECT_TRUE(formats::is_known_name(lat, CoordinateKind::lat)) << lat;
    EXPECT_FALSE(formats::is_known_name(lon, CoordinateKind::lat)) << lon;
    EXPECT_FALSE(formats::is_known_name(lat, CoordinateKind::lon)) << lat;
    EXPECT_TRUE(formats::are_partners(lon, lat)) << lon;
    EXPECT_FALSE(formats::are_partners(lat, lon)) << lon;
  }
  EXPECT_FALSE(formats::is_known_name("lo", CoordinateKind::lon));
  for (const auto& [lon, lat] : Texts{{"lonVertex", "latVertex"},
                                      {"lonEdge", "latEdge"},
                                      {"vlon", "vlat"},
                                      {"elon", "elat"}}) {
    EXPECT_TRUE(formats::is_name_of_part(lon, CoordinateKind::lon));
    EXPECT_TRUE(formats::is_name_of_part(lat, CoordinateKind::lat));
    EXPECT_FALSE(formats::is_name_of_part(lon, CoordinateKind::lat));
    EXPECT_FALSE(formats::is_name_of_part(lat, CoordinateKind::lon));
    EXPECT_TRUE(formats::is_in_radians(lon) && formats::is_in_radians(lat));
  }
  for (const char* const name : {"lonCell", "latCell", "clon", "clat"}) {
    EXPECT_TRUE(formats::is_in_radians(name));
  }
  for (const char* const name : {"lon", "lat", "loncell", "xlon"}) {
    EXPECT_FALSE(formats::is_in_radians(name));
  }
  EXPECT_TRUE(formats::are_partners("ULONG", "ULAT"));
  EXPECT_TRUE(formats::are_partners("glamu", "GPHIU"));
  EXPECT_FALSE(formats::are_partners("ULONG", "TLAT"));
  EXPECT_FALSE(formats::are_partners("a", "a"));
}

TEST(cf_names, say_what_variables_are) {
  for (const char* const name : {"cellsOnCell", "edgesOnVertex", "cellsOnEdge", "indexToCellID",
                                 "neighbor_of_cell", "edge_index"}) {
    EXPECT_TRUE(formats::is_connectivity(variable_of(name, {"n"}))) << name;
  }
  for (const char* const name : {"OnCells", "index", "a_of_cells", "toIndexTo", "nOnFace"}) {
    EXPECT_FALSE(formats::is_connectivity(variable_of(name, {"n"}))) << name;
  }
  EXPECT_TRUE(
      formats::is_connectivity(variable_of("a", {"n"}, {{"cf_role", "face_node_connectivity"}})));
  EXPECT_FALSE(formats::is_connectivity(variable_of("a", {"n"}, {{"cf_role", "mesh_topology"}})));
  for (const char* const name : {"nCells", "ncells", "cell", "ncol", "n_face", "nMesh2_face",
                                 "grid_size", "elementCount", "cells"}) {
    EXPECT_TRUE(is_name_of_cells(name)) << name;
  }
  EXPECT_FALSE(is_name_of_cells("Cells") || is_name_of_cells("x"));
  for (const char* const end : {"_bnds", "_bounds", "_b", "_vertices", "_corners"}) {
    EXPECT_TRUE(formats::is_name_of_bounds(std::string("lon") + end, "lon"));
    EXPECT_FALSE(formats::is_name_of_bounds(std::string("lon") + end, "lat"));
    EXPECT_FALSE(formats::is_name_of_bounds(std::string("lon") + end + "s", "lon"));
  }
  EXPECT_TRUE(formats::is_name_of_bounds("corner_lon", "lon"));
  EXPECT_FALSE(formats::is_name_of_bounds("corner_lon", "lat"));
  EXPECT_FALSE(formats::is_name_of_bounds("corner_lon", "corner_lon"));
  EXPECT_FALSE(formats::is_name_of_bounds("lon", "lon"));
  for (const char* const name :
       {"time", "T", "Times", "ntime", "time_counter", "ocean_time", "RECORD"}) {
    EXPECT_TRUE(is_name_of_time(name)) << name;
  }
  EXPECT_FALSE(is_name_of_time("x") || is_name_of_time("tim"));
  for (const char* const name :
       {"grid_longitude", "grid_latitude", "projection_x_coordinate", "projection_y_coordinate",
        "projection_x_angular_coordinate", "projection_y_angular_coordinate"}) {
    EXPECT_TRUE(
        formats::is_rotated_or_projected(variable_of("x", {"x"}, {{"standard_name", name}})));
  }
  EXPECT_FALSE(
      formats::is_rotated_or_projected(variable_of("x", {"x"}, {{"standard_name", "longitude"}})));
}

TEST(cf_coordinates, have_evidence) {
  const auto evidence = [](const std::string& name, const Texts& texts, CoordinateKind kind) {
    return formats::coordinate_evidence(variable_of(name, {"n"}, texts), kind);
  };
  const auto lon = CoordinateKind::lon;
  const auto lat = CoordinateKind::lat;
  EXPECT_EQ(evidence("a", {{"standard_name", "longitude"}}, lon), 3);
  EXPECT_EQ(evidence("a", {{"standard_name", "longitude"}}, lat), 0);
  EXPECT_EQ(evidence("a", {{"standard_name", "latitude"}}, lat), 3);
  for (const std::string end : {"_east", "_E", "E"}) {
    for (const std::string unit : {"degree", "degrees"}) {
      EXPECT_EQ(evidence("a", {{"units", " " + unit + end}}, lon), 2) << unit << end;
      EXPECT_EQ(evidence("lat", {{"units", unit + end}}, lat), 0) << unit << end;
    }
  }
  for (const std::string end : {"_north", "_N", "N"}) {
    for (const std::string unit : {"degree", "degrees"}) {
      EXPECT_EQ(evidence("a", {{"units", unit + end}}, lat), 2) << unit << end;
      EXPECT_EQ(evidence("lon", {{"units", unit + end}}, lon), 0) << unit << end;
    }
  }
  EXPECT_EQ(evidence("a", {{"_CoordinateAxisType", "Lon"}}, lon), 2);
  EXPECT_EQ(evidence("a", {{"_CoordinateAxisType", "Lat"}}, lat), 2);
  EXPECT_EQ(evidence("a", {{"_CoordinateAxisType", "Lat"}}, lon), 0);
  EXPECT_EQ(evidence("lon", {}, lon), 1);
  EXPECT_EQ(evidence("lon", {}, lat), 0);
  EXPECT_EQ(evidence("lon", {{"units", "radians"}}, lon), 1);
  EXPECT_EQ(evidence("lon", {{"units", " "}}, lon), 1);
  EXPECT_EQ(evidence("lon", {{"units", "m"}}, lon), 0);
  EXPECT_EQ(evidence("lon", {{"standard_name", "x"}}, lon), 0);
  EXPECT_EQ(evidence("lon", {{"standard_name", "grid_longitude"}, {"units", "degrees_east"}}, lon),
            0);
  EXPECT_EQ(formats::coordinate_evidence(variable_of("lon", {}), lon), 0);
  VariableHeader text = variable_of("lon", {"n"});
  text.is_number = false;
  EXPECT_EQ(formats::coordinate_evidence(text, lon), 0);
}

TEST(cf_coordinates, of_strange_units_are_told) {
  const std::vector<VariableHeader> variables = {
      variable_of("lon", {"n"}, {{"units", "m"}}),
      variable_of("lat", {"n"}, {{"units", "K"}}),
      variable_of("LONGITUDE", {"n"}, {{"units", "degrees"}}),
      variable_of("tlat", {"n"}),
      variable_of("a", {"n"}, {{"units", "m"}}),
      variable_of("rlon", {"n"}, {{"standard_name", "grid_longitude"}, {"units", "degrees"}})};
  EXPECT_EQ(formats::remark_on_units(variables),
            "; 'lon' has the units 'm', which are neither degrees nor radians"
            "; 'lat' has the units 'K', which are neither degrees nor radians"
            "; 'rlon' has the standard_name 'grid_longitude': coordinates of a rotated pole or a "
            "projection are no longitudes and latitudes");
}

const Texts east = {{"units", "degrees_east"}};
const Texts north = {{"units", "degrees_north"}};

// The pairs, the best first, as "lon/lat" with bounds behind it, "axes", "used" and "listed", and the rank.
std::vector<std::string> pairs_of(const std::vector<VariableHeader>& variables,
                                  const CoordinateQuery& query = {}) {
  std::vector<std::string> found;
  const auto name = [&](std::size_t v) {
    return v == CoordinatePair::none ? std::string("-") : variables[v].name;
  };
  for (const CoordinatePair& pair : find_coordinates(variables, query)) {
    found.push_back(name(pair.lon) + "/" + name(pair.lat));
    if (pair.lon_bounds != CoordinatePair::none || pair.lat_bounds != CoordinatePair::none) {
      found.back() += " " + name(pair.lon_bounds) + "/" + name(pair.lat_bounds);
    }
    found.back() += std::string(pair.are_axes ? " axes" : "") + (pair.is_used ? " used" : "") +
                    (pair.is_listed ? " listed" : "") + " " + std::to_string(pair.rank);
  }
  return found;
}

// Ranks: 64 listed, 32 by attributes, 16 bounds, 8 axes, 4 used, 2 standard names, 1 not crossed.
TEST(cf_coordinates, have_ranks_by_what_is_said_of_them) {
  using Found = std::vector<std::string>;
  const VariableHeader lon = variable_of("lon", {"lon"});
  const VariableHeader lat = variable_of("lat", {"lat"});
  EXPECT_EQ(pairs_of({lon, lat}), (Found{"lon/lat axes 9"}));
  EXPECT_EQ(pairs_of({lon, lat, variable_of("v", {"time", "lat", "lon"})}),
            (Found{"lon/lat axes used 13"}));
  EXPECT_EQ(pairs_of({lon, lat, variable_of("v", {"lat"}), variable_of("w", {"lon"})}),
            (Found{"lon/lat axes 9"}));
  EXPECT_EQ(pairs_of({variable_of("a", {"n"}, east), variable_of("b", {"n"}, north)}),
            (Found{"a/b 33"}));
  EXPECT_EQ(pairs_of({variable_of("a", {"n"}, {{"standard_name", "longitude"}}),
                      variable_of("b", {"n"}, {{"standard_name", "latitude"}})}),
            (Found{"a/b 35"}));
  EXPECT_EQ(pairs_of({variable_of("a", {"n"}, {{"standard_name", "longitude"}}),
                      variable_of("b", {"n"}, north)}),
            (Found{"a/b 33"}));
  EXPECT_EQ(pairs_of({lon, lat, variable_of("lon_bnds", {"lon", "nv"}),
                      variable_of("lat_bnds", {"lat", "nv"})}),
            (Found{"lon/lat lon_bnds/lat_bnds axes 25"}));
  EXPECT_EQ(pairs_of({lon, lat, variable_of("lon_bnds", {"lon", "nv"})}),
            (Found{"lon/lat lon_bnds/- axes 9"}));
  EXPECT_EQ(pairs_of({lon, lat, variable_of("lon_vertices", {"lon"}),
                      variable_of("lat_vertices", {"lat"})}),
            (Found{"lon/lat axes 9"}));  // no larger than the coordinates
  EXPECT_EQ(pairs_of({lon, lat, variable_of("lon_b", {"i"}), variable_of("corner_lat", {"j"})}),
            (Found{"lon/lat lon_b/corner_lat axes 25"}));
  VariableHeader text = variable_of("lon_bnds", {"lon", "nv"});
  text.is_number = false;
  EXPECT_EQ(pairs_of({lon, lat, text}), (Found{"lon/lat axes 9"}));
  const Texts list = {{"coordinates", "height b a"}};
  EXPECT_EQ(pairs_of({variable_of("a", {"n"}, east), variable_of("b", {"n"}, north),
                      variable_of("v", {"n"}, list)}),
            (Found{"a/b used listed 101"}));
  EXPECT_EQ(pairs_of({variable_of("a", {"n"}, east), variable_of("b", {"n"}, north),
                      variable_of("v", {"n"}, {{"coordinates", "a"}}),
                      variable_of("w", {"n"}, {{"coordinates", "b c"}})}),
            (Found{"a/b used 37"}));
}

TEST(cf_coordinates, are_no_bounds_of_others) {
  const Texts with_bounds = {{"units", "degrees_east"}, {"bounds", "edges_of_lon"}};
  const std::vector<VariableHeader> variables = {
      variable_of("lon", {"n"}, with_bounds), variable_of("lat", {"n"}, north),
      variable_of("edges_of_lon", {"n"}, east), variable_of("lat_bnds", {"n"}, north)};
  EXPECT_EQ(pairs_of(variables), (std::vector<std::string>{"lon/lat edges_of_lon/- used 37"}));
}

TEST(cf_coordinates, of_one_variable_are_along_its_dimensions) {
  const std::vector<VariableHeader> variables = {
      variable_of("lon", {"lon"}),
      variable_of("lat", {"lat"}),
      variable_of("lonVertex", {"vertex"}),
      variable_of("latVertex", {"vertex"}),
      variable_of("a", {"time", "lat", "lon"}),
      variable_of("b", {"vertex"}),
      variable_of("c", {"lat"}),
  };
  using Found = std::vector<std::string>;
  EXPECT_EQ(pairs_of(variables, {{}, {}, "a"}), (Found{"lon/lat axes used 13"}));
  EXPECT_EQ(pairs_of(variables, {{}, {}, "b"}), (Found{"lonVertex/latVertex used 5"}));
  EXPECT_EQ(pairs_of(variables, {{}, {}, "c"}), Found{});
  EXPECT_EQ(pairs_of(variables), (Found{"lon/lat axes used 13"}));
  EXPECT_EQ(pairs_of(variables, {"lonVertex", "latVertex", ""}),
            (Found{"lonVertex/latVertex used 37"}));
  EXPECT_EQ(pairs_of(variables, {"lonVertex", "", ""}), (Found{"lonVertex/lat axes 9"}));
  EXPECT_THROW((void)find_coordinates(variables, {{}, {}, "none"}), InvalidInput);
}

TEST(cf_coordinates, of_a_mesh_are_those_of_its_topology) {
  const std::vector<VariableHeader> variables = {
      variable_of("mesh", {}, {{"node_coordinates", "nx ny"}, {"face_coordinates", "fx fy"}}),
      variable_of("fx", {"face"}, east),
      variable_of("fy", {"face"}, north),
      variable_of("gx", {"face"}, east),
      variable_of("gy", {"face"}, north),
      variable_of("v", {"face"}, {{"mesh", "mesh"}, {"location", "face"}}),
      variable_of("w", {"face"}, {{"mesh", "mesh"}, {"location", "node"}})};
  const auto listed = [&](const std::string& values) {
    std::string names;
    for (const CoordinatePair& pair : find_coordinates(variables, {{}, {}, values})) {
      if (pair.is_listed) names += variables[pair.lon].name + variables[pair.lat].name;
    }
    return names;
  };
  EXPECT_EQ(listed("v"), "fxfy");
  EXPECT_EQ(listed("w"), "");
  EXPECT_EQ(listed("gx"), "");
}

TEST(netcdf_groups, names_are_searched_from_the_group_up) {
  io::NetcdfHeader header;
  const auto add = [&](const std::string& name, const Texts& texts = {}) {
    io::VariableInFile variable;
    variable.name = name;
    for (const auto& [key, text] : texts) {
      variable.attributes.push_back({key, io::NetcdfType::text, text, {}});
    }
    header.variables.push_back(variable);
  };
  add("x");
  add("y", {{"bounds", "g/x"}, {"coordinates", "x  y"}});
  add("g/x");
  add("g/h/x");
  add("g/h/v", {{"coordinates", "x ../x ../../x /x /g/z y none"},
                {"bounds", "y"},
                {"mesh", "../y"},
                {"node_coordinates", "../../../x"},
                {"face_connectivity", "x"},
                {"long_name", "x"}});
  add("g/w", {{"coordinates", "x h/x y"}});
  io::resolve_names(header);
  const auto text = [&](std::size_t v, std::size_t a) {
    return header.variables[v].attributes[a].text;
  };
  EXPECT_EQ(text(1, 0), "g/x");
  EXPECT_EQ(text(1, 1), "x  y");
  EXPECT_EQ(text(4, 0), "g/h/x g/x x x /g/z y none");
  EXPECT_EQ(text(4, 1), "y");
  EXPECT_EQ(text(4, 2), "y");
  EXPECT_EQ(text(4, 3), "x");
  EXPECT_EQ(text(4, 4), "g/h/x");
  EXPECT_EQ(text(4, 5), "x");
  EXPECT_EQ(text(5, 0), "g/x g/h/x y");
  const auto full = [&](const std::string& name) { return io::full_name(header.variables, name); };
  EXPECT_EQ(full("/g/x"), "g/x");
  EXPECT_EQ(full("x"), "x");
  EXPECT_EQ(full("v"), "g/h/v");
  EXPECT_EQ(full("v[3]"), "g/h/v[3]");
  EXPECT_EQ(full("/x[1,2]"), "x[1,2]");
  EXPECT_EQ(full("h/x"), "g/h/x");
  EXPECT_EQ(full("none[1]"), "none[1]");
  EXPECT_EQ(full(""), "");
  header.variables.erase(header.variables.begin());
  EXPECT_EQ(full("x"), "x");  // two groups have one
}

}  // namespace
}  // namespace rondel::test::of_names
