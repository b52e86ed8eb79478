// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The names of fields in tables, where each is a column.
#include "formats/field_names.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace rondel::test {
namespace {

using formats::places_on_axis;
using Names = std::vector<std::string>;

FieldArray axis(std::string name, std::vector<double> values,
                std::vector<std::pair<std::string, std::string>> attributes = {}) {
  FieldArray array;
  array.name = name;
  array.dimensions = {std::move(name)};
  array.shape = {values.size()};
  array.values = std::move(values);
  array.attributes = std::move(attributes);
  return array;
}

// The dates are those of cftime 1.6, rounded to milliseconds where one has a fraction of a second.
TEST(field_names, are_dates_by_the_units_and_calendars_of_cf) {
  struct Case {
    std::string units, calendar;
    std::vector<double> values;
    Names dates;
  };
  const std::vector<Case> cases = {
      {"days since 1850-01-01",
       "standard",
       {0.0, 161000.5847, 161588.1579},
       {"1850-01-01T00:00:00.000", "2290-10-21T14:01:58.080", "2292-05-31T03:47:22.560"}},
      {"hours since 1583-12-31 23:00:00",
       "gregorian",
       {0.0, 103065.1122, 57160.276},
       {"1583-12-31T23:00:00.000", "1595-10-04T08:06:43.920", "1590-07-09T15:16:33.600"}},
      {"minutes since 2000-02-28 12:30",
       "proleptic_gregorian",
       {0.0, 10786.1405, 76673.7762},
       {"2000-02-28T12:30:00.000", "2000-03-07T00:16:08.430", "2000-04-21T18:23:46.572"}},
      {"seconds since 1970-01-01T00:00:00Z",
       "standard",
       {0.0, 81694.6411, 9055.0388},
       {"1970-01-01T00:00:00.000", "1970-01-01T22:41:34.641", "1970-01-01T02:30:55.039"}},
      {"days since 0001-01-01",
       "noleap",
       {0.0, 9751.5421, 199835.223},
       {"0001-01-01T00:00:00.000", "0027-09-19T13:00:37.440", "0548-06-30T05:21:07.200"}},
      {"days since 2000-02-29",
       "360_day",
       {0.0, 130473.8223, 46902.0403},
       {"2000-02-29T00:00:00.000", "2362-08-02T19:44:06.720", "2130-06-11T00:58:01.920"}},
      {"d since 1900-2-1",
       "365_day",
       {0.0, 86989.5104, 194837.2387},
       {"1900-02-01T00:00:00.000", "2138-05-31T12:14:58.560", "2433-11-20T05:43:43.680"}},
      {"hours since 1999-12-31 00:00:0.0",
       "standard",
       {0.0, 179535.5216, 168846.2075},
       {"1999-12-31T00:00:00.000", "2020-06-23T15:31:17.760", "2019-04-05T06:12:27.000"}},
      {"hours since 1-1-1 00:00:0.0",
       "proleptic_gregorian",
       {17557896, 17557902.5},
       {"2003-12-31T00:00:00", "2003-12-31T06:30:00"}},
      {"days since 0001-01-01",
       "standard",
       {730000, 730000.25},
       {"1999-09-02T00:00:00", "1999-09-02T06:00:00"}},
      {"days since 1582-10-04 12:00",
       "standard",
       {1, 145000.5},
       {"1582-10-15T12:00:00", "1979-10-14T00:00:00"}},
      {"days since 1900-01-01",
       "julian",
       {36524, 0.5},
       {"1999-12-31T00:00:00", "1900-01-01T12:00:00"}},
      {"days since 1899-03-01",
       "all_leap",
       {36524.25, 0},
       {"1998-12-16T06:00:00", "1899-03-01T00:00:00"}},
      {"Milliseconds since 1970-01-01",
       "Standard",
       {1e12, 500},
       {"2001-09-09T01:46:40.000", "1970-01-01T00:00:00.500"}},
      {"hours since 2000-01-01 00:00:00 +05:30",
       "standard",
       {0.5, 24},
       {"1999-12-31T19:00:00", "2000-01-01T18:30:00"}},
      // The example of CF, whose hour has one digit, and others of UDUNITS.
      {"seconds since 1992-10-8 15:15:42 -6:00",
       "",
       {0, 18},
       {"1992-10-08T21:15:42", "1992-10-08T21:16:00"}},
      {"Hours Since 2000-01-01 00:00 -6",
       "",
       {0, 18.5},
       {"2000-01-01T06:00:00", "2000-01-02T00:30:00"}},
      {"hours since 2000-01-01 00:00 +530",
       "",
       {0.5, 24},
       {"1999-12-31T19:00:00", "2000-01-01T18:30:00"}},
      // Half a second apart; a float32 that is off by less than a hundredth counts as a whole second.
      {"seconds since 1970-01-01",
       "",
       {1e9, 1e9 + 0.5},
       {"2001-09-09T01:46:40.000", "2001-09-09T01:46:40.500"}},
      {"hours since 2000-01-01",
       "",
       {0.33333334F, 1},
       {"2000-01-01T00:20:00", "2000-01-01T01:00:00"}},
  };
  for (const Case& c : cases) {
    const FieldArray time = axis("time", c.values, {{"units", c.units}, {"calendar", c.calendar}});
    EXPECT_EQ(places_on_axis(time), c.dates) << c.units;
  }
}

std::string text_of(std::chrono::sys_days days) {
  const std::chrono::year_month_day date(days);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  return text.data();
}

// The dates are those of std::chrono, for each day around the ends of centuries.
TEST(field_names, are_the_days_of_four_centuries) {
  using std::chrono::days;
  using std::chrono::sys_days;
  using std::chrono::year;
  const sys_days start = year(1600) / 3 / 1;
  std::vector<double> values;
  Names expected;
  for (const int first : {1600, 1699, 1899, 1999, 2099, 2399}) {
    const auto from = static_cast<int>((sys_days(year(first) / 12 / 1) - start).count());
    for (int day = from < 0 ? 0 : from; day < from + 800; ++day) {
      values.push_back(day);
      expected.push_back(text_of(start + days(day)));
    }
  }
  EXPECT_EQ(places_on_axis(axis("time", values, {{"units", "days since 1600-03-01"}})), expected);
}

TEST(field_names, know_the_words_for_units) {
  for (const auto& [units, seconds] : {std::pair{"days day d", 86400},
                                       {"hours hour hrs hr h", 3600},
                                       {"minutes minute mins min", 60},
                                       {"seconds second sec s", 1}}) {
    std::istringstream words(units);
    for (std::string word; words >> word;) {
      EXPECT_EQ(places_on_axis(axis("time", {1, 1 + 86401.0 / seconds},
                                    {{"units", word + " since 2001-01-31 00:00:01"}})),
                (Names{places_on_axis(axis("time", {double(seconds) + 1, 0},
                                           {{"units", "s since 2001-01-31"}}))[0],
                       places_on_axis(axis("time", {double(seconds) + 86402, 1},
                                           {{"units", "s since 2001-01-31"}}))[0]}))
          << word;
    }
  }
  EXPECT_EQ(places_on_axis(axis("time", {3661, 90061}, {{"units", "s since 2001-01-31"}})),
            (Names{"2001-01-31T01:01:01", "2001-02-01T01:01:01"}));
}

TEST(field_names, are_dates_from_the_first_to_the_last_that_there_is) {
  const auto has_dates = [](const std::string& start, const std::string& calendar = "standard") {
    const Names found = places_on_axis(
        axis("time", {0, 1}, {{"units", "s since " + start}, {"calendar", calendar}}));
    return found != Names{"0", "1"};
  };
  for (const char* start :
       {"1583-1-1", "9999-12-1", "2001-12-31", "2000-2-29", "2001-1-1 23:59:59", "2001-1-1 0:0:0.0",
        "2001-1-1 0", "2001-1-1 0:0:0 UTC", "2001-1-1 0:0 +1"}) {
    EXPECT_TRUE(has_dates(start)) << start;
  }
  for (const char* start :
       {"1582-10-5", "1582-10-14", "10000-1-1", "2001-0-1", "2001-13-1", "2001-1-0", "2001-4-31",
        "2001-2-29", "1900-2-29", "2001-1-1 24", "2001-1-1 0:1440", "2001-1-1 0:0:0.5", "2001-1",
        "2001-1-1 -1", "2001-1-1 -1:00", "2001-1-1 0:0 +05:60", "2001-1-1 0:0 CET"}) {
    EXPECT_FALSE(has_dates(start)) << start;
  }
  EXPECT_TRUE(has_dates("2001-2-30", "360_day"));
  EXPECT_FALSE(has_dates("2001-1-31", "360_day"));
  EXPECT_FALSE(has_dates("2000-2-29", "noleap"));
  EXPECT_TRUE(has_dates("1582-12-31", "noleap"));
  // Beyond the year 9999 and before the year 0 there are none.
  const std::vector<double> values = {0, 1e9};
  EXPECT_EQ(places_on_axis(axis("time", values, {{"units", "h since 2000-1-1"}})).back(), "1e+09");
  EXPECT_EQ(
      places_on_axis(axis("time", {-1, 0}, {{"units", "d since 0-1-1"}, {"calendar", "noleap"}})),
      (Names{"-1", "0"}));
}

// The standard calendar is the Julian one before 15 October 1582.
TEST(field_names, are_numbers_before_the_gregorian_calendar) {
  const auto names = [](const char* calendar, double day) {
    return places_on_axis(
        axis("time", {day, 0}, {{"units", "days since 1600-01-01"}, {"calendar", calendar}}));
  };
  for (const char* calendar : {"standard", "gregorian", ""}) {
    EXPECT_EQ(names(calendar, -80000), (Names{"-80000", "0"}));
    EXPECT_EQ(names(calendar, -6288), (Names{"-6288", "0"}));
    EXPECT_EQ(names(calendar, -6287), (Names{"1582-10-15", "1600-01-01"}));
  }
  EXPECT_EQ(names("proleptic_gregorian", -80000), (Names{"1380-12-19", "1600-01-01"}));
}

TEST(field_names, have_no_clock_where_all_times_are_midnight) {
  EXPECT_EQ(places_on_axis(axis("time", {0, 59, 366}, {{"units", "days since 2000-01-01"}})),
            (Names{"2000-01-01", "2000-02-29", "2001-01-01"}));
}

TEST(field_names, are_numbers_where_units_or_calendars_are_not_known) {
  for (const char* units :
       {"fortnights since 2000-01-01", "days since then", "days", "hPa", "days since 2000-13-01",
        "days since 2000-02-30", "days since 2000-01-01 00:00:00 CET", "days since 1200-01-01",
        "days since 2000-01-01 00:00 -15:00", "days since 2000-01-01 00:00 +0530:00",
        "days since 2000-01-01 00:00 +5:60", "days since 2000-01-01 00:00 +00530"}) {
    EXPECT_EQ(places_on_axis(axis("time", {0.5, 1000}, {{"units", units}})), (Names{"0.5", "1000"}))
        << units;
  }
  EXPECT_EQ(places_on_axis(
                axis("time", {1, 2}, {{"units", "days since 2000-01-01"}, {"calendar", "mayan"}})),
            (Names{"1", "2"}));
}

TEST(field_names, fall_back_to_what_differs) {
  EXPECT_EQ(places_on_axis(axis("time", {0, 1e-9}, {{"units", "days since 2000-01-01"}})),
            (Names{"0", "1e-09"}));
  EXPECT_EQ(places_on_axis(axis("lev", {5, 5})), Names{});
}

TEST(field_names, have_a_part_for_each_axis) {
  FieldArray array;
  array.name = "tas";
  EXPECT_EQ(names_of_fields(array, {}), Names{"tas"});
  array.dimensions = {"time", "lev"};
  array.shape = {2, 2};
  const std::vector<FieldArray> axes = {axis("lev", {850, 500.5}),
                                        axis("time", {0, 1}, {{"units", "days since 2001-07-15"}})};
  EXPECT_EQ(names_of_fields(array, axes), (Names{"tas_2001-07-15_850", "tas_2001-07-15_500.5",
                                                 "tas_2001-07-16_850", "tas_2001-07-16_500.5"}));
  EXPECT_EQ(names_of_fields(array, {}), (Names{"tas_0_0", "tas_0_1", "tas_1_0", "tas_1_1"}));
}

}  // namespace
}  // namespace rondel::test
