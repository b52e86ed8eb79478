// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Implements the rules of cf_values.h: the constructor reads the attributes of a variable, apply()
// unpacks the numbers of a file, and apply_to_unpacked() finds missing ones among numbers that
// another program has unpacked. mark_missing() offers the last one to callers, with types and
// attributes as NumPy has them.
#include "formats/cf_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "formats/cf_names.h"
#include "io/bad_value.h"
#include "io/netcdf_reader.h"
#include "io/number.h"
#include "io/wide_integers.h"
#include "rondel/conventions.h"
#include "rondel/error.h"
#include "system/wide_vectors.h"

namespace rondel::formats {
namespace {

// Values that are missing become NaN.
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// The types of netCDF by NumPy's names.
constexpr std::pair<std::string_view, io::NetcdfType> names_of_types[] = {
    {"i1", io::NetcdfType::int8},    {"i2", io::NetcdfType::int16},
    {"i4", io::NetcdfType::int32},   {"i8", io::NetcdfType::int64},
    {"u1", io::NetcdfType::uint8},   {"u2", io::NetcdfType::uint16},
    {"u4", io::NetcdfType::uint32},  {"u8", io::NetcdfType::uint64},
    {"f4", io::NetcdfType::float32}, {"f8", io::NetcdfType::float64},
    {"", io::NetcdfType::text}};

// True for the types of netCDF that are numbers of single or double precision.
bool is_floating(io::NetcdfType type) {
  return type == io::NetcdfType::float32 || type == io::NetcdfType::float64;
}
// True for the types that _Unsigned = "true" makes unsigned.
bool is_signed_integer(io::NetcdfType type) {
  return type == io::NetcdfType::int8 || type == io::NetcdfType::int16 ||
         type == io::NetcdfType::int32 || type == io::NetcdfType::int64;
}
// True for the types that _Unsigned = "false" makes signed.
bool is_unsigned_integer(io::NetcdfType type) {
  return type == io::NetcdfType::uint8 || type == io::NetcdfType::uint16 ||
         type == io::NetcdfType::uint32 || type == io::NetcdfType::uint64;
}

// Returns the number that a text is, or nothing.
std::optional<double> number_of_text(const std::string& text) {
  try {
    return io::parse_number(text, "attribute");
  } catch (const io::BadValue&) {
    return std::nullopt;
  }
}

// Returns the numbers of an attribute, which may be a text of numbers with blanks or commas between
// them; empty if there is no attribute, or the text has other words.
std::vector<double> numbers_of_attribute(const io::NetcdfVariable& variable,
                                         std::string_view name) {
  const io::NetcdfAttribute* const attribute = io::find_attribute(variable.attributes, name);
  if (attribute == nullptr) return {};
  if (!attribute->numbers.empty()) return attribute->numbers;
  std::vector<double> numbers;
  std::string word;
  for (const char c : attribute->text + ' ') {
    if (c != ' ' && c != ',' && c != '\t') {
      word += c;
      continue;
    }
    if (word.empty()) continue;
    const std::optional<double> number = number_of_text(word);
    if (!number) return {};
    numbers.push_back(*number);
    word.clear();
  }
  return numbers;
}

// True if an attribute is there and has this type.
bool has_type(const io::NetcdfVariable& variable, std::string_view name, io::NetcdfType type) {
  const io::NetcdfAttribute* const attribute = io::find_attribute(variable.attributes, name);
  return attribute != nullptr && attribute->type == type;
}

// Returns scale_factor or add_offset, or `otherwise` if there is none. Throws BadValue if it is not
// one number.
double packing(const io::NetcdfVariable& variable, std::string_view name, double otherwise) {
  const io::NetcdfAttribute* const attribute = io::find_attribute(variable.attributes, name);
  if (attribute == nullptr) return otherwise;
  const std::vector<double> numbers = numbers_of_attribute(variable, name);
  if (numbers.size() == 1 && std::isfinite(numbers.front())) return numbers.front();
  throw io::BadValue(
      "variable " + io::in_quotes(variable.name) + ": attribute " + std::string(name) +
      (numbers.size() == 1
           ? " is not finite"
           : (attribute->numbers.empty()
                  ? " is the text " + io::in_quotes(attribute->text) + " and no number"
                  : " has " + std::to_string(numbers.size()) + " numbers instead of one")));
}

}  // namespace

ValueRules::ValueRules(const io::NetcdfVariable& variable)
    : type_(variable.type), lowest_(-infinity), highest_(infinity) {
  scale_ = packing(variable, "scale_factor", 1);
  offset_ = packing(variable, "add_offset", 0);
  for (const char* name : {"scale_factor", "add_offset"}) {
    if (!has_type(variable, name, io::NetcdfType::text)) continue;
    add_remark(variable, name, "is a text and taken for the number that it has");
  }
  read_signedness(variable);
  read_missing(variable);
  read_range(variable);
}

void ValueRules::read_signedness(const io::NetcdfVariable& variable) {
  const std::string unsignedness = lower_case(io::netcdf_text(variable.attributes, "_Unsigned"));
  const bool is_known = unsignedness == "true" || unsignedness == "false";
  if (io::find_attribute(variable.attributes, "_Unsigned") != nullptr && !is_known) {
    add_remark(variable, "_Unsigned", R"(is not heeded: it is neither "true" nor "false")");
  }
  becomes_unsigned_ = unsignedness == "true" && is_signed_integer(type_);
  if (becomes_unsigned_ || (unsignedness == "false" && is_unsigned_integer(type_))) {
    wrapped_ = std::ldexp(1, static_cast<int>(8 * io::size_of(type_)));
  }
}

void ValueRules::read_missing(const io::NetcdfVariable& variable) {
  for (const char* name : {"_FillValue", "missing_value"}) {
    const io::NetcdfAttribute* const attribute = io::find_attribute(variable.attributes, name);
    const std::vector<double> values = numbers_of_attribute(variable, name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      // The reader has marked those missing integers that are no doubles.
      const bool is_exact = !io::is_wide(type_) || attribute->integers.size() <= i ||
                            io::is_double(attribute->integers[i], attribute->type);
      if (is_exact) missing_.push_back(as_type(values[i]));
    }
    // Rule 2: doubles are compared with this one in single precision.
    is_single_ |=
        type_ == io::NetcdfType::float64 && has_type(variable, name, io::NetcdfType::float32);
  }
  // Every number of a byte may be a value, so that none is missing unless the file says so.
  if (io::find_attribute(variable.attributes, "_FillValue") == nullptr && size_of(type_) > 1) {
    // That of 64-bit integers is no double, which the reader knows.
    (io::is_wide(type_) ? rounded_missing_ : missing_).push_back(as_type(io::default_fill(type_)));
  }
}

void ValueRules::read_range(const io::NetcdfVariable& variable) {
  const std::vector<double> range = numbers_of_attribute(variable, "valid_range");
  const std::vector<double> least = numbers_of_attribute(variable, "valid_min");
  const std::vector<double> most = numbers_of_attribute(variable, "valid_max");
  // Returns number i of the attribute. For an integer that is no double it is the next double
  // inside of the range.
  const auto bound = [&](const char* name, const std::vector<double>& numbers, std::size_t i,
                         bool is_lower) {
    const io::NetcdfAttribute* const attribute = io::find_attribute(variable.attributes, name);
    const bool is_exact = attribute->integers.size() > i;
    return is_exact ? io::bound_as_double(attribute->integers[i], attribute->type, is_lower)
                    : numbers[i];
  };
  if (range.size() == 2) {
    lowest_ = bound("valid_range", range, 0, true);
    highest_ = bound("valid_range", range, 1, false);
  }
  for (const auto& [name, numbers, count] :
       {std::tuple("valid_range", &range, 2U), std::tuple("valid_min", &least, 1U),
        std::tuple("valid_max", &most, 1U)}) {
    if (numbers->size() == count || io::find_attribute(variable.attributes, name) == nullptr)
      continue;
    add_remark(
        variable, name,
        std::string("is not heeded: it is not ") + (count == 1 ? "one number" : "two numbers"));
  }
  // If a file has valid_min or valid_max beside valid_range, these count.
  if (least.size() == 1) lowest_ = bound("valid_min", least, 0, true);
  if (most.size() == 1) highest_ = bound("valid_max", most, 0, false);
  // Rule 3: the type of the range says whether it is one of packed or unpacked numbers.
  for (const char* name : {"valid_range", "valid_min", "valid_max"}) {
    for (const char* factor : {"scale_factor", "add_offset"}) {
      const io::NetcdfAttribute* const unpacked = io::find_attribute(variable.attributes, factor);
      has_unpacked_range_ |= unpacked != nullptr && is_floating(unpacked->type) &&
                             !is_floating(type_) && has_type(variable, name, unpacked->type);
    }
  }
  if (!has_unpacked_range_) {
    lowest_ = as_type(lowest_);
    highest_ = as_type(highest_);
  }
  if (!(lowest_ <= highest_)) {
    add_remark(variable, range.size() == 2 ? "valid_range" : "valid_min",
               "is more than the largest valid number: all values are missing");
  }
}

// Appends a part of the sentence that remark() returns.
void ValueRules::add_remark(const io::NetcdfVariable& variable, std::string_view attribute,
                            const std::string& what) {
  remark_ += remark_.empty() ? "variable " + io::in_quotes(variable.name) + ": " : "; ";
  remark_ += "attribute " + std::string(attribute) + ' ' + what;
}

// Returns the number converted to the type of the variable, which _Unsigned may change.
double ValueRules::as_type(double value) const {
  if (type_ == io::NetcdfType::float32 && std::abs(value) <= std::numeric_limits<float>::max()) {
    return static_cast<double>(static_cast<float>(value));
  }
  if (wrapped_ == 0) return value;
  if (becomes_unsigned_) return value < 0 ? value + wrapped_ : value;
  return value >= wrapped_ / 2 ? value - wrapped_ : value;
}

bool ValueRules::is_missing(double value) const {
  const auto is_one = [&](double missing) {
    if (value == missing) return true;
    return is_single_ && std::abs(value) >= std::numeric_limits<float>::min() &&
           std::abs(value) <= std::numeric_limits<float>::max() &&
           static_cast<double>(static_cast<float>(value)) == missing;
  };
  return std::ranges::any_of(missing_, is_one);
}

void ValueRules::apply(std::span<double> values) const {
  const bool is_simple = wrapped_ == 0 && !has_unpacked_range_ && missing_.size() <= 2 &&
                         (!is_single_ || type_ == io::NetcdfType::float32);
  if (is_simple) {
    system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE { apply_simple(values); });
    return;
  }
  const auto is_outside = [&](double value) { return value < lowest_ || value > highest_; };
  for (double& value : values) {
    if (wrapped_ != 0) value = as_type(value);
    if (is_missing(value) || (!has_unpacked_range_ && is_outside(value))) {
      value = no_number;
      continue;
    }
    if (is_packed()) value = value * scale_ + offset_;
    if (has_unpacked_range_ && is_outside(value)) value = no_number;
  }
}

