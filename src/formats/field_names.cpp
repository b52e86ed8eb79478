// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Names of fields in a table: names_of_fields() joins the name of a variable with the places of the
// field along the other axes, tas_2001-07-15. Times are read by CF 1.11, section 4.4 ("hours since
// 2000-01-01"), in the calendars of section 4.4.1, and become dates by counting days from the year
// 0.
#include "formats/field_names.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "formats/cf_names.h"
#include "system/message_text.h"

namespace rondel::formats {
namespace {

constexpr std::int64_t seconds_per_day = 86400;

// `mixed` is the standard calendar of CF: the Julian one before 15 October 1582, and then the
// Gregorian one, in which its days are counted here.
enum class Calendar { mixed, gregorian, julian, no_leap, all_leap, days_360 };

// A date of some calendar; months and days count from 1.
struct Date {
  std::int64_t year = 0;
  std::int64_t month = 1;
  std::int64_t day = 1;
};

// Returns the text of an attribute; it is empty if the axis has none of this name.
std::string attribute_of(const FieldArray& axis, std::string_view name) {
  for (const auto& [key, text] : axis.attributes) {
    if (key == name) return text;
  }
  return {};
}

// Returns the calendar that the attribute `calendar` names (CF 1.11, section 4.4.1).
std::optional<Calendar> calendar_of(const FieldArray& axis) {
  const std::string name = lower_case(without_blanks(attribute_of(axis, "calendar")));
  constexpr std::array<std::pair<std::string_view, Calendar>, 10> calendars = {
      {{"", Calendar::mixed},
       {"standard", Calendar::mixed},
       {"gregorian", Calendar::mixed},
       {"proleptic_gregorian", Calendar::gregorian},
       {"julian", Calendar::julian},
       {"noleap", Calendar::no_leap},
       {"365_day", Calendar::no_leap},
       {"all_leap", Calendar::all_leap},
       {"366_day", Calendar::all_leap},
       {"360_day", Calendar::days_360}}};
  for (const auto& [known, calendar] : calendars) {
    if (known == name) return calendar;
  }
  return std::nullopt;
}

// True for a leap year. The mixed calendar counts as the Gregorian one here.
bool is_leap_year(Calendar calendar, std::int64_t year) {
  if (calendar == Calendar::no_leap) return false;
  if (calendar == Calendar::all_leap) return true;
  const bool is_julian = calendar == Calendar::julian;
  return year % 4 == 0 && (is_julian || year % 100 != 0 || year % 400 == 0);
}

// Returns the number of days of a month, which counts from 1.
std::int64_t days_of_month(Calendar calendar, std::int64_t year, std::int64_t month) {
  if (calendar == Calendar::days_360) return 30;
  constexpr std::array<std::int64_t, 12> days = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_longer = month == 2 && is_leap_year(calendar, year);
  return days[static_cast<std::size_t>(month - 1)] + (is_longer ? 1 : 0);
}

// Returns the number of days in the years 0 ... year - 1.
std::int64_t days_before(Calendar calendar, std::int64_t year) {
  if (calendar == Calendar::days_360) return 360 * year;
  if (calendar == Calendar::all_leap) return 366 * year;
  if (calendar == Calendar::no_leap || year == 0) return 365 * year;
  // The year 0 is a leap year in both calendars, hence the 1.
  const std::int64_t of_four_years = (year - 1) / 4 + 1;
  if (calendar == Calendar::julian) return 365 * year + of_four_years;
  return 365 * year + of_four_years - (year - 1) / 100 + (year - 1) / 400;
}

// Returns the number of days from 1 January of the year 0 to a date.
std::int64_t day_number(Calendar calendar, const Date& date) {
  std::int64_t days = days_before(calendar, date.year) + date.day - 1;
  for (std::int64_t month = 1; month < date.month; ++month) {
    days += days_of_month(calendar, date.year, month);
  }
  return days;
}

// Returns the date with this number of days; the inverse of day_number().
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
// A text with anything else in it has none.
struct TimeUnits {
  double seconds = 1;
  std::int64_t start = 0;
};

// Returns the length of a unit of time in seconds; months and years have none.
std::optional<double> seconds_of_unit(std::string_view unit) {
  constexpr std::array<std::pair<std::string_view, double>, 22> units = {
      {{"days", 86400},        {"day", 86400},        {"d", 86400},   {"hours", 3600},
       {"hour", 3600},         {"hrs", 3600},         {"hr", 3600},   {"h", 3600},
       {"minutes", 60},        {"minute", 60},        {"mins", 60},   {"min", 60},
       {"seconds", 1},         {"second", 1},         {"sec", 1},     {"s", 1},
       {"milliseconds", 1e-3}, {"millisecond", 1e-3}, {"msec", 1e-3}, {"ms", 1e-3},
       {"microseconds", 1e-6}, {"microsecond", 1e-6}}};
  for (const auto& [name, seconds] : units) {
    if (name == unit) return seconds;
  }
  return std::nullopt;
}

// The first day of the Gregorian calendar in the mixed one.
constexpr Date first_gregorian_date{1582, 10, 15};

// Returns the number of a date from which times count, or nothing if the calendar has no such date.
std::optional<std::int64_t> start_day(Calendar calendar, const Date& date) {
  constexpr Date first_not_julian{1582, 10, 5};
  const auto is_before = [&](const Date& other) {
    return std::tie(date.year, date.month, date.day) < std::tie(other.year, other.month, other.day);
  };
  // A date before the reform is counted by the Julian calendar, and moved so that 5 October 1582
  // (Julian) is 15 October (Gregorian).
  const bool is_julian = calendar == Calendar::mixed && is_before(first_gregorian_date);
  if (is_julian && !is_before(first_not_julian)) return std::nullopt;  // 5 to 14 October 1582
  const Calendar own = is_julian ? Calendar::julian : calendar;
  if (date.day > days_of_month(own, date.year, date.month)) return std::nullopt;
  const std::int64_t days = day_number(own, date);
  if (!is_julian) return days;
  return days - day_number(Calendar::julian, first_not_julian) +
         day_number(Calendar::gregorian, first_gregorian_date);
}

// Returns the seconds by which the clock of a time zone is ahead of UTC; nothing for other texts.
// "+05:30", "-03", "+0530", "Z" and "UTC" are time zones, "-6:00" and "-3" behind a clock alone.
std::optional<std::int64_t> zone_seconds(std::string_view text, bool has_clock) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  if (text.empty() || text == "Z" || text == "UTC" || text == "GMT") return 0;
  const bool is_west = text.front() == '-';
  if (!is_west && text.front() != '+') return std::nullopt;
  std::string_view rest = text.substr(1);
  const std::size_t digits = std::min(rest.find(':'), rest.size());
  const auto first = take_number(rest, ":");
  const auto second = rest.empty() ? std::optional<std::int64_t>(0) : take_number(rest, "");
  if (!first || !second || !rest.empty() || digits > 4) return std::nullopt;
  if (digits < 2 && !has_clock) return std::nullopt;
  const bool has_minutes = digits > 2;  // as in "0530"
  if (has_minutes && digits + 1 < text.size()) return std::nullopt;
  const std::int64_t hours = has_minutes ? *first / 100 : *first;
  const std::int64_t minutes = has_minutes ? *first % 100 : *second;
  if (hours > 14 || minutes > 59) return std::nullopt;
  return (is_west ? -60 : 60) * (60 * hours + minutes);
}

// Takes ".0" at the front away from the text, as in "00:00:00.0".
void take_zero_fraction(std::string_view& text) {
  if (!text.starts_with(".0")) return;
  text.remove_prefix(std::min(text.find_first_not_of('0', 1), text.size()));
}

// Reads units of time; nothing for texts that are none.
std::optional<TimeUnits> time_units(const std::string& text, Calendar calendar) {
  const std::size_t since = lower_case(text).find(" since ");
  if (since == std::string::npos) return std::nullopt;
  const std::string unit = lower_case(without_blanks(std::string_view(text).substr(0, since)));
  const std::optional<double> seconds = seconds_of_unit(unit);
  std::string_view rest = std::string_view(text).substr(since + 7);
  const auto year = take_number(rest, "-");
  const auto month = take_number(rest, "-");
  const auto day = take_number(rest, " T");
  if (!seconds || !year || !month || !day || *year > 9999 || *month < 1 || *month > 12) {
    return std::nullopt;
  }
  if (*day < 1) return std::nullopt;
  const std::optional<std::int64_t> days = start_day(calendar, {*year, *month, *day});
  if (!days) return std::nullopt;
  std::int64_t clock = 0;
  const bool has_clock = !rest.empty() && rest.front() >= '0' && rest.front() <= '9';
  // The clock has up to three numbers: hours, minutes and seconds.
  for (const std::int64_t of_number : {3600, 60, 1}) {
    if (rest.empty() || rest.front() < '0' || rest.front() > '9') break;
    const auto number = take_number(rest, ":");
    if (!number || *number >= 86400 / of_number) return std::nullopt;
    clock += *number * of_number;
  }
  take_zero_fraction(rest);
  const std::optional<std::int64_t> zone = zone_seconds(rest, has_clock);
  if (!zone) return std::nullopt;
  return TimeUnits{*seconds, *days * seconds_per_day + clock - *zone};
}

// Times are rounded to seconds, and to milliseconds if one is farther than this from a second.
constexpr double max_off_second = 0.01;
constexpr std::int64_t ms_per_day = 1000 * seconds_per_day;

// Returns a time, in milliseconds from the year 0, as ISO 8601.
std::string text_of_time(Calendar calendar, std::int64_t ms, bool has_clock, bool has_ms) {
  const Date date =
      date_of(calendar == Calendar::mixed ? Calendar::gregorian : calendar, ms / ms_per_day);
  const std::int64_t clock = ms % ms_per_day;
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02d-%02d", static_cast<int>(date.year),
                static_cast<int>(date.month), static_cast<int>(date.day));
  std::string result = text.data();
  if (!has_clock) return result;
  std::snprintf(text.data(), text.size(), "T%02d:%02d:%02d", static_cast<int>(clock / 3600000),
                static_cast<int>(clock / 60000 % 60), static_cast<int>(clock / 1000 % 60));
  result += text.data();
  if (!has_ms) return result;
  std::snprintf(text.data(), text.size(), ".%03d", static_cast<int>(clock % 1000));
  return result + text.data();
}

