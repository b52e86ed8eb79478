// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// `rondel-mpi regrid`: what `rondel regrid` does, by several processes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "rondel/distributed.h"
#include "rondel/regrid_files.h"

namespace rondel::cli {

/// The arguments of `rondel-mpi regrid`.
struct RegridArguments {
  std::string in;
  std::string target;
  std::string out;
  std::string source;
  RegridFileOptions options;
  unsigned threads = 0;  ///< 0: this rank's share
  bool is_json = false;
  bool is_quiet = false;
};

/// Adds the command; the arguments are set when the command line is parsed.
CLI::App& add_regrid(CLI::App& tool, RegridArguments& arguments);

/// Returns the arguments that must be the same on all ranks.
std::string common_part(const RegridArguments& arguments);

/// Regrids; rank 0 prints a summary. \throws DistributedError on all ranks
void regrid(Communicator& ranks, const RegridArguments& arguments, const Execution& execution);

}  // namespace rondel::cli
