// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Interprets the numbers of a variable, which may be missing or packed: CF 1.11, sections 2.5.1 and
// 8.1; NetCDF User's Guide, "Attribute Conventions".
//
// in    a variable's attributes; its numbers as they are in the file
// out   unpacked numbers, with NaN for missing ones
//
// 1. A number is missing if it is _FillValue, one of the numbers of missing_value, outside of
//    valid_min, valid_max or valid_range, or NaN. Without _FillValue, the default fill value of
//    netCDF is missing too (types of one byte have none).
// 2. These attributes may have any type of numbers, or be a text of numbers; they are compared in
//    the less precise of both types.
// 3. They are compared with the packed numbers. valid_* are compared with the unpacked numbers if
//    their type is that of scale_factor or add_offset and not the variable's.
// 4. _Unsigned = "true" makes signed integers unsigned, "false" makes unsigned integers signed.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/netcdf_format.h"

namespace rondel::formats {

// Returns the type that NumPy calls by this name, and "" a text. Throws InvalidInput for others.
io::NetcdfType type_named(std::string_view name);
// Returns NumPy's name of a type; it is empty for a text.
std::string_view name_of(io::NetcdfType type);

// The rules for the numbers of one variable.
class ValueRules {
 public:
  // Throws BadValue if scale_factor or add_offset is no finite number, or several.
  explicit ValueRules(const io::NetcdfVariable& variable);

  // Unpacks numbers of the file; missing ones become NaN.
  void apply(std::span<double> values) const;
  // Does the same with numbers that are already unpacked; missing ones may be NaN.
  void apply_to_unpacked(std::span<double> values) const;
  // True if apply() changes numbers that are not missing.
  [[nodiscard]] bool is_packed() const { return scale_ != 1 || offset_ != 0; }
  // Returns what is odd about the attributes, or an empty text: a packing that is a text, bounds
  // that are no numbers or exclude all numbers, an _Unsigned that is neither "true" nor "false".
  [[nodiscard]] const std::string& remark() const { return remark_; }

 private:
  // Does what apply() does where at most two numbers mean missing, without branches: nearly all
  // fields of floats and packed ones are such.
  void apply_simple(std::span<double> values) const;
  // Reads _Unsigned (rule 4).
  void read_signedness(const io::NetcdfVariable& variable);
  // Reads _FillValue and missing_value, or takes the default fill value (rules 1 and 2).
  void read_missing(const io::NetcdfVariable& variable);
  // Reads valid_range, valid_min and valid_max (rules 1 to 3).
  void read_range(const io::NetcdfVariable& variable);
  // Adds a sentence on an attribute to remark().
  void add_remark(const io::NetcdfVariable& variable, std::string_view attribute,
                  const std::string& what);
  // Returns a number in the type of the variable, after _Unsigned.
  [[nodiscard]] double as_type(double value) const;
  // True for a packed number that is one of those that mean missing.
  [[nodiscard]] bool is_missing(double value) const;
  // True for an unpacked number that was missing, up to a relative `rounding` by the one who
  // unpacked it.
  [[nodiscard]] bool is_lost(double value, double rounding) const;

  io::NetcdfType type_;
  // Two to the number of bits if _Unsigned changes the type, else 0. It is added to negative
  // integers, or subtracted from integers of at least half of it.
  double wrapped_ = 0;
  bool becomes_unsigned_ = false;
  // Packed numbers that mean missing.
  std::vector<double> missing_;
  // Further ones, of 64-bit integers that somebody else has made doubles.
  std::vector<double> rounded_missing_;
  bool is_single_ = false;  // some numbers of missing_ are of single precision
  // The range of valid numbers, packed ones unless has_unpacked_range_.
  double lowest_;
  double highest_;
  bool has_unpacked_range_ = false;
  // An unpacked number is scale_ times the packed one, plus offset_.
  double scale_ = 1;
  double offset_ = 0;
  std::string remark_;
};

}  // namespace rondel::formats