inline void ValueRules::apply_simple(std::span<double> values) const {
  const double missing = missing_.empty() ? no_number : missing_.front();
  const double other = missing_.empty() ? no_number : missing_.back();
  const double lowest = lowest_;
  const double highest = highest_;
  const double scale = scale_;
  const double offset = offset_;
  const auto is_lost = [=](double value) {
    return (value == missing) | (value == other) | (value < lowest) | (value > highest);
  };
  if (is_packed()) {
    for (double& value : values) {
      const double unpacked = value * scale + offset;
      value = is_lost(value) ? no_number : unpacked;
    }
  } else {
    for (double& value : values) value = is_lost(value) ? no_number : value;
  }
}

// Whoever unpacked the values may have done so in single precision, which rounds three times at
// most: the scale_factor, the product, the sum.
void ValueRules::apply_to_unpacked(std::span<double> values) const {
  for (double& value : values) {
    const bool is_single = std::abs(value) <= std::numeric_limits<float>::max() &&
                           static_cast<double>(static_cast<float>(value)) == value;
    const double rounding =
        3 * (is_single ? static_cast<double>(std::numeric_limits<float>::epsilon())
                       : std::numeric_limits<double>::epsilon());
    if (is_lost(value, is_packed() ? rounding : 0)) value = no_number;
  }
}

