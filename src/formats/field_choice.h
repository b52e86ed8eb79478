// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the variables and fields of a netCDF file that names mean, and lists names for messages.
//
// in    names as users write them: "tas", "tas[3]", "tas_2001-07-15"
// out   variables of the file; numbers of fields
// index fields of a variable, the last of its leading dimensions varying fastest
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/netcdf_reader.h"
#include "rondel/fields.h"

namespace rondel::formats {

// Returns the field that `places` means, "[3, 1]" being the one at places 3 and 1 along the leading
// dimensions; negative places count from the end. Throws BadValue.
std::size_t number_of_field(const FieldArray& several, std::string_view places);
// Returns the variables that the name may mean: that of this name, or "tas" of "tas[3]" and
// "tas_2001-07-15", the longest name first.
std::vector<const io::VariableInFile*> meant_variables(const io::NetcdfReader& file,
                                                       const std::string& name);
// Returns the variables that are named, or all that have dimensions where no name is given. A name
// that means no variable is passed over here.
std::vector<const io::VariableInFile*> variables_to_read(const io::NetcdfReader& file,
                                                         std::span<const std::string> names);

// A list of the first names, and how many more there are.
class NameList {
 public:
  // Adds a name; from the sixth one on, names are only counted.
  void add(const std::string& name) {
    constexpr std::size_t most = 5;
    if (++number_ <= most) text_ += (text_.empty() ? "" : ", ") + name;
    more_ = number_ > most ? " and " + std::to_string(number_ - most) + " more" : "";
  }
  // Returns the names, "a, b and 3 more" for example; empty if there are none.
  [[nodiscard]] std::string text() const { return text_ + more_; }

 private:
  std::size_t number_ = 0;
  std::string text_;
  std::string more_;
};

}  // namespace rondel::formats
