// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "interpolation/field_names.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include "system/shortest_text.h"

namespace rondel::interpolation {
namespace {

constexpr std::int64_t seconds_per_day = 86400;

enum class Calendar { gregorian, no_leap, days_360 };

struct Date {
  std::int64_t year = 0;
  std::int64_t month = 1;
  std::int64_t day = 1;
};

std::string attribute_of(const FieldArray& axis, std::string_view name) {
  for (const auto& [key, text] : axis.attributes) {
    if (key == name) return text;
  }
  return {};
}

std::optional<Calendar> calendar_of(const FieldArray& axis) {
  const std::string name = attribute_of(axis, "calendar");
  if (name.empty() || name == "standard" || name == "gregorian" || name == "proleptic_gregorian") {
    return Calendar::gregorian;
  }
  if (name == "noleap" || name == "365_day") return Calendar::no_leap;
  if (name == "360_day") return Calendar::days_360;
  return std::nullopt;
}

bool is_leap_year(std::int64_t year) {
  return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
}

std::int64_t days_of_month(Calendar calendar, std::int64_t year, std::int64_t month) {
  if (calendar == Calendar::days_360) return 30;
  constexpr std::array<std::int64_t, 12> days = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_longer = month == 2 && calendar == Calendar::gregorian && is_leap_year(year);
  return days[static_cast<std::size_t>(month - 1)] + (is_longer ? 1 : 0);
}

// Returns the number of days in the years 0 ... year - 1.
std::int64_t days_before(Calendar calendar, std::int64_t year) {
  if (calendar == Calendar::days_360) return 360 * year;
  const std::int64_t leap_years =
      year == 0 ? 0 : (year - 1) / 4 - (year - 1) / 100 + (year - 1) / 400 + 1;
  return 365 * year + (calendar == Calendar::gregorian ? leap_years : 0);
}

std::int64_t day_number(Calendar calendar, const Date& date) {
  std::int64_t days = days_before(calendar, date.year) + date.day - 1;
  for (std::int64_t month = 1; month < date.month; ++month) {
    days += days_of_month(calendar, date.year, month);
  }
  return days;
}

Date date_of(Calendar calendar, std::int64_t days) {
  Date date;
  date.year = days / 366;  // this is at most the year of the date
  while (days_before(calendar, date.year + 1) <= days) ++date.year;
  days -= days_before(calendar, date.year);
  while (days >= days_of_month(calendar, date.year, date.month)) {
    days -= days_of_month(calendar, date.year, date.month++);
  }
  date.day = days + 1;
  return date;
}

// Takes the number at the front of a text, and one separator behind it, away from the text and
// returns it.
std::optional<std::int64_t> take_number(std::string_view& text, std::string_view separators) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value < 0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (!text.empty() && separators.find(text.front()) != std::string_view::npos) {
    text.remove_prefix(1);
  }
  return value;
}

// The unit in seconds and the second from which times count, as in "hours since 2000-01-01 06:00".
// A text with anything else in it, such as a time zone other than UTC, has none.
struct TimeUnits {
  double seconds = 1;
  std::int64_t start = 0;
};

std::optional<double> seconds_of_unit(std::string_view unit) {
  constexpr std::array<std::pair<std::string_view, double>, 16> units = {{{"days", 86400},
                                                                          {"day", 86400},
                                                                          {"d", 86400},
                                                                          {"hours", 3600},
                                                                          {"hour", 3600},
                                                                          {"hrs", 3600},
                                                                          {"hr", 3600},
                                                                          {"h", 3600},
                                                                          {"minutes", 60},
                                                                          {"minute", 60},
                                                                          {"mins", 60},
                                                                          {"min", 60},
                                                                          {"seconds", 1},
                                                                          {"second", 1},
                                                                          {"sec", 1},
                                                                          {"s", 1}}};
  for (const auto& [name, seconds] : units) {
    if (name == unit) return seconds;
  }
  return std::nullopt;
}

std::optional<TimeUnits> time_units(const std::string& text, Calendar calendar) {
  const std::size_t since = text.find(" since ");
  if (since == std::string::npos) return std::nullopt;
  const std::optional<double> seconds = seconds_of_unit(std::string_view(text).substr(0, since));
  std::string_view rest = std::string_view(text).substr(since + 7);
  const auto year = take_number(rest, "-");
  const auto month = take_number(rest, "-");
  const auto day = take_number(rest, " T");
  if (!seconds || !year || !month || !day || *year > 9999 || *month < 1 || *month > 12) {
    return std::nullopt;
  }
  if (*day < 1 || *day > days_of_month(calendar, *year, *month)) return std::nullopt;
  // The Julian calendar was in use before; the standard calendar of CF changes to it there.
  if (calendar == Calendar::gregorian && *year < 1583) return std::nullopt;
  std::int64_t clock = 0;
  for (const std::int64_t unit : {3600, 60, 1}) {
    if (rest.empty()) break;
    const auto number = take_number(rest, ":");
    if (!number || *number >= 86400 / unit) return std::nullopt;
    clock += *number * unit;
  }
  for (const std::string_view end : {"", ".0", ".00", ".000", ".000000", "Z", " UTC", "UTC"}) {
    if (rest != end) continue;
    const std::int64_t days = day_number(calendar, {*year, *month, *day});
    return TimeUnits{*seconds, days * seconds_per_day + clock};
  }
  return std::nullopt;
}

std::vector<std::string> dates_of(const FieldArray& axis) {
  const std::optional<Calendar> calendar = calendar_of(axis);
  if (!calendar) return {};
  const auto units = time_units(attribute_of(axis, "units"), *calendar);
  if (!units) return {};
  std::vector<std::int64_t> times;
  const double last = static_cast<double>(day_number(*calendar, {9999, 12, 30})) * seconds_per_day;
  // Before this day the standard calendar is the Julian one, and has no dates here.
  const bool is_mixed =
      *calendar == Calendar::gregorian && attribute_of(axis, "calendar") != "proleptic_gregorian";
  const double first =
      is_mixed ? static_cast<double>(day_number(*calendar, {1582, 10, 15})) * seconds_per_day : 0;
  for (const double value : axis.values) {
    const double time = std::round(value * units->seconds) + static_cast<double>(units->start);
    if (!(time >= first && time <= last)) return {};
    times.push_back(static_cast<std::int64_t>(time));
  }
  const bool are_days =
      std::ranges::all_of(times, [](std::int64_t time) { return time % seconds_per_day == 0; });
  std::vector<std::string> dates;
  for (const std::int64_t time : times) {
    const Date date = date_of(*calendar, time / seconds_per_day);
    const std::int64_t clock = time % seconds_per_day;
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%04d-%02d-%02d", static_cast<int>(date.year),
                  static_cast<int>(date.month), static_cast<int>(date.day));
    dates.emplace_back(text.data());
    if (are_days) continue;
    std::snprintf(text.data(), text.size(), "T%02d:%02d:%02d", static_cast<int>(clock / 3600),
                  static_cast<int>(clock / 60 % 60), static_cast<int>(clock % 60));
    dates.back() += text.data();
  }
  return dates;
}

