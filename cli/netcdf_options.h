// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options --kind and --deflate of the commands that write netCDF.
///
/// in    the command line
/// out   NetcdfOptions: the format of netCDF, and the effort of its compression
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "command.h"
#include "rondel/io.h"
#include "words.h"

namespace rondel::cli {

/// Adds --kind and --deflate.
/// \param written  returns the outputs of the command that are netCDF; none if there is no such
/// output
inline void add_netcdf_options(CLI::App& parser, CommonOptions& common, NetcdfOptions& options,
                               const std::function<std::vector<FileName>()>& written) {
  const CLI::Option* const kind = add_word<NetcdfKind>(
      parser, "--kind", options.kind,
      {{"cdf5", NetcdfKind::cdf5}, {"cdf2", NetcdfKind::cdf2}, {"nc4", NetcdfKind::netcdf4}},
      "The format of netCDF: nc4 (netCDF-4, compressed; of names that end in .nc4), cdf5\n"
      "or cdf2 (64-bit offset; less than 4 GiB a variable); default: what fits");
  const CLI::Option* const deflate =
      parser
          .add_option("--deflate", options.deflate,
                      "How much effort the compression of nc4 takes, 0 (none) to 9 (default: 1)")
          ->check(CLI::Range(0, 9).description(""))
          ->type_name("N");
  require_effect(
      common, kind, [written] { return !written().empty(); }, "on files other than netCDF");
  require_effect(
      common, deflate,
      [written, &options] {
        const std::vector<FileName> files = written();
        return std::ranges::any_of(files, [&](const FileName& file) {
          const bool is_by_name = options.kind == NetcdfKind::by_name;
          return is_by_name ? file.path.ends_with(".nc4") || file.format == "nc4"
                            : options.kind == NetcdfKind::netcdf4;
        });
      },
      "without --kind nc4 or the ending .nc4: other files are not compressed");
}

/// Returns OUTPUT if its format is one of these, else nothing.
inline std::vector<FileName> output_of_format(const CommonOptions& common,
                                              std::initializer_list<const char*> formats) {
  const std::string format = common.format();
  const bool is_one =
      std::ranges::any_of(formats, [&](const char* name) { return format == name; });
  return is_one ? std::vector<FileName>{common.target()} : std::vector<FileName>();
}

}  // namespace rondel::cli
