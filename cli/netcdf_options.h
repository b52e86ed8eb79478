// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options --kind and --deflate of the commands that write netCDF.
#pragma once

#include <CLI/CLI.hpp>

#include "rondel/io.h"
#include "words.h"

namespace rondel::cli {

/// Adds --kind and --deflate.
inline void add_netcdf_options(CLI::App& parser, NetcdfOptions& options) {
  add_word<NetcdfKind>(
      parser, "--kind", options.kind,
      {{"cdf5", NetcdfKind::cdf5}, {"cdf2", NetcdfKind::cdf2}, {"nc4", NetcdfKind::netcdf4}},
      "The format of netCDF: nc4 (netCDF-4, compressed; of names that end in .nc4), cdf5\n"
      "or cdf2 (64-bit offset; less than 4 GiB a variable); default: what fits");
  parser
      .add_option("--deflate", options.deflate,
                  "How much effort the compression of nc4 takes, 0 (none) to 9 (default: 1)")
      ->check(CLI::Range(0, 9).description(""))
      ->type_name("N");
}

}  // namespace rondel::cli