// Different integers are a scale_factor apart, so that an unpacked value nearer to one of them than
// a quarter of that is that integer, and the rules of the file hold for it.
bool ValueRules::is_lost(double value, double rounding) const {
  const auto slack = [&](double number) {
    return rounding * (std::abs(number * scale_) + std::abs(offset_));
  };
  const double quarter = is_packed() && !is_floating(type_) ? std::abs(scale_) / 4 : 0;
  const auto is_one = [&](double missing) {
    const double away = std::abs(value - (missing * scale_ + offset_));
    return is_packed() ? away <= std::max(quarter, slack(missing)) : value == missing;
  };
  if (std::ranges::any_of(missing_, is_one) || std::ranges::any_of(rounded_missing_, is_one) ||
      (!is_packed() && is_missing(value)))
    return true;
  // The range is that of packed numbers, so the value is packed again.
  double number = is_packed() ? (value - offset_) / scale_ : value;
  const double integer = std::nearbyint(number);
  const bool is_integer = quarter > 0 && std::abs(number - integer) <= 0.25;
  if (is_integer) number = integer;
  if (has_unpacked_range_) {
    const double unpacked = is_integer ? integer * scale_ + offset_ : value;
    return unpacked < lowest_ || unpacked > highest_;
  }
  const auto beyond = [&](double bound) {
    return std::abs(value - (bound * scale_ + offset_)) > slack(bound);
  };
  return (number < lowest_ && beyond(lowest_)) || (number > highest_ && beyond(highest_));
}