// Returns the dates along an axis of times; none if it is no such axis, or a time is too early or
// late.
std::vector<std::string> dates_of(const FieldArray& axis) {
  const std::optional<Calendar> calendar = calendar_of(axis);
  if (!calendar) return {};
  const auto units = time_units(attribute_of(axis, "units"), *calendar);
  if (!units) return {};
  const Calendar counted = *calendar == Calendar::mixed ? Calendar::gregorian : *calendar;
  const double last = static_cast<double>(day_number(counted, {9999, 12, 30})) * seconds_per_day;
  // Before its first day the mixed calendar is the Julian one, and has no dates here.
  const double first =
      *calendar == Calendar::mixed
          ? static_cast<double>(day_number(counted, first_gregorian_date)) * seconds_per_day
          : 0;
  const auto start = static_cast<double>(units->start);
  bool has_ms = false;
  for (const double value : axis.values) {
    const double since = value * units->seconds;
    has_ms = has_ms || std::abs(since - std::round(since)) > max_off_second;
    if (!(std::round(since) + start >= first && std::round(since) + start <= last)) return {};
  }
  std::vector<std::int64_t> times;
  for (const double value : axis.values) {
    const double since = value * units->seconds;
    const double ms = has_ms ? std::round(since * 1000) : 1000 * std::round(since);
    times.push_back(static_cast<std::int64_t>(ms) + 1000 * units->start);
    if (times.back() < 0) return {};
  }
  const bool are_days =
      std::ranges::all_of(times, [](std::int64_t time) { return time % ms_per_day == 0; });
  std::vector<std::string> dates(times.size());
  std::ranges::transform(times, dates.begin(), [&](std::int64_t time) {
    return text_of_time(*calendar, time, !are_days, has_ms);
  });
  return dates;
}

// True if no two texts are equal.
bool are_different(std::vector<std::string> texts) {
  std::ranges::sort(texts);
  return std::ranges::adjacent_find(texts) == texts.end();
}

}  // namespace

std::vector<std::string> places_on_axis(const FieldArray& axis) {
  std::vector<std::string> places = dates_of(axis);
  // Numbers may differ where dates, which are rounded, do not.
  if (places.empty() || !are_different(places)) {
    places.clear();
    for (const double value : axis.values) places.push_back(system::shortest_text(value));
  }
  if (!are_different(places)) places.clear();
  return places;
}

}  // namespace rondel::formats

namespace rondel {

std::vector<std::string> names_of_fields(const FieldArray& array,
                                         std::span<const FieldArray> axes) {
  std::vector<std::string> names = {array.name};
  if (array.num_fields() == 1) return names;
  for (std::size_t d = 0; d < array.shape.size(); ++d) {
    // The places along the dimension: coordinates if it has an axis, or else indices.
    std::vector<std::string> places;
    for (const FieldArray& axis : axes) {
      const bool is_this = d < array.dimensions.size() && axis.name == array.dimensions[d] &&
                           axis.values.size() == array.shape[d];
      if (is_this) places = formats::places_on_axis(axis);
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
