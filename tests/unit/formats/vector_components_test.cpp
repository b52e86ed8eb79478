// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What files say of two variables that are to be components of vectors.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

#include "rondel/conventions.h"

namespace rondel::test {
namespace {

std::string lack_by_names(const std::string& east, const std::string& north,
                          bool is_along_axes = false) {
  return lack_of_vectors({"u", east, ""}, {"v", north, ""}, is_along_axes);
}
bool have_same_units(const std::string& a, const std::string& b) {
  return lack_of_vectors({"u", "", a}, {"v", "", b}, false).empty();
}

TEST(vector_components, have_standard_names_with_their_direction) {
  constexpr std::array<std::pair<const char*, const char*>, 7> good = {
      {{"eastward_wind", "northward_wind"},
       {"surface_downward_eastward_stress", "surface_downward_northward_stress"},
       {"sea_surface_wave_stokes_drift_eastward_velocity",
        "sea_surface_wave_stokes_drift_northward_velocity"},
       {"zonal_wind", "meridional_wind"},
       {"eastward_wind", ""},
       {"unknown", "unknown"},
       {"10 metre U wind component", "10 metre V wind component"}}};
  for (const auto& [east, north] : good) EXPECT_EQ(lack_by_names(east, north), "");
  constexpr std::array<std::pair<const char*, const char*>, 6> bad = {
      {{"northward_wind", "eastward_wind"},
       {"eastward_wind", "eastward_wind"},
       {"eastward_wind", "northward_sea_water_velocity"},
       {"eastward_wind", "air_temperature"},
       {"grid_eastward_wind", "grid_northward_wind"},
       {"tendency_of_eastward_wind", "northward_wind"}}};
  for (const auto& [east, north] : bad) EXPECT_NE(lack_by_names(east, north), "") << east;
  EXPECT_EQ(lack_by_names("northward_wind", ""),
            "'u' has the standard_name 'northward_wind', which is no eastward component");
  // Along longitudes and latitudes x and y are east and north.
  EXPECT_EQ(lack_by_names("x_wind", "y_wind", true), "");
  EXPECT_NE(lack_by_names("x_wind", "y_wind", false), "");
  EXPECT_NE(lack_by_names("y_wind", "x_wind", true), "");
}

TEST(vector_components, have_units_that_are_the_same_in_any_spelling) {
  for (const char* const text : {"m s-1", "m/s", "m s^-1", "m s**-1", "m.s-1", "s-1 m", "m*s-1",
                                 "meters per second", "metre second-1", " m s-1 "}) {
    EXPECT_TRUE(have_same_units("m s-1", text)) << text;
  }
  for (const char* const text :
       {"km h-1", "m s", "m s-2", "m", "cm s-1", "knots", "m/s/s", "M s-1"}) {
    EXPECT_FALSE(have_same_units("m s-1", text)) << text;
  }
  EXPECT_TRUE(have_same_units("", "m s-1"));
  EXPECT_TRUE(have_same_units("N m-2", "newton/m^2"));
  EXPECT_TRUE(have_same_units("1", "1"));
  EXPECT_TRUE(have_same_units("kg m-1 s-2", "kg/m/s^2"));
  EXPECT_EQ(lack_of_vectors({"u", "", "m s-1"}, {"v", "", "km h-1"}, false),
            "'u' has the units 'm s-1', and 'v' 'km h-1'");
}

TEST(vector_components, have_no_flags) {
  EXPECT_EQ(lack_of_vectors({"u", "", "", false}, {"v", "", "", true}, true),
            "'v' has flags, whose values stand for categories");
}

}  // namespace
}  // namespace rondel::test