bool are_different(std::vector<std::string> texts) {
  std::ranges::sort(texts);
  return std::ranges::adjacent_find(texts) == texts.end();
}

}  // namespace

std::vector<std::string> places_on_axis(const FieldArray& axis) {
  std::vector<std::string> places = dates_of(axis);
  if (places.empty() || !are_different(places)) {
    places.clear();
    for (const double value : axis.values) places.push_back(system::shortest_text(value));
  }
  if (!are_different(places)) places.clear();
  return places;
}

}  // namespace rondel::interpolation

namespace rondel {

std::vector<std::string> names_of_fields(const FieldArray& array,
                                         std::span<const FieldArray> axes) {
  std::vector<std::string> names = {array.name};
  if (array.num_fields() == 1) return names;
  for (std::size_t d = 0; d < array.shape.size(); ++d) {
    std::vector<std::string> places;
    for (const FieldArray& axis : axes) {
      const bool is_this = d < array.dimensions.size() && axis.name == array.dimensions[d] &&
                           axis.values.size() == array.shape[d];
      if (is_this) places = interpolation::places_on_axis(axis);
    }
    std::vector<std::string> longer;
    for (const std::string& name : names) {
      for (std::size_t i = 0; i < array.shape[d]; ++i) {
        longer.push_back(name + "_" + (places.empty() ? std::to_string(i) : places[i]));
      }
    }
    names = std::move(longer);
  }
  return names;
}

}  // namespace rondel
