// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel delaunay --scratch: from a file to files.

#include "rondel/out_of_core.h"

#include "report.h"
#include "run.h"

namespace rondel::cli {
namespace {

void require_npy(const char* option, const FileName& file, const std::string& format) {
  if (file.path != "-" && format == "npy") return;
  throw UsageError(std::string(option) + ": with --scratch '" + file.path +
                   "' must be a .npy file");
}

}  // namespace

ExitStatus run_out_of_core(const DelaunayOptions& options) {
  const CommonOptions& common = options.common;
  CommonOptions input;
  input.output = common.input;
  input.output_format = common.input_format;
  require_npy("INPUT", common.source(), input.format());
  require_npy("--output", common.target(), common.format());
  require_output(common, true, ".npy");
  if (!common.read.radius.empty())
    throw UsageError(
        "--radius: .npy files have no names for columns; give weighted sites as x, y, z");
  Job job(common);
  OutOfCoreOptions out_of_core;
  if (options.memory != 0) out_of_core.memory = options.memory;
  out_of_core.scratch = options.scratch;
  out_of_core.resume = options.resume;
  out_of_core.radians = common.read.radians;
  const OutOfCoreReport report = delaunay_file(
      common.input, {common.output, options.neighbors, options.areas, options.duplicates},
      out_of_core, common.build, job.execution());
  job.report(out_of_core_json_report(report, common.build.model, job.seconds()),
             out_of_core_summary(report, common.build.model, job.seconds(), common.output));
  return done;
}

}  // namespace rondel::cli
