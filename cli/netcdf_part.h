// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// FILE.nc:NAME, which is a variable of a netCDF file.
///
/// in    the name of a file as the command line has it
/// out   the file, and the name of the variable; it is empty if none is named
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "rondel/io.h"

namespace rondel::cli {

/// Returns the file and the name behind a colon; the name may have colons itself. Returns the whole
/// path and no name if there is a file of that name, or if no part before a colon is a netCDF file.
inline std::pair<FileName, std::string> netcdf_part(const FileName& file) {
  std::error_code error;
  if (std::filesystem::exists(file.path, error)) return {file, {}};
  for (std::size_t colon = file.path.rfind(':'); colon != std::string::npos && colon >= 2;
       colon = file.path.rfind(':', colon - 1)) {
    FileName before(file.path.substr(0, colon), file.format);
    if (is_netcdf_file(before)) return {std::move(before), file.path.substr(colon + 1)};
  }
  return {file, {}};
}

}  // namespace rondel::cli
