// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Libraries that Python's packages bring, for the tool that pip has installed beside them.
///
/// in    where the executable is
/// out   the library netCDF-C that is preferred to the system's
#pragma once

#include <string>

namespace rondel::cli {

/// If the executable is in an environment of Python or conda that has netCDF-C, by the wheel of
/// netCDF4 or by itself, files of netCDF-4 are read and written by that.
/// \param program  the name by which the program was called
void use_netcdf_of_python(const std::string& program);

}  // namespace rondel::cli
