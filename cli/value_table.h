// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Values at targets as a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rondel/io.h"

namespace rondel::cli {

/// The values of one column, one for each target; NaN: none.
struct ValueColumn {
  std::string name;
  std::vector<double> values;

  [[nodiscard]] std::size_t num_missing() const;
};

/// A header and a row for each target: its place and the values, with the shortest digits that are read
/// back as the same number.
std::string table_of(const SiteTable& targets, const std::vector<ValueColumn>& columns,
                     char separator);

/// Writes .npy of this shape, before which comes the number of columns if there are several.
void write_array(const std::string& path, const std::vector<ValueColumn>& columns,
                 std::vector<std::uint64_t> shape);

}  // namespace rondel::cli