io::NetcdfType type_named(std::string_view name) {
  const auto* const known =
      std::ranges::find(names_of_types, name, &std::pair<std::string_view, io::NetcdfType>::first);
  if (known != std::end(names_of_types)) return known->second;
  throw InvalidInput("there is no type '" + std::string(name) + "'", 0);
}

std::string_view name_of(io::NetcdfType type) {
  return std::ranges::find(names_of_types, type,
                           &std::pair<std::string_view, io::NetcdfType>::second)
      ->first;
}

}  // namespace rondel::formats

namespace rondel {

namespace {

io::NetcdfVariable variable_of(std::string_view type, std::span<const ValueAttribute> attributes) {
  io::NetcdfVariable variable{"values", formats::type_named(type), {}, {}};
  for (const ValueAttribute& given : attributes) {
    io::NetcdfAttribute attribute{given.name, formats::type_named(given.type), given.text,
                                  given.numbers};
    if (io::is_wide(attribute.type) && given.integers.size() == given.numbers.size()) {
      attribute.integers = given.integers;
    }
    variable.attributes.push_back(std::move(attribute));
  }
  return variable;
}

formats::ValueRules rules_of(const io::NetcdfVariable& variable) {
  try {
    return formats::ValueRules(variable);
  } catch (const io::BadValue& bad) {
    throw InvalidInput(bad.what(), 0);
  }
}

}  // namespace

void mark_missing(std::span<double> values, std::string_view type,
                  std::span<const ValueAttribute> attributes) {
  io::NetcdfVariable variable = variable_of(type, attributes);
  for (io::NetcdfAttribute& attribute : variable.attributes) {
    // Whoever unpacked the values may have rounded them, so that these are compared as doubles.
    if (!attribute.name.starts_with("valid_")) attribute.integers.clear();
  }
  rules_of(variable).apply_to_unpacked(values);
}

std::vector<double> unpack_integers(std::span<const std::int64_t> integers, std::string_view type,
                                    std::span<const ValueAttribute> attributes) {
  const io::NetcdfVariable variable = variable_of(type, attributes);
  if (!io::is_wide(variable.type)) {
    throw InvalidInput("'" + std::string(type) + "' is no type of 64-bit integers", 0);
  }
  const formats::ValueRules rules = rules_of(variable);
  std::vector<double> values(integers.size());
  const std::size_t first = io::round_to_doubles(variable, integers, values);
  if (first < integers.size()) {
    throw InvalidInput(
        "has the integer " + io::text_of(integers[first], variable.type) + ", which is no double",
        first);
  }
  rules.apply(values);
  return values;
}

}  // namespace rondel
