// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds variables by their names and by their dimensions, in a time that does not grow with their
// number: files of models have thousands.
//
// in    headers of variables, which must outlive the index
// out   indices of variables
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rondel/conventions.h"

namespace rondel::formats {

// The variables of a file by name and by dimension.
class VariableIndex {
 public:
  static constexpr std::size_t none = CoordinatePair::none;

  explicit VariableIndex(std::span<const VariableHeader> variables) {
    by_name_.reserve(variables.size());
    for (std::size_t i = 0; i < variables.size(); ++i) {
      all_.push_back(i);
      by_name_.emplace(variables[i].name, i);  // the first one of a name counts
      for (const std::string& dimension : variables[i].dimensions) {
        std::vector<std::size_t>& along = by_dimension_[dimension];
        if (along.empty() || along.back() != i) along.push_back(i);
      }
    }
  }

  // Returns the index of the variable of this name, or `none`.
  [[nodiscard]] std::size_t find(std::string_view name) const {
    const auto at = by_name_.find(name);
    return at == by_name_.end() ? none : at->second;
  }
  // True if there is a variable of this name.
  [[nodiscard]] bool has(std::string_view name) const { return by_name_.contains(name); }
  // Returns all variables.
  [[nodiscard]] std::span<const std::size_t> all() const { return all_; }
  // Returns the variables that have the dimension, in their order.
  [[nodiscard]] std::span<const std::size_t> along(std::string_view dimension) const {
    const auto at = by_dimension_.find(dimension);
    if (at == by_dimension_.end()) return {};
    return at->second;
  }

 private:
  std::unordered_map<std::string_view, std::size_t> by_name_;
  std::vector<std::size_t> all_;
  std::unordered_map<std::string_view, std::vector<std::size_t>> by_dimension_;
};

}  // namespace rondel::formats
