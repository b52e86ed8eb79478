// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes files of netCDF's classic formats byte by byte, as the description of the format says.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/netcdf_format.h"

namespace rondel::test {

struct ClassicVariable : io::NetcdfVariable {
  std::vector<double> values;  // of records: one record after the other
};

struct ClassicFile {
  int version = 1;
  std::vector<io::NetcdfDimension> dimensions;  // the dimension of records has the size 0
  std::vector<io::NetcdfAttribute> attributes;
  std::vector<ClassicVariable> variables;
  std::uint64_t num_records = 0;
  bool counts_records = true;

  [[nodiscard]] std::string bytes() const {
    const std::size_t head = header(std::vector<std::uint64_t>(variables.size())).size();
    std::vector<std::uint64_t> offsets(variables.size());
    std::string data;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      if (has_records(variables[v])) continue;
      offsets[v] = head + data.size();
      data += padded(numbers(variables[v].type, variables[v].values));
    }
    std::uint64_t num_with_records = 0;
    for (const ClassicVariable& variable : variables) num_with_records += has_records(variable);
    for (std::uint64_t record = 0; record < num_records; ++record) {
      for (std::size_t v = 0; v < variables.size(); ++v) {
        const ClassicVariable& variable = variables[v];
        if (!has_records(variable)) continue;
        if (record == 0) offsets[v] = head + data.size();
        const std::size_t size = variable.values.size() / num_records;
        const auto first = variable.values.begin() + static_cast<std::ptrdiff_t>(record * size);
        const std::string piece =
            numbers(variable.type, {first, first + static_cast<std::ptrdiff_t>(size)});
        data += num_with_records == 1 ? piece : padded(piece);
      }
    }
    return header(offsets) + data;
  }

 private:
  template <typename T>
  static std::string big_endian(T value) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    std::string text(bytes.begin(), bytes.end());
    if (std::endian::native == std::endian::little) std::reverse(text.begin(), text.end());
    return text;
  }
  static std::string padded(std::string bytes) {
    while (bytes.size() % 4 != 0) bytes += '\0';
    return bytes;
  }
  static std::string number(io::NetcdfType type, double value) {
    using io::NetcdfType;
    switch (type) {
      case NetcdfType::int8:
        return big_endian(static_cast<std::int8_t>(value));
      case NetcdfType::int16:
        return big_endian(static_cast<std::int16_t>(value));
      case NetcdfType::int32:
        return big_endian(static_cast<std::int32_t>(value));
      case NetcdfType::int64:
        return big_endian(static_cast<std::int64_t>(value));
      case NetcdfType::text:
      case NetcdfType::uint8:
        return big_endian(static_cast<std::uint8_t>(value));
      case NetcdfType::uint16:
        return big_endian(static_cast<std::uint16_t>(value));
      case NetcdfType::uint32:
        return big_endian(static_cast<std::uint32_t>(value));
      case NetcdfType::uint64:
        return big_endian(static_cast<std::uint64_t>(value));
      case NetcdfType::float32:
        return big_endian(static_cast<float>(value));
      case NetcdfType::float64:
        break;
    }
    return big_endian(value);
  }
  static std::string numbers(io::NetcdfType type, const std::vector<double>& values) {
    std::string bytes;
    for (const double value : values) bytes += number(type, value);
    return bytes;
  }

  // False for a dimension that the file does not have, as files with faults may name one.
  [[nodiscard]] bool has_records(const ClassicVariable& variable) const {
    return !variable.dimensions.empty() && variable.dimensions[0] < dimensions.size() &&
           dimensions[variable.dimensions[0]].size == 0;
  }
  static std::string word(std::uint64_t value) {
    return big_endian(static_cast<std::uint32_t>(value));
  }
  [[nodiscard]] std::string count(std::uint64_t value) const {
    return version == 5 ? big_endian(value) : word(value);
  }
  [[nodiscard]] std::string name(const std::string& text) const {
    return count(text.size()) + padded(text);
  }
  [[nodiscard]] std::string list(std::uint32_t tag, std::uint64_t size) const {
    return word(size == 0 ? 0 : tag) + count(size);
  }
  [[nodiscard]] std::string list_of(const std::vector<io::NetcdfAttribute>& members) const {
    std::string bytes = list(12, members.size());
    for (const io::NetcdfAttribute& member : members) {
      const bool is_text = member.type == io::NetcdfType::text;
      bytes += name(member.name) + word(static_cast<std::uint32_t>(member.type)) +
               count(is_text ? member.text.size() : member.numbers.size()) +
               padded(is_text ? member.text : numbers(member.type, member.numbers));
    }
    return bytes;
  }
  [[nodiscard]] std::string header(const std::vector<std::uint64_t>& offsets) const {
    std::string bytes = "CDF" + std::string(1, static_cast<char>(version)) +
                        count(counts_records ? num_records : ~std::uint64_t{0}) +
                        list(10, dimensions.size());
    for (const auto& dimension : dimensions) bytes += name(dimension.name) + count(dimension.size);
    bytes += list_of(attributes) + list(11, variables.size());
    for (std::size_t v = 0; v < variables.size(); ++v) {
      const ClassicVariable& variable = variables[v];
      bytes += name(variable.name) + count(variable.dimensions.size());
      for (const std::size_t dimension : variable.dimensions) bytes += count(dimension);
      bytes += list_of(variable.attributes) + word(static_cast<std::uint32_t>(variable.type));
      bytes += count(0);  // the size, which readers compute
      bytes += version == 1 ? word(offsets[v]) : big_endian(offsets[v]);
    }
    return bytes;
  }
};

inline ClassicVariable classic_variable(
    std::string name, io::NetcdfType type, std::vector<std::size_t> dimensions,
    std::vector<double> values,
    const std::vector<std::pair<std::string, std::string>>& texts = {}) {
  ClassicVariable variable;
  variable.name = std::move(name);
  variable.type = type;
  variable.dimensions = std::move(dimensions);
  variable.values = std::move(values);
  for (const auto& [key, text] : texts) {
    variable.attributes.push_back({key, io::NetcdfType::text, text, {}});
  }
  return variable;
}

}  // namespace rondel::test
