// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// FILE.nc:NAME, a variable of a netCDF file.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "rondel/io.h"

namespace rondel::cli {

/// The file, and the name behind its last colon; the whole path and no name, if there is a file of that name or what is before
/// the colon is no netCDF file.
inline std::pair<FileName, std::string> netcdf_part(const FileName& file) {
  const std::size_t colon = file.path.rfind(':');
  std::error_code error;
  if (colon == std::string::npos || colon < 2 || std::filesystem::exists(file.path, error)) {
    return {file, {}};
  }
  FileName before(file.path.substr(0, colon), file.format);
  if (!is_netcdf_file(before)) return {file, {}};
  return {std::move(before), file.path.substr(colon + 1)};
}

}  // namespace rondel::cli
