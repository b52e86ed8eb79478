// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes small netCDF files from variables with their values.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/atomic_file.h"
#include "io/netcdf_writer.h"

namespace rondel::test {

class MeshWriter {
 public:
  using Dimensions = std::vector<std::pair<std::string, std::uint64_t>>;
  using Texts = std::vector<std::pair<std::string, std::string>>;
  using Numbers = std::vector<std::pair<std::string, double>>;

  // Doubles, or floats, or, if `is_whole`, 32-bit integers.
  void add(const std::string& name, const Dimensions& dimensions, std::vector<double> values,
           const Texts& texts = {}, const Numbers& numbers = {},
           io::NetcdfType type = io::NetcdfType::float64) {
    io::NetcdfVariable variable{name, type, {}, {}};
    for (const auto& [key, size] : dimensions) variable.dimensions.push_back(dimension(key, size));
    for (const auto& [key, text] : texts) {
      variable.attributes.push_back({key, io::NetcdfType::text, text, {}});
    }
    for (const auto& [key, number] : numbers) {
      variable.attributes.push_back({key, io::NetcdfType::int32, "", {number}});
    }
    variables_.push_back({std::move(variable), std::move(values)});
  }
  void add_whole(const std::string& name, const Dimensions& dimensions, std::vector<double> values,
                 const Texts& texts = {}, const Numbers& numbers = {}) {
    add(name, dimensions, std::move(values), texts, numbers, io::NetcdfType::int32);
  }
  void add_attribute(const std::string& name, const std::string& text) {
    attributes_.emplace_back(name, text);
  }

  void write(const std::string& path) const {
    io::AtomicFile file(path);
    io::NetcdfWriter out(file);
    for (const io::NetcdfDimension& dimension : dimensions_) {
      out.add_dimension(dimension.name, dimension.size);
    }
    for (const auto& [name, text] : attributes_) out.add_attribute(name, text);
    for (const auto& [variable, values] : variables_) out.add_variable(variable);
    out.begin();
    for (const auto& [variable, values] : variables_) {
      const auto value = [&numbers = values](std::size_t i) { return numbers[i]; };
      if (variable.type == io::NetcdfType::int32) {
        out.write_values<std::int32_t>(values.size(), value);
      } else if (variable.type == io::NetcdfType::float32) {
        out.write_values<float>(values.size(), value);
      } else {
        out.write_values<double>(values.size(), value);
      }
    }
    out.finish();
    file.commit();
  }

 private:
  struct Written {
    io::NetcdfVariable variable;
    std::vector<double> values;
  };

  std::size_t dimension(const std::string& name, std::uint64_t size) {
    const auto known = std::ranges::find(dimensions_, name, &io::NetcdfDimension::name);
    if (known == dimensions_.end()) {
      dimensions_.push_back({name, size});
      return dimensions_.size() - 1;
    }
    return static_cast<std::size_t>(known - dimensions_.begin());
  }

  std::vector<io::NetcdfDimension> dimensions_;
  Texts attributes_;
  std::vector<Written> variables_;
};

}  // namespace rondel::test
